"""Shapes that touch in numbers: their markers, balls that hold them, corners, and convex hulls."""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.known import Contact, SystemBuilder
from nivel.lazy import Struct, scipy
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Ellipsoid, Extrusion, Mesh, Sphere
from nivel.machine.bodies.solids import box_size, extrusion_corners, length, mesh_surface, part_corners
from nivel.machine.bodies.touching import Touching
from nivel.machine.core.placement import frame_from_axes

Array = NDArray[np.float64]
# Triangles whose normals agree to this are one face.
FLAT = 1e-6
# of the prism that stands for a cylinder where it touches a solid: its radius is within 0.3 % of the cylinder's everywhere
SIDES = 32
# Faces are compared in pairs, so that many of them take long.
MOST_FACES = 200


class Hull(Struct):
    """middle (3,) [m] in the frame of the shape; corners (n, 3) from there; faces (f, 4): outward normal, distance; edges (e, 2): their
    corners."""

    middle: Array
    corners: Array
    faces: Array
    edges: NDArray[np.int64]

    @property
    def radius(self) -> float:
        """[m] of a ball about the middle that holds the hull."""
        return float(np.linalg.norm(self.corners, axis=1).max())


def hull_of(body: Touching, part: int | None = None) -> Hull:
    """The convex hull of a box, a cylinder, an extrusion or a mesh, or of a convex part of a mesh, counted from 1.

    Raises ModelError for a flat one, or one of too many faces.
    """
    try:
        hull = hull_of_points(_points(body, part))
    except scipy.spatial.QhullError:
        raise _fault(body, "is flat, and a contact of two bodies needs two solids") from None
    if len(hull.faces) > MOST_FACES:
        message = (
            f"has a hull of {len(hull.faces)} faces, and at most {MOST_FACES} can touch another body: give the body a coarser mesh; "
            "`looks` may still draw the fine one"
        )
        raise _fault(body, message)
    return hull


def hull_of_points(points: Array) -> Hull:
    """The convex hull of points (n, 3) [m] of a body. Raises QhullError where they lie in a plane."""
    return _hull_of(np.ascontiguousarray(points, dtype=float).tobytes())


@lru_cache(maxsize=1000)
def _hull_of(content: bytes) -> Hull:
    """The same of the bytes of the points: every contact of a solid asks for its hull, and so do checks of each run."""
    points = np.frombuffer(content).reshape(-1, 3)
    found = scipy.spatial.ConvexHull(points)
    corners = points[found.vertices]
    middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    normals = _distinct(found.equations[:, :3])
    corners = corners - middle
    # no corner lies outside of a face, whatever the round-off of its normal
    faces = np.column_stack([normals, (corners @ normals.T).max(axis=0)])
    return Hull(middle, corners, faces, _edges(corners, faces))


def part_of(force: Contact, bodies: Sequence[Touching], k: int) -> int | None:
    """The convex part with which body k of a contact touches, counted from 1; None where its whole hull does. Raises ModelError."""
    shape = bodies[k].shape
    if not isinstance(shape, Mesh) or shape.parts is None:
        return None
    if force.parts is None:
        message = (
            f"`{bodies[k].name}` has `convex_parts`, and only contacts in the file of the body know how many: write the contact there, or "
            f"give the contact the numbers of the `parts` of both bodies"
        )
        raise ModelError(Fault("", 0, 0, f"forces.{force.name}", message))
    part = int(force.parts[k])
    if not 1 <= part <= len(shape.parts):
        message = f"`{bodies[k].name}` has {len(shape.parts)} convex parts, counted from 1, and {part} was asked for"
        raise ModelError(Fault("", 0, 0, f"forces.{force.name}.parts", message))
    return part


def _points(body: Touching, part: int | None) -> Array:
    match body.shape:
        case Mesh() as mesh if part is not None:
            return part_corners(mesh, part)
        case Box() as box:
            signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
            return np.array(box.centre or (0.0, 0.0, 0.0)) + 0.5 * signs * np.array(box_size(box))
        case Cylinder() as cylinder:
            return _prism(cylinder)
        case Extrusion() as prism:
            return extrusion_corners(prism)
        case Mesh() as mesh:
            return mesh_surface(mesh)[0]
    raise ValueError(f"{body.name} has no hull")


def _prism(cylinder: Cylinder) -> Array:
    """Corners of the regular prism of SIDES sides that has the volume of a cylinder."""
    turn = 2.0 * np.pi / SIDES
    angles, radius = turn * np.arange(SIDES), cylinder.radius * np.sqrt(turn / np.sin(turn))
    circle, half = radius * np.column_stack([np.cos(angles), np.sin(angles)]), 0.5 * length(cylinder)
    along = "xyz".index(cylinder.along or "x")
    points = np.zeros((2, SIDES, 3))
    points[:, :, (along + 1) % 3], points[:, :, (along + 2) % 3] = circle[:, 0], circle[:, 1]
    points[0, :, along], points[1, :, along] = -half, half
    return points.reshape(-1, 3) + np.array(cylinder.centre or (0.0, 0.0, 0.0))


