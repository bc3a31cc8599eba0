"""Pictures of what acts between points: springs, other forces between two bodies, the planes of contacts, and lines
of ropes, belts and chains around their pulleys."""

import itertools
from html import escape
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct
from nivel.looks.viewpoint import Array, Pose, ends_in_space, in_space, joint_axis
from nivel.report import strokes
from nivel.report.drawing import Drawing, Frame, Label

STEPS: Final = 24  # of an arc


class Place(Struct, frozen=False):
    """A wheel, or a point without one. at : its centre seen along the axis; radius : signed; free : direction behind it, of length one;
    near, arc [rad] : which one the arc is next to; below zero where the rope does not touch the wheel."""

    centre: Array
    at: complex
    radius: float
    near: float
    free: complex = 1.0
    arc: float = 0.0


def rope_line(rope: dict[str, Any], poses: dict[str, Pose], steps: int = STEPS) -> Array:
    """(n, 3) [m] global points of a rope around wheels, from its first end to its last; `rope` is one of the scene.

    Its turns on a drum are those next to what is wound as the bodies are placed; of more than one turn the whole rim is there.
    """
    wheels, bodies = rope["wheels"], rope["bodies"]
    n = poses[bodies[wheels["carrier"]]][1] @ np.asarray(wheels["axis"], dtype=float)
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(n)))], n)
    x = x / np.linalg.norm(x)
    plane = x + 1j * np.cross(n, x)  # seen along the axis, vectors are complex numbers
    places = [
        Place(centre, complex(centre @ plane), radius, near)
        for centre, radius, near in zip(ends_in_space(rope, poses), wheels["radii"], wheels["arcs"], strict=True)
    ]
    held = [poses[bodies[k]][1] @ np.asarray(wheels["fixed"][k], dtype=float) for k in (0, -1)]
    fixed = complex(held[0] @ plane), complex(held[1] @ plane)
    _find(places, fixed)
    ends = places[0], places[-1]
    touched = [place for place in places if place.arc >= 0.0 or place is ends[0] or place is ends[1]]
    for end, direction in zip(ends, held, strict=True):
        if end.arc < 0.0:  # an unwound drum holds the rope at its rim
            end.centre = end.centre + abs(end.radius) * direction
            end.at, end.radius = complex(end.centre @ plane), 0.0
    _find(touched, fixed)
    return np.concatenate([_around(touched, k, plane, steps) for k in range(len(touched))])


def _find(places: list[Place], fixed: tuple[complex, complex]) -> None:
    """Set the free parts from place to place, and the arcs. fixed : directions in which the rope is fixed at its ends."""
    for a, b in itertools.pairwise(places):
        d, rho = b.at - a.at, b.radius - a.radius
        a.free = d * complex(np.sqrt(max(abs(d) ** 2 - rho * rho, 0.0)), -rho) / abs(d) ** 2
    last = len(places) - 1
    for k, place in enumerate(places):
        sign = np.sign(place.radius)
        before = places[max(k - 1, 0)].free
        if not sign:
            turned = 0.0
        elif 0 < k < last:
            turned = sign * np.angle(place.free / before)
        else:  # the free part touches the rim at -i times its direction
            turned = (sign if k == 0 else -sign) * np.angle(-1j * sign * before / fixed[0 if k == 0 else 1])
        place.arc = float(turned + 2.0 * np.pi * np.round((place.near - turned) / (2.0 * np.pi))) if sign else 0.0


def _around(places: list[Place], k: int, plane: NDArray[np.complex128], steps: int) -> Array:
    """(n, 3) points of the arc at place k, or its centre."""
    place = places[k]
    if not place.radius:
        return place.centre[None]
    sign, turn = np.sign(place.radius), min(place.arc, 2.0 * np.pi)
    touched = -1j * place.radius * places[max(k - 1, 0)].free
    along = np.linspace(-turn if k == 0 else 0.0, 0.0 if k == 0 else turn, steps + 1)
    rim = touched * np.exp(1j * sign * along)
    return place.centre + np.outer(rim.real, plane.real) + np.outer(rim.imag, plane.imag)


