"""Results of kinematic, inverse and linearised analysis."""
