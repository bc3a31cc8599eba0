"""How far a computation is, and how it is interrupted."""
