"""Machines to be driven: `nivel demo NAME`."""