def belt_line(belt: dict[str, Any], joints: list[dict[str, Any]], poses: dict[str, Pose]) -> Array:
    """(n, 3) [m] global points of a closed belt; none where one pulley lies within the other. `belt` and `joints` are those of a scene.

    A pulley turns about the axis of its joint, and its centre is the point of the joint on the second body.
    """
    first, second = (next(each for each in joints if each["name"] == name) for name in belt["joints"])
    centres = [in_space(poses[each["bodies"][1]], each["points"][1])[0] for each in (first, second)]
    axis = joint_axis(first, poses, "first")
    apart = centres[1] - centres[0]
    apart = apart - (apart @ axis) * axis
    distance = float(np.linalg.norm(apart))
    r1, r2 = belt["radii"]
    reach = r1 + r2 if belt["crossed"] else r1 - r2
    if not abs(reach) < distance:
        return np.empty((0, 3))
    x = apart / distance
    y = np.cross(axis, x)
    alpha = float(np.arccos(reach / distance))  # from the line of the centres to where the belt leaves the first pulley
    far = alpha - np.pi if belt["crossed"] else alpha  # the same on the second one
    arcs = (
        (centres[0], r1, np.linspace(alpha, 2.0 * np.pi - alpha, STEPS)),
        (centres[1], r2, np.linspace(-far, far, STEPS)),
    )
    parts = [c + r * (np.outer(np.cos(angle), x) + np.outer(np.sin(angle), y)) for c, r, angle in arcs]
    return np.concatenate([*parts, parts[0][:1]])


FAR = 20.0  # a plane further away than this many lengths of the machine is left out
HALF_PLANE = 34.0  # pixels of a plane to both sides of what touches it


