"""Settings of the analyses, a record for each: units, bounds, defaults, meanings, and options of the command line."""
