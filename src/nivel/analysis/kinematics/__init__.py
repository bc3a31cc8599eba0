"""Positions, velocities, accelerations and reactions of fully driven machines."""
