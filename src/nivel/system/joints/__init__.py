"""Arrays of joints: constraint rows, joint frames, drivers, rails and interfaces."""
