"""Trees of joints: recursions over bodies, and what completes their frames."""
