"""Volume, centroid and moments of homogeneous shapes in the body frame."""

from functools import lru_cache

import numpy as np

from nivel.lazy import scipy
from nivel.machine.bodies.shape import (
    Box,
    Capsule,
    Cylinder,
    Ellipsoid,
    Extrusion,
    Long,
    Mesh,
    Shape,
    Sphere,
    Tube,
    section,
)
from nivel.machine.bodies.surface import Enclosed, Triangles, enclosed, surface_arrays, welded, why_open
from nivel.machine.core.orientation import rotation_matrix
from nivel.machine.core.vectors import Array


def length(shape: Long) -> float:
    """[m] along the bar, from `length` or the two points; of a box along x, of a capsule without its ends."""
    if shape.from_ is not None and shape.to is not None:
        return float(np.linalg.norm(np.subtract(shape.to, shape.from_)))
    if isinstance(shape, Box):
        return shape.size[0] if shape.size else 0.0
    return shape.length or 0.0


def box_size(box: Box) -> tuple[float, float, float]:
    """[m] along the body x, y and z axes."""
    return box.size or (length(box), box.width or 0.0, box.height or 0.0)


def volume(shape: Shape) -> float:
    """[m³]"""
    match shape:
        case Box():
            return float(np.prod(box_size(shape)))
        case Cylinder():
            return float(np.pi * shape.radius**2 * length(shape))
        case Capsule():
            return float(np.pi * shape.radius**2 * (length(shape) + 4 / 3 * shape.radius))
        case Tube():
            return float(np.pi * (shape.outer_radius**2 - shape.inner_radius**2) * length(shape))
        case Sphere():
            return float(4 / 3 * np.pi * shape.radius**3)
        case Ellipsoid():
            return float(4 / 3 * np.pi * np.prod(shape.semi_axes))
        case Extrusion():
            return section(np.array(shape.outline)).area * length(shape)
        case Mesh():
            return _inside(shape).volume * shape.unit**3


def centroid(shape: Shape) -> Array:
    """(3,) [m] in the body frame."""
    match shape:
        case Mesh():
            return _in_body(shape, _inside(shape).centre)
        case Extrusion():
            out = np.array(shape.centre or (0.0, 0.0, 0.0))
            _, a, b = axes_of(shape.along)
            out[[a, b]] += section(np.array(shape.outline)).centroid
            return out
        case _:
            return np.array(shape.centre or (0.0, 0.0, 0.0))


def squared_gyration(shape: Shape) -> Array:
    """(3, 3) [m²] inertia tensor per unit mass about the centroid, body axes."""
    match shape:
        case Box():
            a, b, c = box_size(shape)
            return np.diag([b**2 + c**2, a**2 + c**2, a**2 + b**2]) / 12
        case Cylinder():
            return _of_round_bar(shape.radius**2, length(shape), shape.along)
        case Capsule():
            return _of_capsule(shape.radius, length(shape), shape.along)
        case Tube():
            return _of_round_bar(shape.outer_radius**2 + shape.inner_radius**2, length(shape), shape.along)
        case Sphere():
            return 0.4 * shape.radius**2 * np.eye(3)
        case Ellipsoid():
            a, b, c = shape.semi_axes
            return np.diag([b**2 + c**2, a**2 + c**2, a**2 + b**2]) / 5
        case Extrusion():
            return _of_extrusion(shape)
        case Mesh():
            A, inside = rotation_matrix(shape.orientation), _inside(shape)
            return A @ inside.moments @ A.T * (shape.unit**2 / inside.volume)


def axes_of(along: str | None) -> tuple[int, int, int]:
    """Numbers of the axis `along` and of the two that follow it."""
    first = "xyz".index(along or "x")
    return first, (first + 1) % 3, (first + 2) % 3


def _of_round_bar(radii_squared: float, bar_length: float, along: str | None) -> Array:
    """Per unit mass, of a round bar: `radii_squared` is R², with a bore R² + r²."""
    moments = np.full(3, radii_squared / 4 + bar_length**2 / 12)
    moments[axes_of(along)[0]] = radii_squared / 2
    return np.diag(moments)


