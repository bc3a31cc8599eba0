"""Checks of a reduced body against its model and mesh."""
