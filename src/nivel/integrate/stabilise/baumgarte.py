"""Baumgarte (1972): C̈ + 2 α Ċ + β² C = 0 in place of C̈ = 0 (report 44, eq. 110).

The feedback steers the motion; recorded accelerations and reactions are evaluated without it (`nivel.integrate.loop.loop`).
"""

from __future__ import annotations

CORRECTS, CONSERVES = False, False


def coefficients(step: float, alpha: float | None, beta: float | None) -> tuple[float, float, float, float]:
    """(2α, β², 0, 0); without own α, β [1/s] those of eq. 111, α = 1/Δt and β = √2/Δt."""
    if alpha is None or beta is None:
        return 2.0 / step, 2.0 / step**2, 0.0, 0.0
    return 2.0 * alpha, beta**2, 0.0, 0.0
