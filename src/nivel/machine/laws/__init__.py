"""Functions of time, of coordinates and of signals: tables, expressions, Python functions."""
