"""Direct correction (report 44, §5.5): after every step positions, then velocities, are put back onto the constraints."""

from __future__ import annotations

CORRECTS = True

# Violations below this share of the machine's length (per second, for rates) are round-off of the evaluation, and left alone.
TOLERANCE = 1e-13


def coefficients(
    step: float, alpha: float | None, beta: float | None, size: float
) -> tuple[float, float, float, float]:
    """(0, 0, tolerance of |C| [m], tolerance of |Ċ| [m/s]) for a machine of length `size` [m]."""
    del step, alpha, beta
    return 0.0, 0.0, TOLERANCE * size, TOLERANCE * size
