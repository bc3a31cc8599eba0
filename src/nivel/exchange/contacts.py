"""Contacts of a mechanism in the data of a machine file: a marker with a shape for each solid that touches, a force for each pair.

URDF and SDF name no pairs: there solids of different models touch, and links of a model where it says so (`self_collide`), but for those
that a joint connects. A point whose surface has no stiffness sinks by SINK under the weight of the model, damped critically.
"""

from typing import Any, Final

import numpy as np

from nivel.exchange.bodies import marker_on
from nivel.exchange.looks import Drawing, NotFoundError
from nivel.exchange.mechanism import WORLD, Array, Frame, Look, Mechanism, Solid, Surface, Touch
from nivel.exchange.translation import number
from nivel.lazy import scipy

ROUND: Final = ("sphere", "capsule", "ellipsoid")
CORNERS: Final = 48  # of the hull of a mesh: of two hulls the faces are compared in pairs
FEET: Final = 4  # points on which a flat side or a free model stands, each with the stiffness of a point
SINK: Final = 0.5e-3  # [m]
HARD: Final = 1e10  # [N/m]: a stiffness from here on stands for a rigid surface
GRAVITY: Final = 9.81  # [m/s²] where the model has no weight
LEFT: Final = "collision geometry; a contact is a force of type `contact`"
RIGID: Final = f"contacts of rigid surfaces sink by {SINK * 1e3:g} mm under the weight of the model on one point, damped critically"
BELOW: Final = "a ground is put below the lowest point of the model"
SOFT: Final = (
    "contacts are springs that sink as deep as those of the model under a steady load, damped as they are there"
)


def contacts_of(mechanism: Mechanism, drawing: Drawing) -> tuple[dict[str, Any], dict[str, Any]]:
    """Markers with the shapes that touch, and forces."""
    markers: dict[str, Any] = {}
    forces: dict[str, Any] = {}
    areas: dict[str, float] = {}
    for touch in mechanism.touches:
        pair = [mechanism.solids[touch.first], mechanism.solids[touch.second]]
        if mechanism.groups[pair[0].link].first == mechanism.groups[pair[1].link].first:  # as where a weld holds both
            continue
        for solid in pair:
            if solid.name not in areas:
                areas[solid.name] = _add_marker(solid, markers, mechanism, drawing)
        if not all(areas[solid.name] for solid in pair):
            continue
        force = _force(touch, pair, [mechanism.names.name("marker", solid.name) for solid in pair], areas)
        forces[mechanism.names.new(f"{touch.first}_{touch.second}", "force")] = force
    if forces and mechanism.format == "MJCF":
        mechanism.notes.change(SOFT)
    return markers, forces


def add_solid(
    mechanism: Mechanism, given: str, link: str, look: Look | str, surface: Surface, model: str, line: int
) -> None:
    """Add what a <collision> of a link is, or note that it is not read."""
    if isinstance(look, str):
        mechanism.notes.leave(f"collision geometry {f'<{look}>' if look else 'without a shape'}", link, line, acts=True)
        return
    owner = link or model or "world"
    base = given if given.startswith(owner) else f"{owner}_{given}"
    name, count = base, 2
    while name in mechanism.solids:
        name, count = f"{base}_{count}", count + 1
    mechanism.solids[name] = Solid(name, link, look, surface, model)


