"""Functions that are the same on real and on dual numbers (`nivel.native.duals`), also where a value is none or nothing."""

import numpy as np

from nivel.kernels.core.number import where
from nivel.native.function import leaf


@leaf
def real(x):
    """The value of a dual number."""
    return np.real(x)


@leaf
def arctan2(y, x):
    """Angle of the point (x, y), 0 at the origin; π on the negative x axis, whatever the sign of a zero."""
    if real(x) == 0.0 and real(y) == 0.0:
        return 0.0 * (x + y)
    flat = np.abs(real(x)) >= np.abs(real(y))
    angle = np.arctan(where(flat, y, -x) / where(flat, x, y))
    half = where(real(y) >= 0.0, np.pi, -np.pi)
    return angle + where(flat, where(real(x) < 0.0, half, 0.0), 0.5 * half)


@leaf
def absolute(x):
    """|x|."""
    return where(real(x) < 0.0, -x, x)


@leaf
def maximum(x, y):
    """The larger one; x where they are equal, no number where one of them is none."""
    return where(real(y) <= real(x), x, where(real(x) != real(x), x, y))


@leaf
def minimum(x, y):
    """The smaller one; x where they are equal, no number where one of them is none."""
    return where(real(y) >= real(x), x, where(real(x) != real(x), x, y))


@leaf
def tanh(x):
    """Hyperbolic tangent."""
    return np.tanh(x)
