"""The loop over steps: frames, events, corners, the control of steps, real time."""
