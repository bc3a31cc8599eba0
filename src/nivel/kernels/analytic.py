"""Functions that stay analytic when a kernel runs on complex numbers (exact tangents by complex step).

Comparison, `abs` and `norm` of complex numbers either fail in Numba or drop the derivative; these branch on real parts.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import leaf


@leaf
def real(x):
    """Real part: what a branch may look at."""
    return np.real(x)


@leaf
def arctan2(y, x):
    """Angle of the point (x, y): np.arctan2, which does not know complex numbers, and of these its analytic continuation."""
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
    """The larger one; x where they are equal, and where y is not a number."""
    return y if real(y) > real(x) else x


@leaf
def minimum(x, y):
    """The smaller one; x where they are equal, and where y is not a number."""
    return y if real(y) < real(x) else x
