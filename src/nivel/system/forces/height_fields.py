"""Ground whose height varies: the contacts on it, and its triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.forces import ground_contact
from nivel.kernels.record.hook import FAMILIES
from nivel.kernels.record.record import Elements
from nivel.machine.bodies.surface import Triangles
from nivel.machine.forces.height_field import HeightField

Array = NDArray[np.float64]


def rows_over_heights(elements: Elements) -> tuple[int, int]:
    """First element of contacts with ground that has heights, and one past the last."""
    for address, (first, last) in zip(elements.address, elements.span, strict=True):
        if FAMILIES.get(int(address)) is ground_contact.apply_over_heights:
            return int(first), int(last)
    return 0, 0


def ground_surface(field: HeightField) -> tuple[Array, Triangles]:
    """vertices (n, 3) [m] in the axes of the plane's marker and triangles (m, 3), seen from above counter-clockwise."""
    heights = field.heights
    rows, columns = heights.shape
    x, y = (np.linspace(-0.5, 0.5, n) * side for n, side in zip((columns, rows), field.size, strict=True))
    vertices = np.stack([*np.meshgrid(x, y), heights], axis=2).reshape(-1, 3)
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    first = np.stack([corner, corner + 1, corner + columns + 1], axis=1)
    second = np.stack([corner, corner + columns + 1, corner + columns], axis=1)
    return vertices, np.concatenate([first, second]).astype(np.uint32)
