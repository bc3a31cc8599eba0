"""Progress of a computation, and its interruption."""
