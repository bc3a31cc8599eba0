"""The best of many machines: minimisation under constraints, parameters from measurements, inputs over time."""
