"""Check of a machine before any run, as `nivel check` prints it."""
