"""Machines made ready: built, assembled and put into the coordinates of an analysis; with the attributes of its result."""
