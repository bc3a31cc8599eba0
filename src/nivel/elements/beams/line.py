"""Lines of beams: straight, an arc of a circle, or a smooth curve through points; and the axes of the sections along them."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from nivel.lazy import dataclass, scipy
from nivel.machine.core.placement import PARALLEL, frame_between
from nivel.machine.core.vectors import Array

# pieces between points in which the length of a curve is found, four-point Gauss in each
PIECES = 64


class NoCurveError(ValueError):
    """The points give no line, or no axes; `point` : number of the one at fault among those that were given, `up` : whether that is."""

    def __init__(self, message: str, *, point: int | None = None, up: bool = False) -> None:
        super().__init__(message)
        self.point, self.up = point, up


@dataclass(frozen=True)
class Line:
    """A line of `length` [m]. at : place (n, 3) and unit tangent (n, 3) at lengths (n,) from its start. up : normal of an arc's plane."""

    length: float
    at: Callable[[Array], tuple[Array, Array]]
    up: Array | None = None


def straight(start: ArrayLike, end: ArrayLike) -> Line:
    """Raises NoCurveError where the points are one."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    length = float(np.linalg.norm(b - a))
    if length == 0.0:
        raise NoCurveError("the beam ends where it starts: it has no length", point=1)
    t = (b - a) / length
    return Line(length, lambda s: (a + np.outer(s, t), np.tile(t, (len(s), 1))))


def arc(start: ArrayLike, via: ArrayLike, end: ArrayLike) -> Line:
    """The circle through three points. Raises NoCurveError where they are on one line."""
    a, m, b = (np.asarray(each, dtype=float) for each in (start, via, end))
    normal = np.cross(m - a, b - m)
    size = max(float(np.linalg.norm(m - a)), float(np.linalg.norm(b - m)))
    if np.linalg.norm(b - a) <= 1e-9 * size:
        raise NoCurveError("an arc does not end where it starts; a ring goes `through` points", point=2)
    if np.linalg.norm(normal) <= 1e-9 * size**2:
        raise NoCurveError("three points on one line make no arc; leave `via` out for a straight beam", point=1)
    normal = normal / np.linalg.norm(normal)
    # the centre is equally far from all three points, in their plane
    rows = np.array([m - a, b - a, normal])
    centre = np.linalg.solve(rows, [(m @ m - a @ a) / 2.0, (b @ b - a @ a) / 2.0, normal @ a])
    first = a - centre
    radius = float(np.linalg.norm(first))
    x = first / radius
    y = np.cross(normal, x)
    angle = float(np.arctan2((b - centre) @ y, (b - centre) @ x)) % (2.0 * np.pi)

    def at(s: Array) -> tuple[Array, Array]:
        turn = s / radius
        c, n = np.cos(turn)[:, None], np.sin(turn)[:, None]
        return centre + radius * (c * x + n * y), c * y - n * x

    return Line(radius * angle, at, normal)


def smooth(points: ArrayLike) -> Line:
    """A cubic spline through the points, its parameter their distance. Raises NoCurveError where two neighbours are one."""
    p = np.asarray(points, dtype=float)
    steps = np.linalg.norm(np.diff(p, axis=0), axis=1)
    if np.any(steps <= 1e-9 * np.sum(steps)):
        raise NoCurveError("this point of the curve is the same as the one before", point=int(np.argmin(steps)) + 1)
    chord = np.concatenate([[0.0], np.cumsum(steps)])
    spline = scipy.interpolate.CubicSpline(chord, p)
    slope = spline.derivative()
    knots = np.concatenate([np.linspace(a, b, PIECES, endpoint=False) for a, b in pairwise(chord)] + [chord[-1:]])
    place, weight = np.polynomial.legendre.leggauss(4)
    half = 0.5 * np.diff(knots)
    inside = (knots[:-1] + half)[:, None] + half[:, None] * place
    pieces = half * (np.linalg.norm(slope(inside), axis=2) @ weight)
    reached = np.concatenate([[0.0], np.cumsum(pieces)])

    def at(s: Array) -> tuple[Array, Array]:
        u = np.interp(s, reached, knots)
        for _ in range(4):  # Newton's iteration for the parameter at this length
            k = np.clip(np.searchsorted(knots, u) - 1, 0, len(half) - 1)
            h = 0.5 * (u - knots[k])
            done = reached[k] + h * (
                np.linalg.norm(slope((knots[k] + h)[:, None] + h[:, None] * place), axis=2) @ weight
            )
            u = np.clip(u - (done - s) / np.linalg.norm(slope(u), axis=1), chord[0], chord[-1])
        tangent = slope(u)
        return spline(u), tangent / np.linalg.norm(tangent, axis=1)[:, None]

    return Line(float(reached[-1]), at)


def axes_along(line: Line, s: Array, up: Array | None, twist: float) -> Array:
    """(n, 3, 3) columns x, y, z of the sections at lengths s (n,): x along the line, z as near to `up` as it can be.

    Without `up`: the normal of an arc's plane; for a straight beam global Z (of a vertical one Y); on other curves the axes at the start
    are carried along without twisting. twist : turn about x at the end [rad], growing with the length.
    Raises NoCurveError where the line runs along `up`.
    """
    _, tangent = line.at(s)
    up = line.up if up is None else up
    axes: Any
    if up is None:
        axes = _carried(line, s)
    else:
        z = up - (tangent @ up)[:, None] * tangent
        size = np.linalg.norm(z, axis=1)
        if np.any(size <= PARALLEL * np.linalg.norm(up)):
            raise NoCurveError("the beam runs along `up` somewhere; it must point across the beam", up=True)
        z = z / size[:, None]
        axes = np.stack([tangent, np.cross(z, tangent), z], axis=2)
    turn: Array = twist * s / line.length
    c, n = np.cos(turn)[:, None], np.sin(turn)[:, None]
    y, z = axes[:, :, 1], axes[:, :, 2]
    return np.stack([axes[:, :, 0], c * y + n * z, c * z - n * y], axis=2)


def _carried(line: Line, s: Array) -> Array:
    """Axes that turn with the tangent only (double reflection: Wang, Jüttler, Zheng, Liu 2008, "Computation of rotation minimizing
    frames")."""
    fine = np.union1d(s, np.linspace(0.0, line.length, 33))
    place, tangent = line.at(fine)
    axes = np.zeros((len(fine), 3, 3))
    axes[0] = frame_between(np.zeros(3), tangent[0])
    z = axes[0, :, 2]
    for k in range(1, len(fine)):
        step = place[k] - place[k - 1]
        square = step @ step
        if square > 0.0:
            mirrored = z - 2.0 / square * (step @ z) * step
            along = tangent[k - 1] - 2.0 / square * (step @ tangent[k - 1]) * step
            bend = tangent[k] - along
            if bend @ bend > 0.0:
                mirrored = mirrored - 2.0 / (bend @ bend) * (bend @ mirrored) * bend
            z = mirrored - (mirrored @ tangent[k]) * tangent[k]
            z = z / np.linalg.norm(z)
        axes[k] = np.column_stack([tangent[k], np.cross(z, tangent[k]), z])
    return axes[np.searchsorted(fine, s)]
