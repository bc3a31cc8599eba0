"""Functions that stay analytic when a kernel runs on complex numbers (exact tangents by complex step).

Comparison, `abs` and `norm` of complex numbers either fail in Numba or drop the derivative; these branch on real parts.
"""

from __future__ import annotations

import numpy as np

from nivel.native.function import leaf


@leaf
def real(x):
    """Real part: what a branch may look at."""
    return np.real(x)


@leaf
def arctan2(y, x):
    """Angle of the point (x, y), 0 at the origin: np.arctan2, which does not know complex numbers, and its analytic continuation."""
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
    """np.tanh, which is ±1 to round-off from 20 on and on complex numbers overflows from 355 on."""
    return np.tanh(minimum(maximum(x, -40.0), 40.0))


@leaf
def power(x, y):
    """x ** y. Through a logarithm, as the power of complex numbers is, a negative x would leave round-off of the size of the result in
    place of the derivative: y x**(y - 1) along x, log x x**y along y."""
    a, b = real(x), real(y)
    value = a**b
    result = value
    if np.imag(x) != 0.0 and b != 0.0:
        result = result + b * a ** (b - 1.0) * (x - a)
    if np.imag(y) != 0.0:
        result = result + np.log(a) * value * (y - b)
    return result


@leaf
def real_power(x, exponent):
    """x ** exponent of x ≥ 0 and a real exponent."""
    n, along, slope = real(exponent), np.imag(x), 0.0
    value = real(x) ** n
    if along != 0.0:
        slope = n * real(x) ** (n - 1.0)
    return value + slope * (x - real(x))


@leaf
def hypot(x, y):
    """√(x² + y²)."""
    return np.sqrt(x * x + y * y)


@leaf
def copysign(x, y):
    """|x| with the sign of y."""
    return x * (np.copysign(1.0, real(x)) * np.copysign(1.0, real(y)))


@leaf
def modulo(x, y):
    """What is left of x after whole multiples of y."""
    return x - y * np.floor(real(x) / real(y))
