"""Bodies, markers and the coordinates of joints: where they are, how they move, what constrains them."""
