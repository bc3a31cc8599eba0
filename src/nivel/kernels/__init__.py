"""Kernels: floats and arrays in, arrays and status codes out; see `nivel.native` for how they are compiled."""
