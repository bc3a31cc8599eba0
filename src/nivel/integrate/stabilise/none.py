"""No stabilisation: constraints hold at the acceleration level only, and drift."""

from __future__ import annotations

CORRECTS, CONSERVES = False, False


def coefficients(step: float, alpha: float | None, beta: float | None) -> tuple[float, float, float, float]:
    """All zero."""
    del step, alpha, beta
    return 0.0, 0.0, 0.0, 0.0
