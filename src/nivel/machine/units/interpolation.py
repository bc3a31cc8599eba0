"""Piecewise polynomials through points: straight lines, splines, and curves that do not overshoot."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from functools import lru_cache
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import scipy

Interpolation = Literal["linear", "cubic", "monotone", "quintic", "periodic"]
INTERPOLATIONS: Final = ("linear", "cubic", "monotone", "quintic", "periodic")
PERIODIC: Final = "periodic"
# whose speeds and accelerations jump nowhere, at no end
SMOOTH: Final = ("quintic", PERIODIC)
FEWEST: Final = {"linear": 1, "cubic": 3, "monotone": 2, "quintic": 2, "periodic": 4}  # points
STRAIGHT, CURVED = 4, 6  # coefficients of a piece, up to cubic and of a quintic


def pieces(kind: str, points: Sequence[float], values: Sequence[float]) -> NDArray[np.float64]:
    """The polynomials between the points: value = Σ c[k, i] h^i with h = x - points[k].

    linear: straight lines. cubic: a natural spline, not bent at its ends. monotone: cubic pieces with one slope at a point that neither
    rise nor fall where the values do not (Fritsch & Butland 1984). quintic: a spline with four continuous derivatives, of which the first
    and the second are zero at both ends. periodic: a spline with two continuous derivatives, at the seam too, which goes on without end.

    returns (n - 1, 4), of a quintic (n - 1, 6); SI
    """
    x, y = np.array(points, dtype=float), np.array(values, dtype=float)
    if kind == "linear":
        straight = np.zeros((len(x) - 1, STRAIGHT))
        straight[:, 0] = y[:-1]
        straight[:, 1] = np.diff(y) / np.diff(x)
        return straight
    if kind == "cubic":
        curve = scipy.interpolate.CubicSpline(x, y, bc_type="natural").c
    elif kind == PERIODIC:
        y[-1] = y[0]
        curve = scipy.interpolate.CubicSpline(x, y, bc_type="periodic").c
    elif kind == "monotone":
        curve = scipy.interpolate.PchipInterpolator(x, y).c
    else:
        rest = [(1, 0.0), (2, 0.0)]
        curve = _between(
            x,
            scipy.interpolate.PPoly.from_spline(scipy.interpolate.make_interp_spline(x, y, k=5, bc_type=(rest, rest))),
        )
    return np.ascontiguousarray(curve[::-1].T)


def _between(x: NDArray[np.float64], curve: object) -> NDArray[np.float64]:
    """Coefficients (6, n - 1) of the pieces between the points, highest power first, without the empty ones at the ends of a spline."""
    knots, coefficients = np.asarray(curve.x), np.asarray(curve.c)  # type: ignore[attr-defined]
    return coefficients[:, [int(np.flatnonzero(knots == point)[-1]) for point in x[:-1]]]


def misses_its_period(kind: str, values: Sequence[float]) -> bool:
    """Whether a periodic curve does not end with the value with which it begins."""
    return kind == PERIODIC and abs(values[-1] - values[0]) > 1e-9 * max(map(abs, values))


def differentiated(coefficients: NDArray[np.float64], order: int) -> NDArray[np.float64]:
    """Coefficients (n - 1, 6) of the derivative of this order."""
    out = np.zeros((coefficients.shape[0], CURVED))
    out[:, : coefficients.shape[1]] = coefficients
    for _ in range(order):
        out = np.hstack([out[:, 1:] * np.arange(1, CURVED), np.zeros((len(out), 1))])
    return out


def interpolated(kind: str, points: Sequence[float], values: Sequence[float], x: float, order: int = 0) -> float:
    """Value at x of the curve through the points, or of its derivative; beyond the ends the end values hold, unless it is periodic."""
    if kind == PERIODIC:
        x = points[0] + (x - points[0]) % (points[-1] - points[0])
    if x < points[0]:
        return float(values[0]) if order == 0 else 0.0
    if x >= points[-1]:
        return float(values[-1]) if order == 0 else 0.0
    k = bisect_right(points, x) - 1
    return float(np.polynomial.polynomial.polyval(x - points[k], _curve(kind, tuple(points), tuple(values), order)[k]))


@lru_cache(maxsize=100)
def _curve(kind: str, points: tuple[float, ...], values: tuple[float, ...], order: int) -> NDArray[np.float64]:
    return differentiated(pieces(kind, points, values), order)
