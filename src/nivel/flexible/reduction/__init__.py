"""Reduction of a finite-element model to modes."""
