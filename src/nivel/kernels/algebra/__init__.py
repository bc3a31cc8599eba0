"""Linear algebra and rotations: no machine in them."""
