"""A still picture of the assembled machine with its names."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.report.aids import free_corners, scale_bar, triad_sign
from nivel.report.frame import WIDTH, Frame, fit
from nivel.report.labels import FONT, Label, place
from nivel.report.shading import COLOURS, between, mixed, shaded
from nivel.report.solids import FACETS, FEW_FACETS, Ball, Face, reach, solid
from nivel.report.symbols import centre_of_mass_sign, ground_sign, joint_sign, rail_sign
from nivel.report.view import choose_view

Array = NDArray[np.float64]

MANY_BODIES = 20
STYLE = """
.machine{font:500 13px/1.2 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif;--paper:#fff;--ink:#1b2430;--soft:#6b7684}
.machine .joint circle,.machine .joint rect{fill:var(--paper);stroke:var(--ink);stroke-width:1.6}
.machine .joint .dot,.machine .mass .dot,.machine .joint .solid{fill:var(--ink);stroke:none}
.machine .joint .thin{fill:none;stroke:var(--ink);stroke-width:1.2}
.machine .joint .axis{fill:none;stroke:var(--ink);stroke-width:1.6;stroke-linecap:round}
.machine .mass circle{fill:var(--paper);stroke:var(--ink);stroke-width:1.2}
.machine .ground path{fill:none;stroke:var(--soft);stroke-width:1.6;stroke-linecap:round;stroke-linejoin:round}
.machine .ground .foot{fill:var(--paper)}.machine .ground .hatch{stroke-width:1.1}
.machine text{fill:var(--ink);paint-order:stroke;stroke:var(--paper);stroke-width:3.5px;stroke-linejoin:round;text-anchor:middle}
.machine .body{font-style:italic;font-weight:600}.machine .joint-name{font-weight:500}
.machine .leader{stroke:var(--soft);stroke-width:.8;fill:none}
.machine .aid{fill:var(--soft);font-size:11px;font-weight:500}
.machine .aid-line{stroke:var(--soft);stroke-width:1.4;fill:none;stroke-linecap:round}
@media (prefers-color-scheme:dark){.machine{--paper:#171d26;--ink:#e6ebf2;--soft:#93a0b0}}
"""


@dataclass
class Drawing:
    """What is drawn, far things first, and what names must keep clear of. Pixels."""

    parts: list[tuple[float, str]] = field(default_factory=list)
    signs: list[str] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    points: list[Array] = field(default_factory=list)
    covered: list[Array] = field(default_factory=list)
    lines: list[Array] = field(default_factory=list)


def machine_picture(
    scene: dict[str, Any], position: Array, orientation: Array, up: tuple[float, float, float] | Array = (0, 0, 1)
) -> str:
    """SVG text of the machine in one configuration.

    scene : bodies, ground points and joints as in a result's attribute of that name.
    position : (bodies, 3) [m]; orientation : (bodies, 4) Euler parameters, scalar first; of the body frames, global axes.
    up : the global direction that points up in the picture, unless the machine is planar and seen along it.
    Bodies with a shape are shaded solids, others are links from their centre of mass to their joints. Empty where there is
    nothing finite to draw.
    """
    poses = _poses(scene, position, orientation)
    cloud = _cloud(scene, poses)
    if not len(cloud) or not np.all(np.isfinite(cloud)):
        return ""
    turning, sliding = (_axes(scene, poses, kinds) for kinds in (("revolute", "cylindrical"), ("translational",)))
    skeleton = _skeleton(scene, poses)
    view = choose_view(skeleton, turning, sliding, np.array(up, dtype=float))
    frame = fit(view, cloud, skeleton)
    drawing = Drawing()
    for k, body in enumerate(scene["bodies"]):
        facets = FACETS if len(scene["bodies"]) <= MANY_BODIES else FEW_FACETS
        _draw_body(drawing, frame, body, poses[body["name"]], COLOURS[k % len(COLOURS)], facets)
    for joint in sorted(scene["joints"], key=lambda joint: joint["type"] not in ("translational", "cylindrical")):
        _draw_joint(drawing, frame, joint, poses)
    return _svg(drawing, frame)


def _poses(scene: dict[str, Any], position: Array, orientation: Array) -> dict[str, tuple[Array, Array]]:
    """Name → (position, rotation matrix) of the body frame; the ground too."""
    out = {"ground": (np.zeros(3), np.eye(3))}
    for body, r, theta in zip(scene["bodies"], position, orientation, strict=True):
        out[body["name"]] = (np.asarray(r, dtype=float), _rotation(np.asarray(theta, dtype=float)))
    return out


def _rotation(theta: Array) -> Array:
    e0, e = theta[0], theta[1:]
    cross = np.array([[0.0, -e[2], e[1]], [e[2], 0.0, -e[0]], [-e[1], e[0], 0.0]])
    return np.eye(3) + 2.0 * e0 * cross + 2.0 * cross @ cross


def _in_space(pose: tuple[Array, Array], points: Any) -> Array:
    r, A = pose
    return r + np.reshape(np.asarray(points, dtype=float), (-1, 3)) @ A.T


def _axes(scene: dict[str, Any], poses: dict[str, tuple[Array, Array]], kinds: tuple[str, ...]) -> Array:
    """(k, 3) axes of the joints of these kinds, global."""
    chosen = [joint for joint in scene["joints"] if joint["type"] in kinds]
    return np.array([poses[j["bodies"][0]][1] @ np.array(j["axes"][0], dtype=float) for j in chosen]).reshape(-1, 3)


def _skeleton(scene: dict[str, Any], poses: dict[str, tuple[Array, Array]]) -> Array:
    """(n, 3) joint points and centres of mass."""
    parts = [np.reshape(np.asarray(scene.get("ground_points", []), dtype=float), (-1, 3))]
    parts += [_in_space(poses[b["name"]], [b["centre_of_mass"], *b.get("points", [])]) for b in scene["bodies"]]
    return np.concatenate(parts)


def _cloud(scene: dict[str, Any], poses: dict[str, tuple[Array, Array]]) -> Array:
    """(n, 3) everything that must be in the picture."""
    shapes = [_in_space(poses[b["name"]], reach(b["shape"])) for b in scene["bodies"] if b.get("shape")]
    return np.concatenate([_skeleton(scene, poses), *shapes])


def _draw_body(
    drawing: Drawing, frame: Frame, body: dict[str, Any], pose: tuple[Array, Array], colour: str, facets: int
) -> None:
    centre = _in_space(pose, body["centre_of_mass"])[0]
    x, y = frame.pixels(centre)
    drawing.labels.append(Label(body["name"], x, y, "body"))
    joints = np.reshape(np.asarray(body.get("points", []), dtype=float), (-1, 3))
    width = 6.6 * frame.sign
    if body.get("shape"):
        _draw_solid(drawing, frame, solid(body["shape"], facets), pose, colour)
        drawing.lines += [frame.pixels(np.stack([centre, joint])) for joint in _in_space(pose, joints)]
        joints, width = joints[_outside(body["shape"], joints)], 3.4 * frame.sign  # a shape need not reach its joints
    else:
        drawing.signs.append(centre_of_mass_sign(x, y, frame.sign))
        drawing.points.append(np.array([x, y]))
    for joint in _in_space(pose, joints):
        ends = np.stack([centre, joint])
        (x1, y1), (x2, y2) = frame.pixels(ends)
        line = f'x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke-linecap="round"'
        depths = frame.view.depth(ends)
        dark, depth = mixed(colour, 0.0, 0.35), float(depths.min() if body.get("shape") else depths.mean())
        drawing.parts.append((depth - 1e-9, f'<line {line} stroke="{dark}" stroke-width="{width + 2.4:.1f}"/>'))
        drawing.parts.append((depth, f'<line {line} stroke="{colour}" stroke-width="{width:.1f}"/>'))
        drawing.lines.append(frame.pixels(ends))


def _outside(shape: dict[str, Any], points: Array) -> NDArray[np.bool_]:
    """Which points (n, 3) of the body frame lie outside the box around the shape."""
    extent = reach(shape)
    slack = 1e-3 * np.ptp(extent, axis=0).max()
    low, high = extent.min(axis=0) - slack, extent.max(axis=0) + slack
    return np.any((points < low) | (points > high), axis=1)


def _draw_solid(
    drawing: Drawing, frame: Frame, parts: list[Face] | Ball, pose: tuple[Array, Array], colour: str
) -> None:
    if isinstance(parts, Ball):
        centre = _in_space(pose, parts.centre)[0]
        (x, y), r = frame.pixels(centre), parts.radius * frame.scale
        bright, dark = mixed(colour, 0.45, 0.0), mixed(colour, 0.0, 0.4)
        rings = "".join(
            f'<circle cx="{x - 0.36 * r * s:.1f}" cy="{y - 0.42 * r * s:.1f}" r="{r * (1 - 0.62 * s):.1f}" '
            f'fill="{between(colour, bright, s)}"/>'
            for s in np.linspace(0.0, 1.0, 14)
        )
        outline = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.1f}" fill="none" stroke="{dark}" stroke-width="1"/>'
        drawing.covered.append(np.array([[x - r, y], [x + r, y], [x, y - r], [x, y + r]]))
        drawing.parts.append((float(frame.view.depth(centre)), rings + outline))
        return
    seen = [face for face in parts if (pose[1] @ face.normal) @ frame.view.towards > 1e-9]
    silhouette = _edges_seen_once(seen)
    for k, face in enumerate(seen):
        corners = _in_space(pose, face.corners)
        fill = shaded(colour, pose[1] @ face.normal, frame.view)
        flat = frame.pixels(corners)
        outline = " ".join(f"{x:.1f},{y:.1f}" for x, y in flat)
        depth = float(frame.view.depth(corners).mean())
        drawing.covered.append(flat)
        shape = f'<polygon points="{outline}" fill="{fill}" stroke="{fill}" stroke-width=".7" stroke-linejoin="round"/>'
        edges = "".join(
            f"M{flat[i][0]:.1f} {flat[i][1]:.1f}L{flat[j][0]:.1f} {flat[j][1]:.1f}"
            for i, j in ((i, (i + 1) % len(flat)) for i in range(len(flat)))
            if face.outlined[i] or (k, i) in silhouette
        )
        dark = mixed(colour, 0.0, 0.45)
        line = (
            f'<path d="{edges}" stroke="{dark}" stroke-width="1" stroke-linecap="round" fill="none"/>' if edges else ""
        )
        drawing.parts.append((depth, shape + line))


def _edges_seen_once(faces: list[Face]) -> set[tuple[int, int]]:
    """(face, edge) whose neighbour across the edge turns away: the silhouette."""
    found: dict[Any, list[tuple[int, int]]] = {}
    for k, face in enumerate(faces):
        for i, corner in enumerate(face.corners):
            ends = (corner, face.corners[(i + 1) % len(face.corners)])
            key = tuple(sorted(tuple(np.round(end, 9)) for end in ends))
            found.setdefault(key, []).append((k, i))
    return {places[0] for places in found.values() if len(places) == 1}


def _draw_joint(drawing: Drawing, frame: Frame, joint: dict[str, Any], poses: dict[str, tuple[Array, Array]]) -> None:
    first, second = joint["bodies"]
    point = _in_space(poses[first], joint["points"][0])[0]
    if joint["type"] in ("translational", "cylindrical"):
        point = _in_space(
            poses[second if second != "ground" else first], joint["points"][1 if second != "ground" else 0]
        )[0]
    direction = frame.view.on_screen(poses[first][1] @ np.asarray(joint["axes"][0], dtype=float))
    axis = (float(direction[0]), float(-direction[1]))
    x, y = (float(each) for each in frame.pixels(point))
    if "ground" in (first, second):
        sliding = joint["type"] in ("translational", "cylindrical") and np.hypot(*axis) > 0.35
        drawing.signs.append(rail_sign(x, y, axis) if sliding else ground_sign(x, y, frame.sign))
        drawing.points += [np.array([x, y + 12.0]), np.array([x - 10.0, y + 19.0]), np.array([x + 10.0, y + 19.0])]
    title = f"<title>{escape(joint['name'])}: {escape(joint['type'])}, {escape(first)} – {escape(second)}</title>"
    drawing.signs.append(f"<g>{title}{joint_sign(joint['type'], x, y, axis, frame.sign)}</g>")
    drawing.points += [np.array([x, y]) + part * 13.0 * np.array(axis) for part in (-1.0, 0.0, 1.0)]
    drawing.labels.append(Label(joint["name"], x, y, "joint-name"))


def _svg(drawing: Drawing, frame: Frame) -> str:
    lines = np.array(drawing.lines).reshape(-1, 2, 2)
    triad, bar = free_corners(np.concatenate([np.array(drawing.points).reshape(-1, 2), *drawing.covered]), lines, frame)
    aids = triad_sign(frame, triad) + scale_bar(frame, bar)
    keep_free = [*drawing.points, *(triad + np.array([10.0 * k, -10.0 * n]) for k in (-1, 0, 1) for n in (-1, 0, 1))]
    keep_free += [bar + np.array([10.0 * k, 8.0]) for k in range(-4, 5)]
    labels = sorted(drawing.labels, key=lambda label: label.kind == "body")
    placed = place(labels, np.array(keep_free), lines, WIDTH, frame.height)
    texts = "".join(_text(each.label, *each.centre) for each in placed)
    parts = "".join(text for _, text in sorted(drawing.parts, key=lambda part: part[0]))
    box = f'viewBox="0 0 {WIDTH:.0f} {frame.height:.0f}"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="machine" {box} role="img" aria-label="picture of the machine">'
        f"<style>{STYLE}</style>{parts}{''.join(drawing.signs)}{aids}{texts}</svg>"
    )


def _text(label: Label, x: float, y: float) -> str:
    far = np.hypot(label.x - x, label.y - y)
    leader = ""
    if far > 40.0 and label.kind != "body":
        ux, uy = (x - label.x) / far, (y - label.y) / far
        start, stop = (
            (label.x + 9.0 * ux, label.y + 9.0 * uy),
            (label.x + (far - 14.0) * ux, label.y + (far - 14.0) * uy),
        )
        leader = f'<path class="leader" d="M{start[0]:.1f} {start[1]:.1f}L{stop[0]:.1f} {stop[1]:.1f}"/>'
    return f'{leader}<text class="{label.kind}" x="{x:.1f}" y="{y + 0.35 * FONT:.1f}">{escape(label.text)}</text>'
