"""Spatial RSSR linkage: crank and rocker turn about skew axes, a rod with a ball at each end connects them.

With unit axes u, the crank's ball at P(φ) = O1 + rotation of p0 about u1, the rocker's at Q(ψ) = O2 + rotation of q0
about u2, and q0 split into e1 = q0 (perpendicular to u2) and e2 = u2 × q0 plus an axial part h,

    Q = O2 + h + e1 cos ψ + e2 sin ψ,   |Q - P|² = L²   →   a cos ψ + b sin ψ = c,
    a = e1·k, b = e2·k, k = O2 + h - P, c = (L² - |k|² - |e1|²)/2,   ψ = atan2(b, a) ± acos(c/√(a² + b²)).

(Freudenstein's equation of the spatial four-bar, Hartenberg & Denavit 1964, here from vectors.)
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Arm:
    """A body that turns about `axis` through `pivot`; its ball is at `ball` where the angle is zero. Global, [m]."""

    pivot: tuple[float, float, float]
    axis: tuple[float, float, float]
    ball: tuple[float, float, float]

    def parts(self) -> tuple[Array, Array, Array]:
        """Centre of the ball's circle, and its two radii e1, e2 = u × e1."""
        u = np.asarray(self.axis, float) / np.linalg.norm(self.axis)
        arm = np.subtract(self.ball, self.pivot)
        along = (arm @ u) * u
        return np.asarray(self.pivot) + along, arm - along, np.cross(u, arm)

    def at(self, angle: Array) -> Array:
        """(n, 3): the ball at the angles (n,)."""
        centre, e1, e2 = self.parts()
        return centre + np.multiply.outer(np.cos(angle), e1) + np.multiply.outer(np.sin(angle), e2)

    def rate(self, angle: Array) -> Array:
        """(n, 3): derivative of the ball's place with respect to the angle."""
        _, e1, e2 = self.parts()
        return np.multiply.outer(-np.sin(angle), e1) + np.multiply.outer(np.cos(angle), e2)


def output(crank: Arm, rocker: Arm, rod: float, angle: Array, branch: int) -> Array:
    """ψ (n,) of the rocker at the crank angles (n,); branch ±1."""
    centre, e1, e2 = rocker.parts()
    k = centre - crank.at(angle)
    a, b = k @ e1, k @ e2
    c = (rod**2 - np.sum(k**2, axis=1) - e1 @ e1) / 2
    return np.arctan2(b, a) + branch * np.arccos(c / np.hypot(a, b))


def slopes(crank: Arm, rocker: Arm, angle: Array, out: Array) -> Array:
    """dψ/dφ (n,): (Q - P)·(Q' dψ - P' dφ) = 0, with P' = u1 × (P - O1)."""
    d = rocker.at(out) - crank.at(angle)
    P1, Q1 = crank.rate(angle), rocker.rate(out)
    return np.sum(d * P1, axis=1) / np.sum(d * Q1, axis=1)
