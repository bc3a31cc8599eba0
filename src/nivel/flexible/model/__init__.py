"""Finite-element models: files, meshes, frames, mass."""
