"""The record of a machine: all arrays that kernels read and write, its functions and how families of elements are called."""
