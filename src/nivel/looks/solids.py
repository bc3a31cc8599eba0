"""Shapes of bodies as flat faces, in the body frame."""

from itertools import pairwise, product
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct, field
from nivel.machine.bodies.surface import surface_arrays
from nivel.machine.core.vectors import Array

FACETS = 48  # of a cylinder: its silhouette is round to 0.2 % of the radius
MOST_FACES = 4000  # of a mesh, to keep the picture small
# outlined edges of a face of what is turned: none, and those around the axis
SMOOTH, RIMS = np.zeros(4, dtype=bool), np.array([True, False, True, False])
FEW_FACETS, FEWEST_FACETS = 20, 8  # in a machine of many bodies, to keep the picture small


class Face(Struct, frozen=False):
    """A flat convex face: corners (n, 3) [m], counter-clockwise seen from outside.

    outlined : whether the edge from each corner to the next is a real edge of the solid, (n,) bool.
    """

    corners: Array
    normal: Array
    outlined: NDArray[np.bool_] = field(default_factory=lambda: np.ones(4, dtype=bool))


class Ball(Struct, frozen=False):
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
        case "ellipsoid":
            faces = _ellipsoid(np.array(shape["semi_axes"], dtype=float), facets)
        case "cylinder":
            faces = _round(shape["length"], [shape["radius"]], shape.get("along") or "x", facets)
        case "tube":
            radii = [shape["outer_radius"], shape["inner_radius"]]
            faces = _round(shape["length"], radii, shape.get("along") or "x", facets)
        case "capsule":
            faces = _lathe(
                _capsule_profile(shape["radius"], shape["length"]), shape.get("along") or "x", facets, SMOOTH
            )
        case "extrusion":
            faces = _prism(np.array(shape["outline"], dtype=float), shape["length"], shape.get("along") or "x")
        case "mesh":
            faces = _mesh(*surface_arrays(shape["surface"]))
        case other:
            raise ValueError(f"no picture of the shape {other}")
    for face in faces:
        face.corners = face.corners + centre
    return faces


def shapes_of(body: dict[str, Any]) -> list[dict[str, Any]]:
    """All shapes by which a body of the scene is drawn: its own, and its further looks."""
    return [*([body["shape"]] if body.get("shape") else []), *body.get("looks", ())]


def reach_of(body: dict[str, Any]) -> Array:
    """(n, 3) [m] as `reach`, of all shapes of a body; none where it has none."""
    return np.concatenate([np.empty((0, 3)), *(reach(each) for each in shapes_of(body))])


def reach(shape: dict[str, Any]) -> Array:
    """(n, 3) [m] points in the body frame whose extent is that of the shape."""
    if shape["type"] == "mesh":
        return surface_arrays(shape["surface"])[0]
    return np.array(shape.get("centre") or [0.0, 0.0, 0.0], dtype=float) + _rims(shape)


def _rims(shape: dict[str, Any]) -> Array:
    """(n, 3) points around a shape at the origin."""
    axis = "xyz".index(shape.get("along") or "x")
    turn = 2.0 * np.pi * np.arange(FACETS) / FACETS
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    match shape["type"]:
        case "box":
            return 0.5 * np.array(shape["size"], dtype=float) * np.array(list(product((-1.0, 1.0), repeat=3)))
        case "sphere":
            return shape["radius"] * np.concatenate([np.eye(3), -np.eye(3)])
        case "ellipsoid":
            return np.concatenate([np.diag(shape["semi_axes"]), -np.diag(shape["semi_axes"])])
        case "extrusion":
            section = np.array(shape["outline"], dtype=float)
        case "capsule":
            tip = (0.5 * shape["length"] + shape["radius"]) * np.eye(3)[axis]
            return np.concatenate([_at_ends(shape["radius"] * circle, shape["length"], axis), [tip, -tip]])
        case kind:
            section = shape["outer_radius" if kind == "tube" else "radius"] * circle
    return _at_ends(section, shape["length"], axis)


def _at_ends(section: Array, length: float, axis: int) -> Array:
    """(2 n, 3) a section (n, 2) at both ends of an axis."""
    along = np.repeat([-0.5 * length, 0.5 * length], len(section))
    return np.roll(np.column_stack([along, np.tile(section, (2, 1))]), axis, axis=1)


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
    half, outer, inner = 0.5 * length, radii[0], radii[-1]
    if len(radii) > 1:
        profile = np.array([(-half, inner), (-half, outer), (half, outer), (half, inner), (-half, inner)])
        return _lathe(profile, along, facets, RIMS)
    turn, axis = 2.0 * np.pi * np.arange(facets) / facets, "xyz".index(along)
    circle, up, whole = np.stack([np.cos(turn), np.sin(turn)], axis=1), np.eye(3)[axis], np.ones(facets, dtype=bool)
    low, high = np.split(_at_ends(outer * circle, length, axis), 2)
    walls = _lathe(np.array([(-half, outer), (half, outer)]), along, facets, RIMS)
    return [*walls, Face(high, up, whole), Face(low[::-1], -up, whole)]


def _capsule_profile(radius: float, straight: float) -> Array:
    """(n, 2) place along the axis and distance from it, from one end to the other."""
    angle = np.linspace(0.0, 0.5 * np.pi, 7)
    cap = np.stack([0.5 * straight + radius * np.sin(angle), radius * np.cos(angle)], axis=1)
    return np.concatenate([(cap * [-1.0, 1.0])[::-1], cap if straight else cap[1:]])


