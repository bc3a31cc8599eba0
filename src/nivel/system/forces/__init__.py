"""Numbers of forces whose records and kernels stand elsewhere."""
