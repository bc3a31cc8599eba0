"""A run in time: prepared, computed, looked at by a second run, and its end explained."""
