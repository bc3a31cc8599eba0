"""A machine as a C library: its equations in machine code, its numbers as one block of memory, a header."""
