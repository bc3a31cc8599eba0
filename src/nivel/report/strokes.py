"""Signs of ground, planes, springs, links and centres of mass as in textbooks, in SVG. Sizes in pixels of the picture."""

from __future__ import annotations

import math
from collections.abc import Iterable

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
