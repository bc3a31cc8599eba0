"""Signs of joints as in textbooks, in SVG about their points, the joint axis to the right (`seen`) or end-on. Sizes in pixels."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

RADIUS: Final = 6.5
PLANE_GAP: Final = 5.0  # from a point on a plane to the plane in the sign
BALL: Final = '<circle r="4.6"/><circle r="2.4" class="dot"/>'
HINGE: Final = '<circle r="4.6"/><circle r="1.3" class="dot"/>'
SLEEVE: Final = '<rect x="-3.5" y="-6" width="7" height="12" rx="2"/><path d="M0 -9.5V9.5" class="axis"/>'


def revolute(seen: bool) -> str:
    if not seen:
        return f'<circle r="{RADIUS}"/><circle r="1.6" class="dot"/>'
    return '<rect x="-9" y="-5" width="18" height="10" rx="2.5"/><path d="M-14 0H14" class="axis"/>'


def cylindrical(seen: bool) -> str:
    if not seen:
        return f'<circle r="{RADIUS}"/><circle r="3" class="thin"/>'
    arrows = '<path d="M-15.5 0l4-2.6v5.2zM15.5 0l-4-2.6v5.2z" class="dot"/>'
    return f'<path d="M-15 0H15" class="axis"/><rect x="-8" y="-5" width="16" height="10" rx="2.5"/>{arrows}'


def translational(seen: bool) -> str:
    if not seen:
        return '<rect x="-6" y="-6" width="12" height="12"/><rect x="-2.5" y="-2.5" width="5" height="5" class="thin"/>'
    return '<path d="M-17 -6.5H17M-17 6.5H17" class="axis"/><rect x="-9" y="-4.5" width="18" height="9"/>'


def spherical(seen: bool) -> str:
    return f'<circle r="{RADIUS}"/><circle r="3.6" class="dot"/>'


def universal(seen: bool) -> str:
    return f'<circle r="{RADIUS}"/><path d="M-4.4 -4.4L4.4 4.4M-4.4 4.4L4.4 -4.4" class="axis"/>'


def fixed(seen: bool) -> str:
    return '<rect x="-5.5" y="-5.5" width="11" height="11" class="solid"/>'


def planar(seen: bool) -> str:
    if not seen:
        arrows = "M0 -10l-2.6 4h5.2zM0 10l-2.6 -4h5.2zM-10 0l4 -2.6v5.2zM10 0l-4 -2.6v5.2z"
        return f'<rect x="-10.5" y="-10.5" width="21" height="21" rx="2"/><path d="{arrows}" class="dot"/>'
    return '<rect x="-2.5" y="-8" width="7" height="16"/><path d="M-5 -15V15" class="axis"/>'


def point_on_line(seen: bool) -> str:
    if not seen:
        return '<circle r="5"/><path d="M-2.6 0H2.6M0 -2.6V2.6" class="axis"/>'
    return '<path d="M-17 0H17" class="axis"/><circle r="4.6" class="solid"/>'


def point_on_plane(seen: bool) -> str:
    if not seen:
        return '<rect x="-9" y="-9" width="18" height="18" class="thin"/><circle r="4.2" class="solid"/>'
    return f'<path d="M{-PLANE_GAP} -15V15" class="axis"/><circle r="4.2" class="solid"/>'


def rolling(seen: bool) -> str:
    if not seen:
        return '<circle r="9"/><circle r="1.6" class="dot"/>'
    return '<path d="M-9 -15V15" class="axis"/><circle r="9"/><circle r="1.6" class="dot"/>'


def screw(seen: bool) -> str:
    if not seen:
        return f'<circle r="{RADIUS}"/><path d="M3.4 0A3.4 3.4 0 1 1 0 -3.4" class="axis"/>'
    thread = "".join(f"M{k} 5l4 -10" for k in (-8, -4, 0, 4))
    return (
        '<path d="M-15 0H15" class="axis"/><rect x="-8" y="-5" width="16" height="10" rx="1"/>'
        f'<path d="{thread}" class="thin"/>'
    )


def pin_in_slot(seen: bool) -> str:
    if not seen:
        return '<rect x="-6" y="-6" width="12" height="12" rx="3"/><circle r="2.6" class="solid"/>'
    return '<rect x="-15" y="-5.5" width="30" height="11" rx="5.5"/><circle r="3.8" class="solid"/>'


def on_beam(slider: str) -> Callable[[bool], str]:
    """What slides on a line that bends."""
    line = '<path d="M-17 4Q0 -4 17 4" class="axis"/>'
    return lambda seen: f"{line}{slider}"


def rod(first: str, second: str) -> Callable[[bool], str]:
    """A massless link, small, between the signs of its ends."""
    bar = '<path d="M-11 0H11" class="axis"/>'
    return lambda seen: f'{bar}<g transform="translate(-11 0)">{first}</g><g transform="translate(11 0)">{second}</g>'


def cylinder(seen: bool) -> str:
    """A cylinder with its rod, between two balls."""
    barrel = '<rect x="-9" y="-4" width="11" height="8" rx="1"/><path d="M-4 -4V4M-4 0H11" class="axis"/>'
    ends = f'<g transform="translate(-12 0)">{BALL}</g><g transform="translate(12 0)">{BALL}</g>'
    return f"{barrel}{ends}"


def skew_universal(seen: bool) -> str:
    return f'{universal(seen)}<path d="M-2 8L2 4" class="axis"/>'


def translational_universal(seen: bool) -> str:
    return f'{translational(seen)}<path d="M0 -4V4M-4 0H4" class="axis"/>'


def generic(seen: bool) -> str:
    return f'{unknown(seen)}<circle r="2.4" class="dot"/>'


def unknown(seen: bool) -> str:
    return f'<circle r="{RADIUS}" class="thin"/>'
