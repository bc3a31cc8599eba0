"""Polygons in a plane: whether they are sound, and area, centroid and second moments from their corners (Green's theorem)."""

import numpy as np

from nivel.lazy import dataclass
from nivel.machine.core.vectors import Array

NEAR = 1e-12  # of the size of a polygon: corners and areas below it are nothing


@dataclass(frozen=True)
class Section:
    """area [m²], centroid (2,) [m], and second = ∫ x xᵀ dA about the centroid (2, 2) [m⁴] of a polygon."""

    area: float
    centroid: Array
    second: Array


def section(corners: Array) -> Section:
    """Of the polygon with these corners (n, 2), in either order.

    With cross products w of neighbours: A = Σ w / 2, A c = Σ w (a + b)/6, ∫ x xᵀ dA = Σ w (s sᵀ + a aᵀ + b bᵀ)/24, s = a + b.
    """
    middle = corners.mean(axis=0)
    a = corners - middle
    b = np.roll(a, -1, axis=0)
    w = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    area = 0.5 * float(w.sum())
    s = a + b
    centroid = w @ s / (6.0 * area)
    second = sum(np.einsum("n,ni,nj->ij", w, each, each) for each in (s, a, b)) / 24.0
    second = second - area * np.outer(centroid, centroid)
    return Section(abs(area), middle + centroid, np.sign(area) * second)


def bad_outline(corners: Array) -> str:
    """Why the corners (n, 2) are no polygon with an inside, or an empty text."""
    if len(corners) < 3:
        return f"at least three corners were expected, got {len(corners)}"
    size = float(np.ptp(corners, axis=0).max())
    following = np.roll(corners, -1, axis=0)
    short = np.flatnonzero(np.abs(following - corners).max(axis=1) <= NEAR * size)
    if len(short):
        return f"corner {short[0] + 1} stands twice in a row; the outline closes by itself"
    crossing = _crossing(corners, following)
    if crossing is not None:
        return f"the side from corner {crossing[0] + 1} crosses or touches the side from corner {crossing[1] + 1}"
    w = corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]
    return "" if abs(w.sum()) > NEAR * size**2 else "its corners lie on a line"


def _crossing(a: Array, b: Array) -> tuple[int, int] | None:
    """Two sides, from a to b each (n, 2), that are not neighbours and have a point in common."""
    n = len(a)
    for i in range(n - 1):
        others = np.arange(i + 2, n - (i == 0))
        if not len(others):
            continue
        p, q, u, v = a[i], b[i], a[others], b[others]
        sides = (_side(p, q, u) * _side(p, q, v) <= 0.0) & (_side(u, v, p) * _side(u, v, q) <= 0.0)
        near = (np.minimum(p, q) <= np.maximum(u, v)).all(axis=1) & (np.minimum(u, v) <= np.maximum(p, q)).all(axis=1)
        found = others[sides & near]
        if len(found):
            return i, int(found[0])
    return None


def _side(p: Array, q: Array, x: Array) -> Array:
    """Sign of the side of the line from p to q on which x lies."""
    return np.sign(
        (q[..., 0] - p[..., 0]) * (x[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (x[..., 0] - p[..., 0])
    )