def _lathe(profile: Array, along: str, facets: int, outlined: NDArray[np.bool_]) -> list[Face]:
    """The profile (n, 2), with the solid to the side of the axis, turned about that. outlined : edges of each face."""
    turn = 2.0 * np.pi * np.arange(facets + 1) / facets
    order = [("xyz".index(along) + k) % 3 for k in range(3)]
    faces = []
    for (s0, r0), (s1, r1) in pairwise(profile):
        for a, b in pairwise(turn):
            ring = [(s0, r0, a), (s0, r0, b), (s1, r1, b), (s1, r1, a)]
            corners = np.zeros((4, 3))
            corners[:, order] = [(s, r * np.cos(t), r * np.sin(t)) for s, r, t in ring]
            middle = 0.5 * (a + b)
            normal = np.zeros(3)
            normal[order] = [r0 - r1, (s1 - s0) * np.cos(middle), (s1 - s0) * np.sin(middle)]
            faces.append(Face(corners, normal / np.linalg.norm(normal), outlined))
    return faces


def _ellipsoid(semi_axes: Array, facets: int) -> list[Face]:
    """A ball of radius 1, stretched."""
    faces = _lathe(_capsule_profile(1.0, 0.0), "z", facets, SMOOTH)
    for face in faces:
        face.corners = face.corners * semi_axes
        normal = face.normal / semi_axes
        face.normal = normal / np.linalg.norm(normal)
    return faces


def _prism(outline: Array, length: float, along: str) -> list[Face]:
    """The outline (n, 2) drawn along an axis; its ends are triangles, since a face is convex."""
    axis, n = "xyz".index(along), len(outline)
    a, b = outline, np.roll(outline, -1, axis=0)
    if np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) < 0.0:
        outline = outline[::-1]
    low, high = np.split(_at_ends(outline, length, axis), 2)
    faces = []
    for k in range(n):
        side = [k, (k + 1) % n]
        a, b = outline[side]
        normal = np.roll([0.0, b[1] - a[1], a[0] - b[0]], axis)
        faces.append(Face(np.concatenate([low[side], high[side[::-1]]]), normal / np.linalg.norm(normal)))
    for triangle in ears(outline):
        rim = np.array([(j - i) % n == 1 for i, j in pairwise([*triangle, triangle[0]])])
        up = np.eye(3)[axis]
        faces.append(Face(high[list(triangle)], up, rim))
        faces.append(Face(low[list(triangle)][::-1], -up, rim[[1, 0, 2]]))
    return faces


def ears(outline: Array) -> list[tuple[int, int, int]]:
    """Triangles of a simple polygon (n, 2), counter-clockwise: corners whose triangle holds no other corner are cut off one by one."""
    left, out = list(range(len(outline))), []
    while len(left) > 3:
        for k, tip in enumerate(left):
            triangle = (left[k - 1], tip, left[(k + 1) % len(left)])
            p, q, r = outline[list(triangle)]
            others = outline[[each for each in left if each not in triangle]]
            if _turn(p, q, r[None])[0] > 0.0 and not np.any(
                (_turn(p, q, others) >= 0.0) & (_turn(q, r, others) >= 0.0) & (_turn(r, p, others) >= 0.0)
            ):
                out.append(triangle)
                left.pop(k)
                break
        else:  # corners on a line: nothing to see
            left.pop(0)
    return [*out, (left[0], left[1], left[2])]


def _turn(a: Array, b: Array, x: Array) -> Array:
    """Twice the signed area of the triangles from a to b to each of x (n, 2)."""
    return (b[0] - a[0]) * (x[:, 1] - a[1]) - (b[1] - a[1]) * (x[:, 0] - a[0])


def _mesh(vertices: Array, triangles: NDArray[np.uint32]) -> list[Face]:
    """Triangles as faces; of a mesh too fine for a drawing some, evenly taken."""
    step = -(-len(triangles) // MOST_FACES)
    corners = vertices[triangles[::step]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    return [
        Face(each, normal / size, np.zeros(3, dtype=bool))
        for each, normal, size in zip(corners, normals, lengths, strict=True)
        if size > 0.0
    ]


def held_points(scene: dict[str, Any], body: dict[str, Any]) -> Array:
    """(n, 3) [m] points in the body's frame where joints and forces hold it."""
    points = [*body.get("points", []), *attached(scene, body["name"])]
    return np.reshape(np.asarray(points, dtype=float), (-1, 3))


def attached(scene: dict[str, Any], body: str) -> list[list[float]]:
    """Points of a body where forces hold it."""
    return [
        point
        for force in scene.get("forces", [])
        if force["type"] not in ("contact", "track")
        for name, point in zip(force["bodies"], force["points"], strict=True)
        if name == body
    ]


def link_ends(body: dict[str, Any], held: Array) -> Array:
    """(m, 3) [m] those of the points `held` (n, 3) to which links lead: all without a shape, else those that lie outside of it."""
    return held[_outside(reach_of(body), held)] if shapes_of(body) else held


def _outside(extent: Array, points: Array) -> NDArray[np.bool_]:
    """Which points (n, 3) of the body frame lie outside the box around others."""
    slack = 1e-3 * np.ptp(extent, axis=0).max()
    low, high = extent.min(axis=0) - slack, extent.max(axis=0) + slack
    return np.any((points < low) | (points > high), axis=1)


COLOURS: Final = ("#5b86b4", "#cf7f4f", "#6fa17a", "#9274b0", "#c6a548", "#469c9f", "#bb6a86", "#7d8998")


def colour_of(number: int) -> str:
    """Colour of the body with this number, as `#rrggbb`."""
    return COLOURS[number % len(COLOURS)]


def colour_of_body(body: dict[str, Any], number: int) -> str:
    """Colour of a body of the scene, for what has none of its own: that of its first shape with one, else that of its number."""
    return next((shape["colour"] for shape in shapes_of(body) if "colour" in shape), colour_of(number))
