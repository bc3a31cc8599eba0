"""Functions of a machine: expressions as programs, tables, Python laws."""
