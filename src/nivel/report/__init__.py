"""The report of a run: one HTML file for people, and the picture of the machine in it."""