def _of_capsule(radius: float, straight: float, along: str | None) -> Array:
    """Per unit mass, of a cylinder and two hemispheres, whose centroids are 3/8 of the radius off their flat sides."""
    bar, balls = straight, 4 / 3 * radius  # volumes over π R²
    across = bar * (radius**2 / 4 + straight**2 / 12)
    across += balls * (0.4 * radius**2 + straight**2 / 4 + 3 / 8 * radius * straight)
    moments = np.full(3, across / (bar + balls))
    moments[axes_of(along)[0]] = (bar * radius**2 / 2 + balls * 0.4 * radius**2) / (bar + balls)
    return np.diag(moments)


def _of_extrusion(shape: Extrusion) -> Array:
    """Per unit mass: ∫ x xᵀ of the outline in its plane, length²/12 along it."""
    flat = section(np.array(shape.outline))
    axis, a, b = axes_of(shape.along)
    second = np.zeros((3, 3))
    second[np.ix_([a, b], [a, b])] = flat.second / flat.area
    second[axis, axis] = length(shape) ** 2 / 12
    return np.trace(second) * np.eye(3) - second


def extrusion_corners(shape: Extrusion) -> Array:
    """(2 n, 3) [m] the corners of both ends in the body frame."""
    axis, a, b = axes_of(shape.along)
    out = np.zeros((2, len(shape.outline), 3))
    out[:, :, axis] = np.array([[-0.5], [0.5]]) * length(shape)
    out[:, :, [a, b]] = np.array(shape.outline)
    return out.reshape(-1, 3) + np.array(shape.centre or (0.0, 0.0, 0.0))


# --- meshes ---


def mesh_surface(mesh: Mesh) -> tuple[Array, Triangles]:
    """vertices (n, 3) [m] in the body frame and triangles (m, 3)."""
    vertices, triangles = surface_arrays(mesh.surface or "")
    return _in_body(mesh, vertices), triangles


def part_corners(mesh: Mesh, part: int) -> Array:
    """(n, 3) [m] corners of a convex part, counted from 1, in the body frame. Raises ValueError where the mesh has no such part."""
    if mesh.parts is None or not 1 <= part <= len(mesh.parts):
        raise ValueError(f"the mesh has {len(mesh.parts or ())} convex parts, and {part} was asked for")
    return _in_body(mesh, surface_arrays(mesh.parts[part - 1])[0])


def share_of_hull(shape: Extrusion | Mesh) -> float:
    """Volume of a solid by that of its convex hull; 1 of a mesh that encloses none."""
    if isinstance(shape, Extrusion):
        outline = np.array(shape.outline)
        return abs(section(outline).area) / float(scipy.spatial.ConvexHull(outline).volume)
    return 1.0 if why_not_solid(shape) else _share_of_hull(shape.surface or "")


@lru_cache(maxsize=64)
def _share_of_hull(surface: str) -> float:
    return _enclosed(surface).volume / float(scipy.spatial.ConvexHull(surface_arrays(surface)[0]).volume)


def why_not_solid(mesh: Mesh) -> str:
    """Why a mesh encloses no certain volume, or an empty text."""
    vertices, triangles = _welded(mesh.surface or "")
    if not len(triangles):
        return "the surface has no area"
    why = why_open(triangles)
    if why:
        return why
    size = float(np.ptp(vertices, axis=0).max())
    return "" if enclosed(vertices, triangles).volume > 1e-12 * size**3 else "the surface encloses no volume"


def _in_body(mesh: Mesh, points: Array) -> Array:
    """Points (…, 3) of the file in the body frame."""
    return points @ (mesh.unit * rotation_matrix(mesh.orientation).T) + np.array(mesh.position or (0.0, 0.0, 0.0))


def _inside(mesh: Mesh) -> Enclosed:
    return _enclosed(mesh.surface or "")


@lru_cache(maxsize=64)
def _enclosed(surface: str) -> Enclosed:
    return enclosed(*_welded(surface))


@lru_cache(maxsize=64)
def _welded(surface: str) -> tuple[Array, Triangles]:
    return welded(*surface_arrays(surface))
