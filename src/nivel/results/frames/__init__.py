"""Frames of results: their names, units and files."""
