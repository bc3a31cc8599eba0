"""Records, named elements, markers, and places and directions in space."""
