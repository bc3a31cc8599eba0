"""Rigid motions of a finite-element model."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def rigid_modes(position: Array, freedoms: NDArray[np.int64], count: int, about: Array | None = None) -> Array:
    """(count, 6): displacements for unit translations along x, y, z and unit turns about axes through `about`.

    position : (n, 3) [m]; freedoms : (n, 6) row of each freedom of the nodes, -1 where there is none; about : (3,) [m],
    default the origin.
    """
    R = np.zeros((count, 6))
    x = position - (0.0 if about is None else about)
    has = freedoms >= 0
    for a in range(3):
        b, c = (a + 1) % 3, (a + 2) % 3
        R[freedoms[has[:, a], a], a] = 1.0
        R[freedoms[has[:, 3 + a], 3 + a], 3 + a] = 1.0
        # a turn about a moves c by x_b and b by -x_c
        R[freedoms[has[:, c], c], 3 + a] = x[has[:, c], b]
        R[freedoms[has[:, b], b], 3 + a] = -x[has[:, b], c]
    return R
