"""Matrices and meshes of other programs."""
