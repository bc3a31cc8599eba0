"""Checks of the trust report, by subject: what each measures and what it says."""
