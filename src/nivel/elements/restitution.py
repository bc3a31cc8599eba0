"""From the coefficient of restitution to the damping of a contact."""

from __future__ import annotations

import math
from typing import Any

from nivel.lazy import scipy


def damping_of_restitution(restitution: float) -> float:
    """x with ln((1 + x)/(1 - e x)) = x (1 + e), see `nivel.kernels.forces.impact`; zero for e = 1."""
    e = restitution
    if e >= 1.0 - 1e-9:
        return 0.0

    def excess(x: float) -> float:
        return math.log1p(x) - math.log1p(-e * x) - x * (1.0 + e)

    # negative just above the root at zero (-(1 - e²) x²/2), infinite at 1/e
    largest = 1.0 / e
    gap = 1e-3 * largest
    while excess(largest - gap) <= 0.0:
        gap *= 1e-3
        if gap < 1e-15 * largest:
            return largest
    root: Any = scipy.optimize.bisect(excess, 1e-6 * (1.0 - e), largest - gap, xtol=1e-15)
    return float(root)
