"""Energies and frames of results; the entries of statics."""
