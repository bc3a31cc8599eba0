"""Signs for joints, the ground and the centre of mass, as engineers draw them. Sizes in pixels of the picture."""

from __future__ import annotations

import math

from markupsafe import Markup

END_ON = 0.35  # a joint axis whose projection is shorter than this fraction of its length is seen end-on
RADIUS = 6.5


def joint_sign(kind: str, x: float, y: float, axis: tuple[float, float] = (0.0, 1.0), scale: float = 1.0) -> str:
    """The sign of a joint at (x, y).

    axis : the joint axis on the screen, right and down, as long as it is seen (1: in the plane of the picture, 0: end-on).
    """
    length = math.hypot(*axis)
    seen = length > END_ON
    angle = math.degrees(math.atan2(axis[1], axis[0])) if seen else 0.0
    body = {
        "revolute": _revolute,
        "cylindrical": _cylindrical,
        "translational": _translational,
        "spherical": _spherical,
        "universal": _universal,
        "fixed": _fixed,
    }.get(kind, _spherical)(seen)
    return f'<g transform="translate({x:.1f} {y:.1f}) rotate({angle:.1f}) scale({scale:.2f})" class="joint">{body}</g>'


def _revolute(seen: bool) -> str:
    if not seen:
        return f'<circle r="{RADIUS}"/><circle r="1.6" class="dot"/>'
    return '<rect x="-9" y="-5" width="18" height="10" rx="2.5"/><path d="M-14 0H14" class="axis"/>'


def _cylindrical(seen: bool) -> str:
    if not seen:
        return f'<circle r="{RADIUS}"/><circle r="3" class="thin"/>'
    arrows = '<path d="M-15.5 0l4-2.6v5.2zM15.5 0l-4-2.6v5.2z" class="dot"/>'
    return f'<path d="M-15 0H15" class="axis"/><rect x="-8" y="-5" width="16" height="10" rx="2.5"/>{arrows}'


def _translational(seen: bool) -> str:
    if not seen:
        return '<rect x="-6" y="-6" width="12" height="12"/><rect x="-2.5" y="-2.5" width="5" height="5" class="thin"/>'
    return '<path d="M-17 -6.5H17M-17 6.5H17" class="axis"/><rect x="-9" y="-4.5" width="18" height="9"/>'


def _spherical(seen: bool) -> str:
    return f'<circle r="{RADIUS}"/><circle r="3.6" class="dot"/>'


def _universal(seen: bool) -> str:
    return f'<circle r="{RADIUS}"/><path d="M-4.4 -4.4L4.4 4.4M-4.4 4.4L4.4 -4.4" class="axis"/>'


def _fixed(seen: bool) -> str:
    return '<rect x="-5.5" y="-5.5" width="11" height="11" class="solid"/>'


def ground_sign(x: float, y: float, scale: float = 1.0) -> str:
    """Hatched ground under a joint at (x, y)."""
    hatch = "".join(f"M{k} 17l-5 6" for k in range(-10, 17, 5))
    return (
        f'<g transform="translate({x:.1f} {y:.1f}) scale({scale:.2f})" class="ground">'
        f'<path d="M0 0L-8 17H8Z" class="foot"/><path d="M-15 17H15"/><path d="{hatch}" class="hatch"/></g>'
    )


def rail_sign(x: float, y: float, axis: tuple[float, float]) -> str:
    """Hatched ground along the axis of a sliding joint at (x, y)."""
    angle = math.degrees(math.atan2(axis[1], axis[0]))
    if angle > 90.0 or angle <= -90.0:
        angle -= math.copysign(180.0, angle)  # the hatching lies below
    hatch = "".join(f"M{k} 7.5l-5 6" for k in range(-22, 29, 5))
    return (
        f'<g transform="translate({x:.1f} {y:.1f}) rotate({angle:.1f})" class="ground">'
        f'<path d="M-26 7.5H26"/><path d="{hatch}" class="hatch"/></g>'
    )


def centre_of_mass_sign(x: float, y: float, scale: float = 1.0) -> str:
    """The quartered circle."""
    return (
        f'<g transform="translate({x:.1f} {y:.1f}) scale({scale:.2f})" class="mass"><circle r="4.6"/>'
        '<path d="M0 0V-4.6A4.6 4.6 0 0 1 4.6 0ZM0 0V4.6A4.6 4.6 0 0 1 -4.6 0Z" class="dot"/></g>'
    )


def joint_icon(kind: str) -> Markup:
    """The sign of a joint by itself, for tables."""
    axis = (0.0, 0.0) if kind in ("revolute", "spherical", "universal", "fixed") else (1.0, 0.0)
    sign = joint_sign(kind, 18.0, 10.0, axis)
    return Markup(
        f'<svg class="machine icon" viewBox="0 0 36 20" width="36" height="20" aria-hidden="true">{sign}</svg>'
    )
