"""Which rows and unknowns are eliminated, and in which order the rest is factorised."""
