"""Checks of directions that records share."""

from __future__ import annotations

import math
from collections.abc import Iterator

from nivel.machine.core.checked import Problem
from nivel.machine.core.placement import PARALLEL, angle_between

Triple = tuple[float, float, float]


def no_direction(name: str, direction: Triple | None) -> Iterator[Problem]:
    """Whether `direction`, the field `name`, is a zero vector."""
    if direction is not None and not any(direction):
        yield Problem((name,), f"`{name}` has no direction: it is zero")


def bad_axis_pair(axis: Triple | None, x_axis: Triple | None) -> Iterator[Problem]:
    """Whether a direction is zero, and whether `x_axis` lacks an `axis` or is parallel to it."""
    zero = [*no_direction("axis", axis), *no_direction("x_axis", x_axis)]
    yield from zero
    if x_axis is None or zero:
        return
    if axis is None:
        yield Problem(("x_axis",), "`x_axis` needs an `axis` (the z axis)")
    elif parallel(axis, x_axis):
        yield Problem(("x_axis",), "`x_axis` is parallel to `axis`; it must point elsewhere")


def parallel(first: Triple, second: Triple) -> bool:
    """Whether two directions, not zero, lie along one line."""
    angle = angle_between(first, second)
    return min(angle, math.pi - angle) < PARALLEL
