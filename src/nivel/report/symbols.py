"""Signs of joints as in textbooks, in SVG. Sizes in pixels of the picture."""

from __future__ import annotations

import math

from markupsafe import Markup

from nivel.system.joints.joints import looks_of, symbol_of

END_ON = 0.35  # a joint axis whose projection is shorter than this fraction of its length is seen end-on


def joint_sign(kind: str, x: float, y: float, axis: tuple[float, float] = (0.0, 1.0), scale: float = 1.0) -> str:
    """The sign of a joint at (x, y).

    axis : on the screen, right and down, as long as it is seen (1: in the plane of the picture, 0: end-on). It is the joint axis,
    of a plane its normal, of a pin in a slot the slot.
    """
    length = math.hypot(*axis)
    seen = length > END_ON
    angle = math.degrees(math.atan2(axis[1], axis[0])) if seen else 0.0
    body = symbol_of(kind)(seen)
    return f'<g transform="translate({x:.1f} {y:.1f}) rotate({angle:.1f}) scale({scale:.2f})" class="joint">{body}</g>'


def joint_icon(kind: str) -> Markup:
    """The sign of a joint by itself, for tables."""
    sign = joint_sign(kind, 18.0, 10.0, looks_of(kind).icon)
    return Markup(
        f'<svg class="machine icon" viewBox="0 0 36 20" width="36" height="20" aria-hidden="true">{sign}</svg>'
    )
