"""Records of forces whose kernels stand elsewhere."""
