"""Joints in the picture of a machine, and their signs as in textbooks, in SVG."""

from __future__ import annotations

import math
from html import escape
from typing import Any

import numpy as np
from markupsafe import Markup

from nivel.elements.joints import drawn
from nivel.elements.joints.constraints import PLANE_GAP
from nivel.looks.poses import Pose, ends_in_space, joint_axis, stands_at_second
from nivel.report.drawing import Array, Drawing, Frame, Label
from nivel.report.strokes import Point, ground_sign, plane_sign, rail_sign, rod_sign


def draw_joint(drawing: Drawing, frame: Frame, joint: dict[str, Any], poses: dict[str, Pose]) -> None:
    """Draw a joint with its name."""
    title = f"{joint['name']}: {joint['type']}, {joint['bodies'][0]} – {joint['bodies'][1]}"
    drawing.signs.append(f"<g><title>{escape(title)}</title>")
    if drawn(joint["type"]).looks.ends is not None:
        x, y = _draw_link(drawing, frame, joint, poses)
    else:
        x, y = _draw_at_point(drawing, frame, joint, poses)
    drawing.signs.append("</g>")
    drawing.labels.append(Label(joint["name"], x, y, "joint-name"))


def _draw_link(drawing: Drawing, frame: Frame, joint: dict[str, Any], poses: dict[str, Pose]) -> Point:
    """A rod with the signs of its ends; returns its middle."""
    ends = frame.pixels(ends_in_space(joint, poses))
    first, second = (_point(end) for end in ends)
    drawing.links.append(rod_sign(first, second, frame.sign))
    drawing.lines.append(ends)
    kinds = drawn(joint["type"]).looks.ends or ()
    for which, kind, body, end in zip(("first", "second"), kinds, joint["bodies"], ends, strict=True):
        x, y = _point(end)
        axis = _on_screen(frame, joint_axis(joint, poses, which))
        if body == "ground":
            _draw_ground(drawing, x, y, ground_sign(x, y, frame.sign))
        drawing.signs.append(joint_sign(kind, x, y, axis, 0.8 * frame.sign))
        drawing.points.append(end)
    return _point(ends.mean(axis=0))


def _draw_at_point(drawing: Drawing, frame: Frame, joint: dict[str, Any], poses: dict[str, Pose]) -> Point:
    """The sign of a joint at one point, which is returned."""
    x, y = _point(frame.pixels(ends_in_space(joint, poses)[int(stands_at_second(joint))]))
    axis = _on_screen(frame, joint_axis(joint, poses, "slot" if "slot" in joint else "first"))
    if "ground" in joint["bodies"]:
        _draw_ground(drawing, x, y, _ground_of(joint, x, y, axis, frame.sign))
    drawing.signs.append(joint_sign(joint["type"], x, y, axis, frame.sign))
    drawing.points += [np.array([x, y]) + part * 13.0 * np.array(axis) for part in (-1.0, 0.0, 1.0)]
    return x, y


def _ground_of(joint: dict[str, Any], x: float, y: float, axis: Point, scale: float) -> str:
    """Ground along a rail, a plane or a slot, or under a point."""
    ground, (first, second) = drawn(joint["type"]).looks.ground, joint["bodies"]
    length = float(np.hypot(*axis))
    if length <= END_ON:
        return ground_sign(x, y, scale)
    if ground == "rail" or (ground == "line" and first == "ground") or ("slot" in joint and second == "ground"):
        return rail_sign(x, y, axis)
    if ground == "plane" and first == "ground":
        gap = PLANE_GAP * scale / length
        return plane_sign(x - gap * axis[0], y - gap * axis[1], axis, 26.0)
    return ground_sign(x, y, scale)


def _draw_ground(drawing: Drawing, x: float, y: float, sign: str) -> None:
    drawing.signs.append(sign)
    drawing.points += [np.array([x, y + 12.0]), np.array([x - 10.0, y + 19.0]), np.array([x + 10.0, y + 19.0])]


def _on_screen(frame: Frame, axis: Array) -> Point:
    """A direction on the screen, right and down."""
    right, up = frame.view.on_screen(axis)
    return float(right), -float(up)


def _point(pixels: Array) -> Point:
    x, y = pixels
    return float(x), float(y)


END_ON = 0.35  # a joint axis whose projection is shorter than this fraction of its length is seen end-on


def joint_sign(kind: str, x: float, y: float, axis: tuple[float, float] = (0.0, 1.0), scale: float = 1.0) -> str:
    """The sign of a joint at (x, y).

    axis : on the screen, right and down, as long as it is seen (1: in the plane of the picture, 0: end-on). It is the joint axis,
    of a plane its normal, of a pin in a slot the slot.
    """
    length = math.hypot(*axis)
    seen = length > END_ON
    angle = math.degrees(math.atan2(axis[1], axis[0])) if seen else 0.0
    body = drawn(kind).symbol(seen)
    return f'<g transform="translate({x:.1f} {y:.1f}) rotate({angle:.1f}) scale({scale:.2f})" class="joint">{body}</g>'


def joint_icon(kind: str) -> Markup:
    """The sign of a joint by itself, for tables."""
    sign = joint_sign(kind, 18.0, 10.0, drawn(kind).looks.icon)
    return Markup(
        f'<svg class="machine icon" viewBox="0 0 36 20" width="36" height="20" aria-hidden="true">{sign}</svg>'
    )
