"""Pictures of what acts between points: springs, other forces between two bodies, and the planes of contacts."""

from html import escape
from typing import Any

import numpy as np

from nivel.looks.poses import Array, Pose, ends_in_space
from nivel.looks.ropes import belt_line, rope_line
from nivel.report import strokes
from nivel.report.drawing import Drawing, Frame, Label

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
