"""Convex hulls in numbers: corners, faces as polygons, edges; and the row of numbers of two of them for the contact kernel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.kernels.forces import hull_contact as kernel
from nivel.machine.body import Body
from nivel.machine.shape import Box, Extrusion, Mesh
from nivel.machine.solids import box_size, extrusion_corners, mesh_surface

Array = NDArray[np.float64]
# Triangles whose normals and places agree to this, of 1 and of the size of the hull, are one face.
FLAT = 1e-6
# Edges are compared in pairs, so that many of them take long.
MOST_CORNERS = 200


@dataclass(frozen=True)
class Hull:
    """corners (n, 3) [m]; normals (f, 3) outwards; faces: numbers of their corners, counterclockwise; edges: two corners, two faces."""

    corners: Array
    normals: Array
    faces: list[list[int]]
    edges: list[tuple[int, int, int, int]]


def hull_of(body: Body) -> Hull:
    """The convex hull of a box, an extrusion or a mesh in the body frame. Raises ModelError for a flat one, or one of too many corners."""
    from scipy.spatial import ConvexHull, QhullError

    points = _points(body)
    try:
        found = ConvexHull(points)
    except QhullError:
        raise _fault(body, "is flat, and a contact of two bodies needs two solids") from None
    corners = points[found.vertices]
    if len(corners) > MOST_CORNERS:
        raise _fault(
            body,
            f"has a hull of {len(corners)} corners, and at most {MOST_CORNERS} can touch another body: give the body a coarser mesh; "
            "`looks` may still draw the fine one",
        )
    size = float(np.ptp(corners, axis=0).max())
    normals, faces = [], []
    for normal, offset in _planes(found.equations, size):
        on = np.flatnonzero(np.abs(corners @ normal + offset) <= 10.0 * FLAT * size)
        faces.append(_counterclockwise(corners, on, normal))
        normals.append(normal)
    return Hull(corners, np.array(normals), faces, _edges(faces))


def _points(body: Body) -> Array:
    match body.shape:
        case Box() as box:
            signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
            return np.array(box.centre or (0.0, 0.0, 0.0)) + 0.5 * signs * np.array(box_size(box))
        case Extrusion() as prism:
            return extrusion_corners(prism)
        case Mesh() as mesh:
            return mesh_surface(mesh)[0]
    raise ValueError(f"body {body.name} has no hull")


def _planes(equations: Array, size: float) -> list[tuple[Array, float]]:
    """Normal and offset of every face, of coplanar triangles once."""
    planes: list[tuple[Array, float]] = []
    for *normal, offset in equations:
        if not any(
            np.abs(normal - known).max() <= FLAT and abs(offset - its) <= FLAT * size for known, its in planes
        ):
            planes.append((np.array(normal), float(offset)))
    return planes


def _counterclockwise(corners: Array, on: NDArray[np.int64], normal: Array) -> list[int]:
    """The corners `on` a face in the order in which they go round its normal."""
    apart = corners[on] - corners[on].mean(axis=0)
    x = apart[0] / np.linalg.norm(apart[0])
    angles = np.arctan2(apart @ np.cross(normal, x), apart @ x)
    return on[np.argsort(angles)].tolist()


def _edges(faces: list[list[int]]) -> list[tuple[int, int, int, int]]:
    """Begin, end, the face to the left of it and the face to the right."""
    left = {
        (a, b): k for k, face in enumerate(faces) for a, b in zip(face, [*face[1:], face[0]], strict=True)
    }
    return [(a, b, k, left[b, a]) for (a, b), k in left.items() if a < b and (b, a) in left]


def numbers_of(hulls: tuple[Hull, Hull], behind: int) -> list[float]:
    """What stands behind the first `behind` numbers of a contact of two hulls: see `nivel.kernels.forces.hull_contact`."""
    place = behind + kernel.HEADER
    header, blocks = [], []
    for hull in hulls:
        spans = [[0.0, 0.0]] * len(hull.faces)
        start = 0
        for k, face in enumerate(hull.faces):
            spans[k] = [float(start), float(len(face))]
            start += len(face)
        faces = np.hstack([hull.normals, spans]).ravel().tolist()
        parts = [hull.corners.ravel().tolist(), faces, [float(v) for face in hull.faces for v in face]]
        parts.append([float(each) for edge in hull.edges for each in edge])
        parts.append([0.0] * hull.corners.size)  # corners in global axes, work
        header += [len(hull.corners), len(hull.faces), len(hull.edges)]
        for part in parts:
            header.append(place)
            place += len(part)
            blocks += part
    most = sum(max(map(len, hull.faces)) for hull in hulls) + 4
    header += [place, place + 3 * most]
    return [*map(float, header), *blocks, *[0.0] * (6 * most)]


def _fault(body: Body, said: str) -> ModelError:
    return ModelError(Fault("", 0, 0, f"bodies.{body.name}.shape", said))
