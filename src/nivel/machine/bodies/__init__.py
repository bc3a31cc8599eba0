"""Bodies: mass, inertia, shapes and surfaces."""
