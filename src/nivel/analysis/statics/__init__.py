"""Static equilibrium: the states in which a machine rests under its loads, how they change with them, and how stable they are."""
