"""Signals beside the mechanics: sensors, control blocks, inputs, events."""
