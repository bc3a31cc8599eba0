"""Beams: the record, lines, sections, and elements in a file for each model."""
