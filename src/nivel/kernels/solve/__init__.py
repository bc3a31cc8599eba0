"""Equations of motion solved for accelerations and multipliers."""
