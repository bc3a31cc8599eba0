"""Contacts of a mechanism in the data of a machine file: a marker with a shape for each solid that touches, a force for each pair."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from nivel.exchange.bodies import Group, marker_frame
from nivel.exchange.looks import Drawing, NotFoundError
from nivel.exchange.mechanism import WORLD, Array, Frame, Look, Mechanism, Solid, Touch
from nivel.exchange.translation import Names, number, triple, turn
from nivel.lazy import scipy
from nivel.machine.core.record import GROUND

ROUND: Final = ("sphere", "capsule", "ellipsoid")
CORNERS: Final = 48  # of the hull of a mesh: of two hulls the faces are compared in pairs
FEET: Final = 4  # points on which a flat side stands, each with the stiffness of a point
SOFT: Final = (
    "contacts are springs that sink as deep as those of the model under a steady load, damped as they are there"
)


def contacts_of(
    mechanism: Mechanism, groups: dict[str, Group], names: Names, drawing: Drawing
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Markers with the shapes that touch, and forces."""
    markers: dict[str, Any] = {}
    forces: dict[str, Any] = {}
    areas: dict[str, float] = {}
    for touch in mechanism.touches:
        pair = [mechanism.solids[touch.first], mechanism.solids[touch.second]]
        for solid in pair:
            if solid.name not in areas:
                areas[solid.name] = _add_marker(solid, markers, mechanism, groups, names, drawing)
        if not all(areas[solid.name] for solid in pair):
            continue
        force = _force(touch, pair, [names.name("marker", solid.name) for solid in pair], areas)
        forces[names.new(f"{touch.first}_{touch.second}", "force")] = force
    if forces:
        mechanism.notes.change(SOFT)
    return markers, forces


def _force(touch: Touch, pair: list[Solid], markers: list[str], areas: dict[str, float]) -> dict[str, Any]:
    common = {"damping": number(touch.damping), **({"friction": number(touch.friction)} if touch.friction else {})}
    stiffness = float(f"{touch.stiffness:.6g}")
    for solid, own, other in zip(pair, markers, markers[::-1], strict=True):
        if solid.look.kind == "plane":
            return {"type": "contact", "body": other, "plane": own, "stiffness": stiffness, "exponent": 1, **common}
    out: dict[str, Any] = {"type": "contact", "bodies": markers}
    if any(solid.look.kind in ROUND for solid in pair):
        return out | {"stiffness": stiffness, "exponent": 1, **common}
    area = min(areas[solid.name] for solid in pair)
    return out | {"foundation_modulus": float(f"{FEET * touch.stiffness / area:.6g}"), **common}


def _add_marker(
    solid: Solid,
    markers: dict[str, Any],
    mechanism: Mechanism,
    groups: dict[str, Group],
    names: Names,
    drawing: Drawing,
) -> float:
    """Add the marker of a solid; returns the area [m²] of its middle side, 0 where it cannot touch."""
    group, look = groups[solid.link], solid.look
    frame = look.place if solid.link == WORLD else marker_frame(mechanism, group, solid.link) @ look.place
    try:
        shape, area = _shape(solid, mechanism, drawing)
    except (NotFoundError, scipy.spatial.QhullError) as problem:
        why = str(problem) if isinstance(problem, NotFoundError) else "a flat mesh"
        mechanism.notes.leave(f"contacts: {why}", solid.name, look.line, acts=True)
        return 0.0
    body = GROUND if group.first == WORLD else names.name("body", group.first)
    place = {"position": triple(frame.origin)} if np.any(frame.origin) else {}
    markers[names.name("marker", solid.name)] = {"body": body, **place, **turn(frame.axes), **shape}
    return area


def _shape(solid: Solid, mechanism: Mechanism, drawing: Drawing) -> tuple[dict[str, Any], float]:
    look = solid.look
    sizes = [number(each) for each in look.sizes]
    match look.kind:
        case "plane":
            return {}, 1.0
        case "sphere":
            return {"shape": {"type": "sphere", "radius": sizes[0]}}, sizes[0] ** 2
        case "ellipsoid":
            return {"shape": {"type": "ellipsoid", "semi_axes": sizes}}, sorted(sizes)[1] ** 2
        case "box":
            middle = sorted(sizes)
            return {"shape": {"type": "box", "size": sizes}}, middle[1] * middle[2]
        case "cylinder" | "capsule":
            extents = sorted((2.0 * sizes[0], 2.0 * sizes[0], sizes[1]))
            kept = {"type": look.kind, "radius": sizes[0], "length": sizes[1], "along": "z"}
            return {"shape": kept}, extents[1] * extents[2]
    hull = _hull(look, drawing)
    corners, gap = _simplified(hull)
    if gap > 0.0:
        mechanism.notes.change(
            f"meshes touch with hulls of up to {CORNERS} corners", f"{solid.name} within {gap * 1e3:.2g} mm", look.line
        )
    faces = scipy.spatial.ConvexHull(corners).simplices
    extents = sorted(np.ptp(corners, axis=0))
    written = drawing.surface(f"{solid.name}_hull", (corners, _outwards(corners, faces)), Frame())
    return {"shape": written}, float(extents[1] * extents[2])


def _hull(look: Look, drawing: Drawing) -> Array:
    points = look.surface[0] if look.surface is not None else drawing.vertices(look)
    return np.asarray(points[scipy.spatial.ConvexHull(points).vertices], dtype=float)


def _simplified(points: Array) -> tuple[Array, float]:
    """At most CORNERS corners of a hull, farthest in directions that are about evenly apart, and by how much [m] others are outside."""
    if len(points) <= CORNERS:
        return points, 0.0
    k = np.arange(CORNERS) + 0.5
    height, around = 1.0 - 2.0 * k / CORNERS, np.pi * (1.0 + np.sqrt(5.0)) * k
    radius = np.sqrt(1.0 - height * height)
    directions = np.column_stack([radius * np.cos(around), radius * np.sin(around), height])
    corners = points[np.unique(np.argmax(points @ directions.T, axis=0))]
    planes = scipy.spatial.ConvexHull(corners).equations
    return corners, max(float((points @ planes[:, :3].T + planes[:, 3]).max()), 0.0)


def _outwards(corners: Array, faces: Any) -> Any:
    """The faces with their corners counted against the clock, seen from outside."""
    a, b, c = (corners[faces[:, k]] for k in range(3))
    out = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - corners.mean(axis=0)) > 0.0
    return np.where(out[:, None], faces, faces[:, ::-1]).astype(np.uint32)
