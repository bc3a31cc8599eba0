"""A still picture of the assembled machine with its names."""

from html import escape
from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel.elements.joints import drawn
from nivel.looks import solids
from nivel.looks.solids import Ball, Face, link_ends, shapes_of
from nivel.looks.sweeps import rings, sweep_faces, swept_bodies
from nivel.looks.viewpoint import Array, Pose, body_poses, choose_view, in_space, sliding_axes, turning_axes
from nivel.report import drawing as pixels
from nivel.report.drawing import WIDTH, Drawing, Frame, Label, mixed
from nivel.report.force_drawing import Plane, belt_points, draw_belt, draw_force, draw_plane, force_points, planes
from nivel.report.strokes import centre_of_mass_sign, draw_joint


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
        _draw_solid(drawing, frame, solids.solid(shape, facets), pose, shape.get("colour", colour))
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


def _draw_solid(drawing: Drawing, frame: Frame, parts: list[Face] | Ball, pose: Pose, colour: str) -> None:
    if isinstance(parts, Ball):
        centre = in_space(pose, parts.centre)[0]
        (x, y), r = frame.pixels(centre), parts.radius * frame.scale
        bright, dark = mixed(colour, 0.45, 0.0), mixed(colour, 0.0, 0.4)
        rings = "".join(
            f'<circle cx="{x - 0.36 * r * s:.1f}" cy="{y - 0.42 * r * s:.1f}" r="{r * (1 - 0.62 * s):.1f}" '
            f'fill="{pixels.between(colour, bright, s)}"/>'
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
        fill = pixels.shaded(colour, pose[1] @ face.normal, frame.view)
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
        style = f'stroke="{mixed(colour, 0.0, 0.45)}" stroke-width="1" stroke-linecap="round" fill="none"'
        drawing.parts.append((depth, shape + (f'<path d="{edges}" {style}/>' if edges else "")))


def _edges_seen_once(faces: list[Face]) -> set[tuple[int, int]]:
    """(face, edge) whose neighbour across the edge turns away: the silhouette."""
    found: dict[Any, list[tuple[int, int]]] = {}
    for k, face in enumerate(faces):
        corners = [tuple(corner) for corner in np.round(face.corners, 9).tolist()]
        for i, corner in enumerate(corners):
            key = tuple(sorted((corner, corners[(i + 1) % len(corners)])))
            found.setdefault(key, []).append((k, i))
    return {places[0] for places in found.values() if len(places) == 1}


MANY_BODIES, VERY_MANY_BODIES = 20, 200
ALONG = np.linspace(0.0, 1.0, 12)[None, :, None]  # where lines are probed
IMPORTANCE = ("joint-name", "body", "force-name")  # names are placed in this order
STYLE: Final = Path(__file__).with_suffix(".css").read_text(encoding="utf-8")


def machine_picture(
    scene: dict[str, Any], position: Array, orientation: Array, up: tuple[float, float, float] | Array = (0, 0, 1)
) -> str:
    """SVG text of the machine in one configuration.

    scene : as in a result's attribute of that name, see `nivel.system.scene`.
    position : (bodies, 3) [m]; orientation : (bodies, 4) Euler parameters, scalar first; of the body frames, global axes.
    up : the global direction that points up in the picture, unless the machine is planar and seen along it.
    Bodies with a shape are shaded solids, others are links from their centre of mass to where they are held. Empty where there
    is nothing finite to draw.
    """
    poses = body_poses(scene, position, orientation)
    skeleton, shapes = _skeleton(scene, poses), _shapes(scene, poses)
    touched = planes(scene, poses, np.concatenate([skeleton, shapes]))
    skeleton = np.concatenate([skeleton, *(feet for _, feet in touched)])
    cloud = np.concatenate([skeleton, shapes])
    if not len(cloud) or not np.all(np.isfinite(cloud)):
        return ""
    view = choose_view(skeleton, turning_axes(scene, poses), sliding_axes(scene, poses), np.array(up, dtype=float))
    frame = pixels.fit(view, cloud, skeleton)
    return _svg(_drawing(scene, poses, frame, touched), frame)


def _drawing(scene: dict[str, Any], poses: dict[str, Pose], frame: Frame, touched: list[Plane]) -> Drawing:
    drawing = Drawing()
    count = len(scene["bodies"])
    few = solids.FEW_FACETS if count <= VERY_MANY_BODIES else solids.FEWEST_FACETS
    facets = solids.FACETS if count <= MANY_BODIES else few
    swept, places = swept_bodies(scene), {body["name"]: k for k, body in enumerate(scene["bodies"])}
    # one solid through the frames of bodies in a row, with its name at the middle one
    for sweep in scene.get("sweeps", []):
        at, colour = poses[sweep["bodies"][len(sweep["bodies"]) // 2]], solids.colour_of(places[sweep["bodies"][0]])
        x, y = frame.pixels(in_space(at, [0.0, 0.0, 0.0])[0])
        drawing.labels.append(Label(sweep["name"], x, y, "body"))
        _draw_solid(drawing, frame, sweep_faces(sweep, poses), (np.zeros(3), np.eye(3)), colour)
    for k, body in enumerate(scene["bodies"]):
        if body["name"] not in swept:
            colour, held = solids.colour_of_body(body, k), solids.held_points(scene, body)
            draw_body(drawing, frame, body, held, poses[body["name"]], colour, facets)
    for joint in sorted(scene["joints"], key=lambda joint: drawn(joint["type"]).looks.ground != "rail"):
        draw_joint(drawing, frame, joint, poses)
    for force in scene.get("forces", []):
        draw_force(drawing, frame, force, poses)
    for belt in scene.get("belts", []):
        draw_belt(drawing, frame, belt, scene, poses)
    for plane in touched:
        draw_plane(drawing, frame, plane)
    return drawing


def _skeleton(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(n, 3) centres of mass, and points where joints and forces hold."""
    parts = [np.reshape(np.asarray(scene.get("ground_points", []), dtype=float), (-1, 3))]
    parts += [in_space(poses[b["name"]], [b["centre_of_mass"], *b.get("points", [])]) for b in scene["bodies"]]
    return np.concatenate([*parts, force_points(scene, poses)])


def _shapes(scene: dict[str, Any], poses: dict[str, Pose]) -> Array:
    """(n, 3) points around the shapes."""
    shapes = [in_space(poses[b["name"]], solids.reach_of(b)) for b in scene["bodies"] if shapes_of(b)]
    swept = [rings(sweep, poses, sweep["section"]).reshape(-1, 3) for sweep in scene.get("sweeps", [])]
    return np.concatenate([belt_points(scene, poses), *shapes, *swept])


def _svg(drawing: Drawing, frame: Frame) -> str:
    lines = np.array(drawing.lines).reshape(-1, 2, 2)
    edges = [np.stack([corners, np.roll(corners, -1, axis=0)], axis=1) for corners in drawing.covered]
    strokes = np.concatenate([lines, *edges])
    drawn = (strokes[:, :1] + ALONG * (strokes[:, 1:] - strokes[:, :1])).reshape(-1, 2)
    drawn = np.concatenate([np.array(drawing.points).reshape(-1, 2), drawn])
    frame, triad, bar = pixels.aid_places(drawn, frame)
    aids = pixels.triad_sign(frame, triad) + pixels.scale_bar(frame, bar)
    keep_free = [*drawing.points, *(triad + np.array([10.0 * k, -10.0 * n]) for k in (-1, 0, 1) for n in (-1, 0, 1))]
    keep_free += list(pixels.bar_strip(bar))
    labels = sorted(drawing.labels, key=lambda label: IMPORTANCE.index(label.kind))
    placed = pixels.place(labels, np.array(keep_free), lines, WIDTH, frame.height)
    texts = "".join(_text(each.label, *each.centre) for each in placed)
    parts = "".join(text for _, text in sorted(drawing.parts, key=lambda part: part[0]))
    box = f'viewBox="0 0 {WIDTH:.0f} {frame.height:.0f}"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="machine" {box} role="img" aria-label="picture of the machine">'
        f"<style>{STYLE}</style>{parts}{''.join(drawing.links)}{''.join(drawing.signs)}{aids}{texts}</svg>"
    )


def _text(label: Label, x: float, y: float) -> str:
    far = np.hypot(label.x - x, label.y - y)
    leader = ""
    if far > 40.0 and label.kind != pixels.WITHOUT_LINE:
        ux, uy = (x - label.x) / far, (y - label.y) / far
        start = (label.x + 9.0 * ux, label.y + 9.0 * uy)
        stop = (label.x + (far - 14.0) * ux, label.y + (far - 14.0) * uy)
        leader = f'<path class="leader" d="M{start[0]:.1f} {start[1]:.1f}L{stop[0]:.1f} {stop[1]:.1f}"/>'
    return (
        f'{leader}<text class="{label.kind}" x="{x:.1f}" y="{y + 0.35 * pixels.FONT:.1f}">{escape(label.text)}</text>'
    )