def meet(mechanism: Mechanism, drawing: Drawing) -> None:
    """Find what touches where the file names no pairs, and raise free models out of planes, to half of what a foot sinks there."""
    if mechanism.solids and not mechanism.touches:
        _pair(mechanism, drawing)
    lifts: dict[frozenset[str], Array] = {}
    parts, weight = _components(mechanism), _gravity(mechanism)
    held = {name for each in mechanism.connections if WORLD in each.bodies for name in each.bodies}
    for touch in mechanism.touches:
        pair = (mechanism.solids[touch.first], mechanism.solids[touch.second])
        plane = next((each for each in pair if each.look.kind == "plane" and each.link == WORLD), None)
        other = pair[1] if plane is pair[0] else pair[0]
        if plane is None or other.link == WORLD or parts[other.link] & held:
            continue
        normal, part = plane.look.place.axes[:, 2], parts[other.link]
        sunk = float(normal @ plane.look.place.origin) - _lowest(other, normal, mechanism, drawing)
        more = sunk - 0.5 * _mass(mechanism, part) * weight / (FEET * touch.stiffness)
        if more > float(np.linalg.norm(lifts.get(part, np.zeros(3)))):
            lifts[part] = more * normal
    for part, lift in lifts.items():
        for name in part:
            place = mechanism.links[name].place
            mechanism.links[name].place = Frame(place.axes, place.origin + lift)
        for each in mechanism.connections:
            if part & set(each.bodies):
                each.point = each.point + lift
        height = float(np.linalg.norm(lift)) * 1e3
        mechanism.notes.change("a model that begins inside a plane is raised out of it", f"by {height:.3g} mm")


def _pair(mechanism: Mechanism, drawing: Drawing) -> None:
    """Add the pairs of solids that may touch, and the ground."""
    moving = [each for each in mechanism.solids.values() if mechanism.groups[each.link].first != WORLD]
    if mechanism.stands and moving:
        lowest = min(_lowest(each, np.array([0.0, 0.0, 1.0]), mechanism, drawing) for each in moving)
        if not np.isfinite(lowest):
            mechanism.notes.leave(
                "contacts with the ground: the meshes of all that could touch it are missing", acts=True
            )
        else:
            place = Frame(origin=np.array([0.0, 0.0, lowest]))
            mechanism.solids["ground_plane"] = Solid("ground_plane", WORLD, Look("plane", place))
            mechanism.notes.change(f"{BELOW}: at z = {lowest:.4g} m")
    ends_of = [[mechanism.groups[name].first for name in each.bodies] for each in mechanism.connections]
    joined = {frozenset(each) for each in ends_of}
    between_axes = (name for name, each in mechanism.links.items() if each.inertial is None)
    for name in between_axes:
        near = {end for each in ends_of if name in each for end in each}
        joined |= {frozenset((one, other)) for one in near for other in near}
    masses = {name: _mass(mechanism, part) for name, part in _components(mechanism).items()}
    solids = list(mechanism.solids.values())
    for k, first in enumerate(solids):
        for second in solids[k + 1 :]:
            ends = {mechanism.groups[first.link].first, mechanism.groups[second.link].first}
            same = first.apart_from != "" and first.apart_from == second.apart_from
            if len(ends) == 1 or same or {first.look.kind, second.look.kind} == {"plane"}:
                continue
            if WORLD not in ends and frozenset(ends) in joined:
                continue
            mechanism.touches.append(_touch_of(first, second, masses, mechanism))
    if moving and not mechanism.touches:
        mechanism.notes.leave("collision geometry that has nothing to touch", ", ".join(each.name for each in moving))


def _touch_of(first: Solid, second: Solid, masses: dict[str, float], mechanism: Mechanism) -> Touch:
    surfaces = (first.surface, second.surface)
    soft = [each.stiffness for each in surfaces if each.stiffness is not None and 0.0 < each.stiffness < HARD]
    inverse = sum(1.0 / masses[each.link] for each in (first, second) if masses.get(each.link))
    mass = 1.0 / inverse if inverse else 1.0
    gravity = _gravity(mechanism)
    stiffness = 1.0 / sum(1.0 / each for each in soft) if soft else mass * gravity / SINK
    if not soft:
        mechanism.notes.change(RIGID)
    given = max(each.damping or 0.0 for each in surfaces)
    damping = max(given, 2.0 * float(np.sqrt(stiffness * mass))) / (mass * gravity)
    return Touch(first.name, second.name, min(each.friction for each in surfaces), stiffness, damping)


