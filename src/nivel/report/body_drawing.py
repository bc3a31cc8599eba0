"""Bodies in the picture: shaded solids, or links from the centre of mass to where they are held."""

from __future__ import annotations

from typing import Any

import numpy as np

from nivel.looks.links import link_ends
from nivel.looks.poses import Array, Pose, in_space
from nivel.looks.solids import Ball, Face, shapes_of, solid
from nivel.looks.sweeps import sweep_faces
from nivel.report.drawing import Drawing, Frame, Label, between, mixed, shaded
from nivel.report.strokes import centre_of_mass_sign


def draw_body(
    drawing: Drawing, frame: Frame, body: dict[str, Any], held: Array, pose: Pose, colour: str, facets: int
) -> None:
    """Draw a body with its name; `held` are the points (n, 3) of its frame where joints and forces hold it."""
    centre = in_space(pose, body["centre_of_mass"])[0]
    x, y = frame.pixels(centre)
    drawing.labels.append(Label(body["name"], x, y, "body"))
    joints = held
    width = 6.6 * frame.sign
    shapes = shapes_of(body)
    for shape in shapes:
        _draw_solid(drawing, frame, solid(shape, facets), pose, shape.get("colour", colour))
    if shapes:
        drawing.lines += [frame.pixels(np.stack([centre, joint])) for joint in in_space(pose, joints)]
        joints, width = link_ends(body, joints), 3.4 * frame.sign  # a shape need not reach its joints
    else:
        drawing.signs.append(centre_of_mass_sign(x, y, frame.sign))
        drawing.points.append(np.array([x, y]))
    for joint in in_space(pose, joints):
        ends = np.stack([centre, joint])
        (x1, y1), (x2, y2) = frame.pixels(ends)
        line = f'x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke-linecap="round"'
        depths = frame.view.depth(ends)
        dark, depth = mixed(colour, 0.0, 0.35), float(depths.min() if shapes else depths.mean())
        drawing.parts.append((depth - 1e-9, f'<line {line} stroke="{dark}" stroke-width="{width + 2.4:.1f}"/>'))
        drawing.parts.append((depth, f'<line {line} stroke="{colour}" stroke-width="{width:.1f}"/>'))
        drawing.lines.append(frame.pixels(ends))


def draw_sweep(drawing: Drawing, frame: Frame, sweep: dict[str, Any], poses: dict[str, Pose], colour: str) -> None:
    """Draw one solid through the frames of bodies in a row, with its name at the middle one."""
    at = poses[sweep["bodies"][len(sweep["bodies"]) // 2]]
    x, y = frame.pixels(in_space(at, [0.0, 0.0, 0.0])[0])
    drawing.labels.append(Label(sweep["name"], x, y, "body"))
    _draw_solid(drawing, frame, sweep_faces(sweep, poses), (np.zeros(3), np.eye(3)), colour)


def _draw_solid(drawing: Drawing, frame: Frame, parts: list[Face] | Ball, pose: Pose, colour: str) -> None:
    if isinstance(parts, Ball):
        centre = in_space(pose, parts.centre)[0]
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
        corners = in_space(pose, face.corners)
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
        corners = [tuple(corner) for corner in np.round(face.corners, 9).tolist()]
        for i, corner in enumerate(corners):
            key = tuple(sorted((corner, corners[(i + 1) % len(corners)])))
            found.setdefault(key, []).append((k, i))
    return {places[0] for places in found.values() if len(places) == 1}
