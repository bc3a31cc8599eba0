"""Stresses of flexible bodies, recovered from their modes."""
