"""Geometric elimination with the energy constraint (report 44, eqs. 121–136): positions and velocities are put back onto the
constraints as by direct correction, then the velocities are scaled to the energy that the machine must have
(`nivel.integrate.loop.energy`).

Eq. 136 as printed leaves Ċ free and diverges; in this order every level holds.
"""

from __future__ import annotations

from nivel.integrate.stabilise.direct import TOLERANCE

CORRECTS, CONSERVES = True, True


def coefficients(step: float, alpha: float | None, beta: float | None) -> tuple[float, float, float, float]:
    """(0, 0, tolerance of |C|, tolerance of |Ċ|), shares of the scales of the rows."""
    del step, alpha, beta
    return 0.0, 0.0, TOLERANCE, TOLERANCE
