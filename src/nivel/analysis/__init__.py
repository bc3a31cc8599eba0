"""What can be asked of a machine: assembly, motion in time."""
