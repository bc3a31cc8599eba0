"""Efforts that a motion asks for, and the matrices of robotics."""
