"""Joints, couplings between them, and drivers."""