def force_points(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(n, 3) [m] global points between which forces act."""
    found = [ends_in_space(force, poses) for force in scene.get("forces", []) if force["type"] != "contact"]
    return np.concatenate([np.zeros((0, 3)), *found])


def draw_force(drawing: Drawing, frame: Frame, force: dict[str, Any], poses: dict[str, Pose]) -> None:
    """Draw a force between two points with its name; contacts are drawn as planes."""
    if force["type"] == "contact":
        return
    if "wheels" in force:
        _draw_line(drawing, force, force["bodies"], frame.pixels(rope_line(force, poses)))
        _draw_ground(drawing, frame, force["bodies"], frame.pixels(ends_in_space(force, poses)))
        return
    if len(force["bodies"]) > 2:
        for k in range(len(force["bodies"]) - 1):
            part = {name: force[name][k : k + 2] for name in ("bodies", "points")}
            draw_force(drawing, frame, {**force, **part, "name": "" if k else force["name"]}, poses)
        return
    ends = frame.pixels(ends_in_space(force, poses))
    (x1, y1), (x2, y2) = ((float(x), float(y)) for x, y in ends)
    match force["type"]:
        case "spring-damper" | "spring-series":
            sign = strokes.spring_sign((x1, y1), (x2, y2), frame.sign)
        case "torsional-spring-damper":
            sign = strokes.coil_sign(x1, y1, frame.sign)
        case "cylinder":
            barrel, rod, long = (float(each) * frame.scale for each in force["sizes"])
            sign = strokes.cylinder_sign((x1, y1), (x2, y2), long, 2.0 * barrel, 2.0 * rod)
        case "rope":
            sign = strokes.rope_sign(ends)
        case _:
            sign = strokes.dashed_sign((x1, y1), (x2, y2))
    title = f"{force['name']}: {force['type']}, {force['bodies'][0]} – {force['bodies'][1]}"
    drawing.links.append(f"<g><title>{escape(title)}</title>{sign}</g>")
    drawing.lines.append(ends)
    if force["type"] != "torsional-spring-damper":
        _draw_ground(drawing, frame, force["bodies"], ends)
    if not force["name"]:  # a further part of a rope
        return
    middle = 0.5 * (ends[0] + ends[1]) if force["type"] != "torsional-spring-damper" else ends[0]
    drawing.labels.append(Label(force["name"], float(middle[0]), float(middle[1]), "force-name"))


def _draw_line(drawing: Drawing, element: dict[str, Any], joined: list[str], line: Array) -> None:
    """Draw a rope or belt along a line (n, 2) of pixels with its name at the longest part. joined : what it leads to, by name."""
    title = f"{element['name']}: {element['type']}, {' – '.join(joined)}"
    drawing.links.append(f"<g><title>{escape(title)}</title>{strokes.rope_sign(line)}</g>")
    parts = np.stack([line[:-1], line[1:]], axis=1)
    drawing.lines.extend(parts)
    x, y = parts[np.argmax(np.linalg.norm(parts[:, 1] - parts[:, 0], axis=1))].mean(axis=0)
    drawing.labels.append(Label(element["name"], float(x), float(y), "force-name"))


def _draw_ground(drawing: Drawing, frame: Frame, bodies: list[str], ends: Array) -> None:
    """Draw the sign of the ground at those of the ends (n, 2) of pixels that are on it."""
    for body, end in zip(bodies, ends, strict=True):
        if body == "ground":
            drawing.links.insert(0, strokes.ground_sign(float(end[0]), float(end[1]), 0.8 * frame.sign))
            drawing.points.append(end + np.array([0.0, 14.0]))


Plane = tuple[Array, Array]  # normal (3,) and what touches it: feet (n, 3) of the perpendiculars onto it [m], global


def planes(scene: dict[str, Any], poses: dict[str, Pose], cloud: Array) -> list[Plane]:
    """The planes of contacts, each once; `cloud` (n, 3) [m] is the rest of the machine."""
    found: dict[str, Plane] = {}
    size = float(np.linalg.norm(np.ptp(cloud, axis=0))) if len(cloud) else 0.0
    largest = FAR * size if size > 0.0 else np.inf  # a single point has no size to lose
    for force in scene.get("forces", []):
        if force["type"] != "contact" or "axis" not in force:
            continue
        centre, point = ends_in_space(force, poses)
        normal = poses[force["bodies"][1]][1] @ np.asarray(force["axis"], dtype=float)
        height = float((centre - point) @ normal)
        if abs(height) <= largest:
            key = repr((force["bodies"][1], force["points"][1], force["axis"]))
            _, feet = found.get(key, (normal, np.empty((0, 3))))
            found[key] = (normal, np.vstack([feet, centre - height * normal]))
    return list(found.values())


def draw_plane(drawing: Drawing, frame: Frame, plane: Plane) -> None:
    """A hatched line under what touches the plane; nothing where it is seen from above."""
    normal, feet = plane
    right, up = frame.view.on_screen(normal)
    length = float(np.hypot(right, up))
    if length <= strokes.END_ON:
        return
    along = np.array([up, right]) / length  # on the screen, down counted positive
    flat = frame.pixels(feet)
    places = flat @ along
    half = 0.5 * float(np.ptp(places)) + HALF_PLANE
    x, y = flat.mean(axis=0) + (0.5 * (places.min() + places.max()) - places.mean()) * along
    drawing.links.insert(0, strokes.plane_sign(float(x), float(y), (float(right), -float(up)), half))
    ends = np.array([x, y]) + half * np.outer([-1.0, 1.0], along)
    drawing.lines.append(ends)
    drawing.points += list(np.linspace(ends[0], ends[1], 7) + np.array([0.0, 4.0]))


def belt_points(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(n, 3) [m] global points of all belts."""
    lines = [belt_line(belt, scene["joints"], poses) for belt in scene.get("belts", [])]
    return np.concatenate([np.empty((0, 3)), *lines])


def draw_belt(
    drawing: Drawing, frame: Frame, belt: dict[str, Any], scene: dict[str, Any], poses: dict[str, Pose]
) -> None:
    """Draw a belt with its name at the middle of a strand."""
    line = belt_line(belt, scene["joints"], poses)
    if len(line):
        _draw_line(drawing, belt, belt["joints"], frame.pixels(line))
