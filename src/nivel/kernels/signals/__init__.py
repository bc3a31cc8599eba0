"""What is measured, computed and sampled beside the mechanics: sensors, control blocks, inputs, events."""
