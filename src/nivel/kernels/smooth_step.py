"""A step that is smooth to its second derivative: `step` of expressions.

With s = (x - x0)/(x1 - x0) between 0 and 1: y0 + (y1 - y0)(10 s³ - 15 s⁴ + 6 s⁵), the polynomial of lowest degree whose first and second
derivatives vanish at both ends.
"""

from __future__ import annotations

from nivel.kernels.analytic import real
from nivel.native.function import leaf


@leaf
def step(x, x0, y0, x1, y1):
    """y0 up to x0, y1 from x1 on, and a smooth way between them."""
    s = (x - x0) / (x1 - x0)
    if real(s) <= 0.0:
        return y0 + 0.0 * s
    if real(s) >= 1.0:
        return y1 + 0.0 * s
    return y0 + (y1 - y0) * (s * s * s * (10.0 + s * (-15.0 + s * 6.0)))


@leaf
def step_rate(x, x0, y0, x1, y1):
    """Derivative of `step` with respect to x."""
    s = (x - x0) / (x1 - x0)
    if real(s) <= 0.0 or real(s) >= 1.0:
        return 0.0 * (s + y0 + y1)
    return (y1 - y0) / (x1 - x0) * (30.0 * s * s * (1.0 - s) * (1.0 - s))


@leaf
def step_acceleration(x, x0, y0, x1, y1):
    """Second derivative of `step` with respect to x."""
    s = (x - x0) / (x1 - x0)
    if real(s) <= 0.0 or real(s) >= 1.0:
        return 0.0 * (s + y0 + y1)
    return (y1 - y0) / ((x1 - x0) * (x1 - x0)) * (60.0 * s * (1.0 - s) * (1.0 - 2.0 * s))