def _distinct(normals: Array) -> Array:
    """The normals of all faces, of coplanar triangles once."""
    alike = np.abs(normals[:, None] - normals[None, :]).max(axis=2) <= FLAT
    return np.asarray(normals[~np.tril(alike, -1).any(axis=1)])


def _edges(corners: Array, faces: Array) -> NDArray[np.int64]:
    """Pairs of corners that lie on two faces at once: an edge, or a diagonal of a face twice found, which does no harm."""
    size = float(np.abs(corners).max())
    on = np.abs(corners @ faces[:, :3].T - faces[:, 3]) <= 10.0 * FLAT * size
    common = on.astype(np.int64) @ on.T.astype(np.int64)
    return np.argwhere(np.triu(common >= 2, 1))


def polytope_of(body: Touching, part: int | None) -> list[float]:
    """Counts of corners, faces and edges, then these, in the axes of the body's marker."""
    hull = hull_of(body, part)
    # a box and a cylinder have their marker in the middle, a cylinder z along it
    is_centred = isinstance(body.shape, Box | Cylinder)
    shift = np.zeros(3) if is_centred else hull.middle
    axes = np.eye(3)
    if isinstance(body.shape, Cylinder):
        axes = frame_from_axes(np.eye(3)["xyz".index(body.shape.along or "x")])
    corners, faces = hull.corners @ axes + shift, hull.faces.copy()
    faces[:, :3] = faces[:, :3] @ axes
    faces[:, 3] += faces[:, :3] @ shift
    ends = corners[hull.edges].reshape(-1, 6)
    counts = [float(len(each)) for each in (corners, faces, ends)]
    return [*counts, *corners.ravel().tolist(), *faces.ravel().tolist(), *ends.ravel().tolist()]


def _fault(body: Touching, said: str) -> ModelError:
    return ModelError(Fault("", 0, 0, body.place, said))


MOST_CORNERS = 1000


def ball_of_shape(body: Touching) -> float:
    """[m] radius of a ball about the marker of a shape that holds it."""
    match body.shape:
        case Sphere():
            return body.shape.radius
        case Box():
            return 0.5 * math.hypot(*box_size(body.shape))
        case Cylinder():
            return math.hypot(body.shape.radius, 0.5 * length(body.shape))
        case Capsule():
            return body.shape.radius + 0.5 * length(body.shape)
        case Ellipsoid():
            return max(body.shape.semi_axes)
        case Extrusion() | Mesh():
            return float(np.linalg.norm(corners_of(body), axis=1).max())
    raise ValueError(f"{body.name} has no shape that can touch")


def corners_of(body: Touching) -> NDArray[np.float64]:
    """(n, 3) [m] corners of the convex hull of an extrusion or a mesh, in the frame of the shape: nothing else of it can touch a plane.

    Raises ModelError where there are more than MOST_CORNERS.
    """
    assert isinstance(body.shape, Extrusion | Mesh)  # the record was checked
    points = mesh_surface(body.shape)[0] if isinstance(body.shape, Mesh) else extrusion_corners(body.shape)
    try:
        corners = points[scipy.spatial.ConvexHull(points).vertices]
    except scipy.spatial.QhullError:  # a flat mesh has no hull
        corners = np.unique(points, axis=0)
    if len(corners) > MOST_CORNERS:
        message = (
            f"the hull of the mesh has {len(corners)} corners, and at most {MOST_CORNERS} can touch a plane: give the body a coarser mesh; "
            f"`looks` may still draw the fine one"
        )
        raise ModelError(Fault("", 0, 0, body.place, message))
    return corners


def corners_of_parts(body: Touching) -> NDArray[np.float64]:
    """The same of all convex parts, each once: on ground that is not flat others than those of the hull may touch."""
    if not isinstance(body.shape, Mesh) or body.shape.parts is None:
        return corners_of(body)
    parts = [hull_of(body, part + 1) for part in range(len(body.shape.parts))]
    return np.unique(np.concatenate([each.corners + each.middle for each in parts]).round(9), axis=0)


def shape_marker(builder: SystemBuilder, body: Touching) -> int:
    """Marker at the centre of the shape, z along a cylinder; at the frame of a hull, whose corners are given there."""
    shape = body.shape
    if isinstance(shape, Extrusion | Mesh):
        return builder.place(body.at(np.zeros(3), np.eye(3)))
    assert isinstance(shape, Sphere | Ellipsoid | Box | Cylinder | Capsule)  # the record was checked
    axes = np.eye(3)
    if isinstance(shape, Cylinder | Capsule):
        axes = frame_from_axes(np.eye(3)["xyz".index(shape.along or "x")])
    return builder.place(body.at(np.array(shape.centre or (0.0, 0.0, 0.0), dtype=float), axes))
