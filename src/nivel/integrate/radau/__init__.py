"""Radau IIA with three stages."""