def _gravity(mechanism: Mechanism) -> float:
    return float(np.linalg.norm(mechanism.gravity)) or GRAVITY


def _mass(mechanism: Mechanism, part: frozenset[str]) -> float:
    given = (mechanism.links[name].inertial for name in part)
    return sum(each.mass for each in given if each is not None)


def _components(mechanism: Mechanism) -> dict[str, frozenset[str]]:
    """Each link with all that joints connect it with, but for the ground."""
    near: dict[str, set[str]] = {name: set() for name in mechanism.links}
    for first, second in (each.bodies for each in mechanism.connections if WORLD not in each.bodies):
        near[first].add(second)
        near[second].add(first)
    parts: dict[str, frozenset[str]] = {}
    for name in mechanism.links:
        found, pending = {name}, [name]
        while pending and name not in parts:
            more = near[pending.pop()] - found
            found, pending = found | more, [*pending, *more]
        parts = dict.fromkeys(found, frozenset(found)) | parts
    return parts


def _lowest(solid: Solid, normal: Array, mechanism: Mechanism, drawing: Drawing) -> float:
    """[m] least coordinate of a solid along a direction where its link stands; infinite where its mesh is not found."""
    look, frame = solid.look, mechanism.links[solid.link].place @ solid.look.place
    down, sizes = -frame.axes.T @ normal, np.array(look.sizes)
    match look.kind:
        case "sphere":
            reach = sizes[0]
        case "box":
            reach = 0.5 * np.abs(down) @ sizes
        case "ellipsoid":
            reach = np.linalg.norm(sizes * down)
        case "cylinder":
            reach = sizes[0] * np.hypot(down[0], down[1]) + 0.5 * sizes[1] * abs(down[2])
        case "capsule":
            reach = sizes[0] + 0.5 * sizes[1] * abs(down[2])
        case _:
            try:
                reach = (_hull(look, drawing) @ down).max()
            except (NotFoundError, scipy.spatial.QhullError):
                return np.inf
    return float(normal @ frame.origin - reach)


def _force(touch: Touch, pair: list[Solid], markers: list[str], areas: dict[str, float]) -> dict[str, Any]:
    common = {"damping": number(touch.damping)}
    if touch.friction:  # of an evenly pressed disc the lever of a spin is 2/3 of the radius
        radius = 1.5 * touch.spin / touch.friction
        given = {"friction": touch.friction, "patch_radius": radius, "rolling_resistance": touch.roll}
        common |= {key: number(value) for key, value in given.items() if value}
    stiffness = float(f"{touch.stiffness:.6g}")
    for solid, own, other in zip(pair, markers, markers[::-1], strict=True):
        if solid.look.kind == "plane":
            return {"type": "contact", "body": other, "plane": own, "stiffness": stiffness, "exponent": 1, **common}
    out: dict[str, Any] = {"type": "contact", "bodies": markers}
    if any(solid.look.kind in ROUND for solid in pair):
        return out | {"stiffness": stiffness, "exponent": 1, **common}
    area = min(areas[solid.name] for solid in pair)
    return out | {"foundation_modulus": float(f"{FEET * touch.stiffness / area:.6g}"), **common}


def _add_marker(solid: Solid, markers: dict[str, Any], mechanism: Mechanism, drawing: Drawing) -> float:
    """Add the marker of a solid; returns the area [m²] of its middle side, 0 where it cannot touch."""
    look = solid.look
    try:
        shape, area = _shape(solid, mechanism, drawing)
    except (NotFoundError, scipy.spatial.QhullError) as problem:
        why = str(problem) if isinstance(problem, NotFoundError) else "a flat mesh"
        mechanism.notes.leave(f"contacts: {why}", solid.name, look.line, acts=True)
        return 0.0
    markers[mechanism.names.name("marker", solid.name)] = marker_on(solid.link, look.place, mechanism) | shape
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
