"""Expressions and quantities with units."""
