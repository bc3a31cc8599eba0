"""Elimination of rows and unknowns, and the order in which the rest is factorised."""
