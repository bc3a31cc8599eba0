"""Checks of directions that records share."""

from __future__ import annotations

import math

from nivel.machine.placement import PARALLEL, angle_between
from nivel.machine.quantity import fault

Triple = tuple[float, float, float]


def check_direction(name: str, direction: Triple | None) -> None:
    """Refuse a zero vector."""
    if direction is not None and not any(direction):
        raise fault(f"`{name}` has no direction: it is zero")


def check_axis_pair(axis: Triple | None, x_axis: Triple | None) -> None:
    """`x_axis` needs an `axis` and is not parallel to it."""
    check_direction("axis", axis)
    check_direction("x_axis", x_axis)
    if x_axis is None:
        return
    if axis is None:
        raise fault("`x_axis` needs an `axis` (the z axis)")
    angle = angle_between(axis, x_axis)
    if min(angle, math.pi - angle) < PARALLEL:
        raise fault("`x_axis` is parallel to `axis`; it must point elsewhere")
