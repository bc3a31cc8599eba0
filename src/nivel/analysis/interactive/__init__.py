"""Machines that are posed by hand."""
