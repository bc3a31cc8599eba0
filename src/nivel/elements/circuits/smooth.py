"""Smooth forms of ramps, steps and maxima, whose derivatives are finite everywhere; they branch on real parts alone."""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.native.function import leaf


@leaf
def ramp(z, width):
    """0 below zero, z - width/2 above `width`, width (t³ - t⁴/2) between them, t = z/width: two continuous derivatives."""
    if real(z) <= 0.0:
        return 0.0 * z
    if real(z) >= real(width):
        return z - 0.5 * width
    t = z * (1.0 / width)
    return width * t * t * t * (1.0 - 0.5 * t)


@leaf
def step(t):
    """0 below zero, 1 above one, 3 t² - 2 t³ between them: the slope of `ramp`."""
    if real(t) <= 0.0:
        return 0.0 * t
    if real(t) >= 1.0:
        return 0.0 * t + 1.0
    return t * t * (3.0 - 2.0 * t)


@leaf
def maximum_within(a, b, width):
    """The larger one, rounded: too high by width/2 where both are equal."""
    return 0.5 * (a + b + np.sqrt((a - b) * (a - b) + width * width))


@leaf
def sign_within(x, width):
    """The sign of x, rounded: x/√(x² + width²)."""
    return x / np.sqrt(x * x + width * width)


@leaf
def magnitude_within(x, width):
    """The magnitude of x, rounded: √(x² + width²)."""
    return np.sqrt(x * x + width * width)


@leaf
def root_flow(difference, corner, secant):
    """Δp (Δp² + c²)^(-1/4), which is ±√|Δp| beyond the corner c [Pa] and Δp/√c within.

    secant : on dual numbers, the derivative is that of a line through the origin. A linearly implicit step with the tangent in place of
    the secant rings for ever, because it is one step of Newton's method on a root.
    """
    size = real(difference) * real(difference) + corner * corner
    slope = 1.0 / np.sqrt(np.sqrt(size))
    if secant == 1:
        return slope * difference
    # of dual numbers the first derivative: that of (Δp² + c²)^(-1/4) is -½ Δp (Δp² + c²)^(-5/4)
    change = difference - real(difference)
    return slope * (difference - 0.5 * real(difference) * real(difference) / size * change)


@leaf
def slope_of_step(t):
    """That of `step` at a real t."""
    return 6.0 * t * (1.0 - t) if 0.0 < t < 1.0 else 0.0


@leaf
def clipped(x, least):
    """x between `least` and one."""
    if real(x) > 1.0:
        return 0.0 * x + 1.0
    if real(x) < real(least):
        return 0.0 * x + least
    return x
