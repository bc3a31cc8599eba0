"""Checks of the trust report: one module for each, with what it measures and what it says."""
