"""Signs of ground, planes, springs, links, centres of mass and joints as in textbooks, in SVG. Sizes in pixels of the picture."""

import math
from collections.abc import Iterable
from html import escape
from typing import Any

import numpy as np
from markupsafe import Markup

from nivel.elements.joints import drawn
from nivel.elements.joints.constraints import PLANE_GAP
from nivel.looks.viewpoint import Pose, ends_in_space, joint_axis, stands_at_second
from nivel.report.drawing import Array, Drawing, Frame, Label

Point = tuple[float, float]  # right and down


def ground_sign(x: float, y: float, scale: float = 1.0) -> str:
    """Hatched ground under a joint at (x, y)."""
    hatch = "".join(f"M{k} 17l-5 6" for k in range(-10, 17, 5))
    return (
        f'<g transform="translate({x:.1f} {y:.1f}) scale({scale:.2f})" class="ground">'
        f'<path d="M0 0L-8 17H8Z" class="foot"/><path d="M-15 17H15"/><path d="{hatch}" class="hatch"/></g>'
    )


def rail_sign(x: float, y: float, axis: Point) -> str:
    """Hatched ground along the axis of a sliding joint at (x, y)."""
    angle = math.degrees(math.atan2(axis[1], axis[0]))
    if angle > 90.0 or angle <= -90.0:
        angle -= math.copysign(180.0, angle)  # the hatching lies below
    hatch = "".join(f"M{k} 7.5l-5 6" for k in range(-22, 29, 5))
    return (
        f'<g transform="translate({x:.1f} {y:.1f}) rotate({angle:.1f})" class="ground">'
        f'<path d="M-26 7.5H26"/><path d="{hatch}" class="hatch"/></g>'
    )


def plane_sign(x: float, y: float, normal: Point, half: float) -> str:
    """A plane seen from its side: a hatched line of twice the length `half` through (x, y); `normal` is right and down."""
    angle = math.degrees(math.atan2(normal[0], -normal[1]))
    step = max(5.0, half / 20.0)
    count = int(2.0 * half / step)
    hatch = "".join(f"M{-half + (k + 1) * step:.1f} 0l-5 6" for k in range(count))
    return (
        f'<g transform="translate({x:.1f} {y:.1f}) rotate({angle:.1f})" class="ground plane">'
        f'<path d="M{-half:.1f} 0H{half:.1f}"/><path d="{hatch}" class="hatch"/></g>'
    )


def spring_sign(first: Point, second: Point, scale: float = 1.0) -> str:
    """A zig-zag from point to point."""
    (x1, y1), (x2, y2) = first, second
    length = math.hypot(x2 - x1, y2 - y1)
    turns = round(min(max(length / 9.0, 3.0), 14.0))
    angle = math.degrees(math.atan2(y2 - y1, x2 - x1))
    lead, width = 0.16 * length, 5.5 * scale
    pitch = (length - 2.0 * lead) / turns
    tips = "".join(f"L{lead + (k + 0.5) * pitch:.1f} {width * (-1) ** k:.1f}" for k in range(turns))
    path = f"M0 0H{lead:.1f}{tips}L{length - lead:.1f} 0H{length:.1f}"
    return (
        f'<g transform="translate({x1:.1f} {y1:.1f}) rotate({angle:.1f})" class="spring">'
        f'<path d="{path}" class="halo"/><path d="{path}"/></g>'
    )


def coil_sign(x: float, y: float, scale: float = 1.0) -> str:
    """A spiral around (x, y): a torsional spring."""
    points = [(7.0 + 0.9 * k / 3.0, 2.0 * math.pi * k / 12.0) for k in range(25)]
    path = "M" + "L".join(f"{r * math.cos(turn):.1f} {r * math.sin(turn):.1f}" for r, turn in points)
    return (
        f'<g transform="translate({x:.1f} {y:.1f}) scale({scale:.2f})" class="spring">'
        f'<path d="{path}" class="halo"/><path d="{path}"/></g>'
    )


def dashed_sign(first: Point, second: Point) -> str:
    """A thin dashed line from point to point; a dashed ring where they are one."""
    (x1, y1), (x2, y2) = first, second
    if math.hypot(x2 - x1, y2 - y1) < 8.0:
        return f'<circle cx="{x1:.1f}" cy="{y1:.1f}" r="9.5" class="pair-force"/>'
    return f'<path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}" class="pair-force"/>'


def rope_sign(points: Iterable[Iterable[float]]) -> str:
    """A line from point to point."""
    path = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    return f'<path d="M{path}" class="rope"/>'


def cylinder_sign(first: Point, second: Point, barrel: float, wide: float, thin: float) -> str:
    """A barrel of this length from the first point on, and a rod to the second one. wide, thin : their thickness; all in pixels."""
    (x1, y1), (x2, y2) = first, second
    share = min(barrel / max(math.hypot(x2 - x1, y2 - y1), 1e-9), 0.92)
    x, y = x1 + share * (x2 - x1), y1 + share * (y2 - y1)
    wide, thin = max(wide, 5.0), max(thin, 2.6)
    return (
        f'<path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}" class="rod" style="stroke-width:{thin:.1f}"/>'
        f'<path d="M{x1:.1f} {y1:.1f}L{x:.1f} {y:.1f}" class="rod" style="stroke-width:{wide:.1f};stroke-linecap:butt"/>'
        f'<path d="M{x1:.1f} {y1:.1f}L{x:.1f} {y:.1f}" class="rod core" style="stroke-width:{0.6 * wide:.1f};stroke-linecap:butt"/>'
    )


def rod_sign(first: Point, second: Point, scale: float = 1.0) -> str:
    """A massless link from point to point."""
    path = f"M{first[0]:.1f} {first[1]:.1f}L{second[0]:.1f} {second[1]:.1f}"
    return (
        f'<path d="{path}" class="rod" style="stroke-width:{6.4 * scale:.1f}"/>'
        f'<path d="{path}" class="rod core" style="stroke-width:{3.6 * scale:.1f}"/>'
    )


def centre_of_mass_sign(x: float, y: float, scale: float = 1.0) -> str:
    """The quartered circle."""
    return (
        f'<g transform="translate({x:.1f} {y:.1f}) scale({scale:.2f})" class="mass"><circle r="4.6"/>'
        '<path d="M0 0V-4.6A4.6 4.6 0 0 1 4.6 0ZM0 0V4.6A4.6 4.6 0 0 1 -4.6 0Z" class="dot"/></g>'
    )


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
    sign, size = joint_sign(kind, 18.0, 10.0, drawn(kind).looks.icon), 'viewBox="0 0 36 20" width="36" height="20"'
    return Markup(f'<svg class="machine icon" {size} aria-hidden="true">{sign}</svg>')
