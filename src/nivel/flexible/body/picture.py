"""Picture of a flexible body: a surface whose vertices its modes move."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.body.body import ReducedBody
from nivel.lazy import dataclass

Array = NDArray[np.float64]
Triangles = NDArray[np.uint32]

# Bars without a surface of their own are drawn this thick, as a share of the extent of the body.
THICKNESS: Final = 0.012
# More numbers than these in the modes of a surface would make a result too large.
MOST: Final = 3_000_000


@dataclass(frozen=True)
class MovingSurface:
    """vertices (n, 3) [m] undeformed, body frame; triangles (m, 3); modes (k, n, 3) displacement of each vertex by each mode.

    nodes : (n,) place of the node of the body that each vertex is at, or moves with.
    """

    vertices: Array
    triangles: Triangles
    modes: Array
    nodes: NDArray[np.int64]


def moving_surface(body: ReducedBody) -> MovingSurface | None:
    """The surface of a solid, or square bars along lines; None where there is none, or where it has more than MOST numbers."""
    if len(body.triangles):
        used, triangles = np.unique(body.triangles, return_inverse=True)
        displacement = np.nan_to_num(body.modes[used, :3]).transpose(2, 0, 1)
        surface = MovingSurface(body.position[used], triangles.reshape(-1, 3).astype(np.uint32), displacement, used)
    elif len(body.lines):
        surface = _bars(body)
    else:
        return None
    return surface if surface.modes.size <= MOST else None


def _bars(body: ReducedBody) -> MovingSurface:
    """Four vertices at each end of each line; they turn with its nodes."""
    half = 0.5 * THICKNESS * float(np.ptp(body.position, axis=0).max())
    ends = body.position[body.lines[:, :2]]
    along = ends[:, 1] - ends[:, 0]
    across = np.cross(along, np.eye(3)[np.argmin(np.abs(along), axis=1)])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    other = np.cross(along, across)
    other /= np.linalg.norm(other, axis=1, keepdims=True)
    corners = half * np.stack([across + other, -across + other, -across - other, across - other], axis=1)
    vertices = (ends[:, :, None] + corners[:, None]).reshape(-1, 3)
    modes = np.nan_to_num(body.modes[body.lines[:, :2]])  # (lines, 2, 6, k)
    turns = np.cross(modes[:, :, None, 3:], corners[:, None, :, :, None], axis=3)
    displacement = (modes[:, :, None, :3] + turns).reshape(-1, 3, modes.shape[-1]).transpose(2, 0, 1)
    sides = [(k, (k + 1) % 4, 4 + k) for k in range(4)] + [((k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4)]
    caps = [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7)]
    first = 8 * np.arange(len(ends))[:, None, None]
    triangles = (first + np.array([*sides, *caps])).reshape(-1, 3).astype(np.uint32)
    return MovingSurface(vertices, triangles, displacement, np.repeat(body.lines[:, :2], 4).astype(np.int64))
