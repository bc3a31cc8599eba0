"""Functions of a run against its steps: loads of time, place and speed that vary faster than the steps."""
