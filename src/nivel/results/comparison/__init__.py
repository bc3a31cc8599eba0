"""Results of several methods, side by side."""
