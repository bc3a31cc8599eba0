"""Reduced bodies: invariants, files, recovery of displacements and stresses."""
