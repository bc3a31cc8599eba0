"""Arrays of signals: inputs, sensors, states and control."""
