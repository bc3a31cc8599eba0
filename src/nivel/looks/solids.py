"""Shapes of bodies as flat faces, in the body frame."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FACETS = 48  # of a cylinder: its silhouette is round to 0.2 % of the radius
FEW_FACETS = 20  # in a machine of many bodies, to keep the picture small


@dataclass
class Face:
    """A flat convex face: corners (n, 3) [m], counter-clockwise seen from outside.

    outlined : whether the edge from each corner to the next is a real edge of the solid, (n,) bool.
    """

    corners: Array
    normal: Array
    outlined: NDArray[np.bool_] = field(default_factory=lambda: np.ones(4, dtype=bool))


@dataclass
class Ball:
    """A sphere; it looks the same from everywhere."""

    centre: Array
    radius: float


def solid(shape: dict[str, Any], facets: int = FACETS) -> list[Face] | Ball:
    """The shape as faces, or as a ball. `shape` as in the scene: type, sizes, `centre` and `along` in the body frame."""
    centre = np.array(shape.get("centre") or [0.0, 0.0, 0.0], dtype=float)
    match shape["type"]:
        case "box":
            faces = _box(np.array(shape["size"], dtype=float))
        case "sphere":
            return Ball(centre, float(shape["radius"]))
        case "cylinder":
            faces = _round(shape["length"], [shape["radius"]], shape.get("along") or "x", facets)
        case "tube":
            radii = [shape["outer_radius"], shape["inner_radius"]]
            faces = _round(shape["length"], radii, shape.get("along") or "x", facets)
        case other:
            raise ValueError(f"no picture of the shape {other}")
    for face in faces:
        face.corners = face.corners + centre
    return faces


def reach(shape: dict[str, Any]) -> Array:
    """(n, 3) [m] points in the body frame whose extent is that of the shape."""
    parts = solid(shape)
    if isinstance(parts, Ball):
        return parts.centre + parts.radius * np.concatenate([np.eye(3), -np.eye(3)])
    return np.concatenate([face.corners for face in parts])


def _box(size: Array) -> list[Face]:
    faces = []
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        for sign in (1.0, -1.0):
            corners = np.zeros((4, 3))
            corners[:, axis] = sign
            corners[:, b] = sign * np.array([-1.0, 1.0, 1.0, -1.0])
            corners[:, c] = [-1.0, -1.0, 1.0, 1.0]
            normal = np.zeros(3)
            normal[axis] = sign
            faces.append(Face(0.5 * size * corners, normal))
    return faces


def _round(length: float, radii: list[float], along: str, facets: int) -> list[Face]:
    """A cylinder, or with a second radius a tube, about the axis `along`."""
    turn = 2.0 * np.pi * np.arange(facets + 1) / facets
    axis = "xyz".index(along)
    order = [(axis + k) % 3 for k in range(3)]  # places of (axis, first, second cross direction)

    def place(s: Array | float, y: Array | float, z: Array | float) -> Array:
        out = np.empty((*np.broadcast(s, y, z).shape, 3))
        out[..., order[0]], out[..., order[1]], out[..., order[2]] = s, y, z
        return out

    faces = []
    for radius, outwards in zip(radii, (1.0, -1.0), strict=False):
        y, z = radius * np.cos(turn), radius * np.sin(turn)
        for k in range(facets):
            ends = np.array([-0.5, -0.5, 0.5, 0.5]) * length
            pick = [k, k + 1, k + 1, k]
            middle = 0.5 * (turn[k] + turn[k + 1])
            corners = place(ends, y[pick], z[pick])[:: int(outwards)]
            rim = np.array([True, False, True, False])
            normal = outwards * place(0.0, np.cos(middle), np.sin(middle))
            faces.append(Face(corners, normal, rim))
    for end in (1.0, -1.0):
        normal = place(end, 0.0, 0.0)
        if len(radii) == 1:
            ring = place(0.5 * end * length, radii[0] * np.cos(turn[:-1]), radii[0] * np.sin(turn[:-1]))[:: int(end)]
            faces.append(Face(ring, normal, np.ones(facets, dtype=bool)))
            continue
        outer, inner = (place(0.5 * end * length, r * np.cos(turn), r * np.sin(turn)) for r in radii)
        for k in range(facets):
            corners = np.stack([outer[k], outer[k + 1], inner[k + 1], inner[k]])[:: int(end)]
            faces.append(Face(corners, normal, np.array([True, False, True, False])))
    return faces
