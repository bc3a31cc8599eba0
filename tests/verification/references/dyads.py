"""Planar linkages by circles: the four-bar and Watt's six-bar with two ternary links, input angle to all other angles.

A dyad closes a loop where two circles meet: from P with radius a and from Q with radius b, with d = Q - P, r = |d|,

    along = (r² + a² - b²)/(2 r),   height = √(a² - along²),   point = P + along d/r ± height J d/r,   J (x, y) = (-y, x).

Written with NumPy's analytic functions, so that a complex step gives exact derivatives.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating | np.complexfloating]


def meet(P: Array, a: float, Q: Array, b: float, side: int) -> Array:
    """(2, n): the point at distance a from P (2, n) and b from Q, left (+1) or right (-1) of P → Q."""
    d = Q - P
    r = np.sqrt(d[0] ** 2 + d[1] ** 2)
    along = (r**2 + a**2 - b**2) / (2 * r)
    height = np.sqrt(a**2 - along**2)
    normal = np.array([-d[1], d[0]])
    return P + along * d / r + side * height * normal / r


@dataclass(frozen=True)
class SixBar:
    """Watt's six-bar: crank O–A, coupler A–B, ternary link B–C–D turning at C, second coupler D–E, rocker E–F.

    O is the origin; C and F are fixed. The ternary link has B at distance `bc` and D at `cd` from C, D turned by `offset`
    from the direction C → B. sides : of B seen from A → C, of E seen from D → F.
    """

    crank: float
    coupler: float
    bc: float
    cd: float
    offset: float
    second_coupler: float
    rocker: float
    C: tuple[float, float]
    F: tuple[float, float]
    sides: tuple[int, int] = (1, 1)

    def points(self, angle: Array) -> dict[str, Array]:
        """A, B, D, E (2, n) at the crank angle (n,)."""
        angle = np.asarray(angle)
        one = np.ones_like(angle)
        C, F = (np.array([p[0] * one, p[1] * one]) for p in (self.C, self.F))
        A = self.crank * np.array([np.cos(angle), np.sin(angle)])
        B = meet(A, self.coupler, C, self.bc, self.sides[0])
        u = (B - C) / self.bc
        c, s = np.cos(self.offset), np.sin(self.offset)
        D = C + self.cd * np.array([c * u[0] - s * u[1], s * u[0] + c * u[1]])
        E = meet(D, self.second_coupler, F, self.rocker, self.sides[1])
        return {"A": A, "B": B, "D": D, "E": E, "C": C, "F": F}
