"""Functions that are the same on real and on dual numbers (`nivel.native.duals`), also where a value is none or nothing."""

from __future__ import annotations

import numpy as np

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
    if np.abs(real(x)) >= np.abs(real(y)):
        angle = np.arctan(y / x)
        if real(x) < 0.0:
            angle += np.pi if real(y) >= 0.0 else -np.pi
    else:
        angle = -np.arctan(x / y)
        angle += 0.5 * np.pi if real(y) > 0.0 else -0.5 * np.pi
    return angle


@leaf
def absolute(x):
    """|x|."""
    return -x if real(x) < 0.0 else x


@leaf
def maximum(x, y):
    """The larger one; x where they are equal, no number where one of them is none."""
    return y if real(y) > real(x) or real(y) != real(y) else x


@leaf
def minimum(x, y):
    """The smaller one; x where they are equal, no number where one of them is none."""
    return y if real(y) < real(x) or real(y) != real(y) else x


@leaf
def tanh(x):
    """Hyperbolic tangent."""
    return np.tanh(x)
