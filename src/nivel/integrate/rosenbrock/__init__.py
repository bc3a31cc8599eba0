"""Linearly implicit methods: Rosenbrock, extrapolated Euler, and the fast steps over circuits."""
