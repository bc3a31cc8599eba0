"""Families of forces, one a file: a compiled function for all forces of a kind, and the columns of its numbers.

A family reads markers, coordinates and functions, adds to the wrenches of the bodies and to `control.power` (work from outside,
dissipation) and `control.stored` (elastic energy), and leaves its outputs. It must give the same for the same state.
"""
