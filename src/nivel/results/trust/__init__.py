"""Trust report: its checks and its sentences."""
