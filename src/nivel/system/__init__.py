"""A machine in numbers: names and slices, elimination order, and the arrays of the kernels."""
