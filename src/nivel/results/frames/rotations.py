"""Rotations of frames of results."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def rotation_matrices(theta: Array) -> Array:
    """(n, 3, 3) of Euler parameters (n, 4), scalar first and of unit length: columns are the axes of the frames."""
    e0, e = theta[:, 0], theta[:, 1:]
    tilde = np.zeros((len(theta), 3, 3))
    tilde[:, [2, 0, 1], [1, 2, 0]], tilde[:, [1, 2, 0], [2, 0, 1]] = e, -e
    return np.eye(3) + 2.0 * (e0[:, None, None] * tilde + tilde @ tilde)
