"""Explicit methods of one step."""
