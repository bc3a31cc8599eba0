"""The plan of a run: its methods chosen or refused, and what has to be compiled."""
