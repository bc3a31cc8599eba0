"""Elements of machines, a room for each sort, in it a file for each family: record, rows, kernel and numbers of a kind stand together."""
