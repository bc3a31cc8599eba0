"""Stabilisation methods, one a file: what they set in `control.stabilise`, and whether states are corrected after a step."""
