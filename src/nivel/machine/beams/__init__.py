"""Beams and their sections."""
