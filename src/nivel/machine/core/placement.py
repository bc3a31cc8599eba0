"""Placement of frames at the start: body frames, also those laid between two points, frames given by axes, and checks of these."""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from nivel.known import Body, Marker
from nivel.machine.bodies.shape import Standing
from nivel.machine.core import orientation
from nivel.machine.core.record import Problem
from nivel.machine.core.vectors import Array, cross

VERTICAL: Final = 1e-3  # [rad] a bar closer than this to ±Z takes its z axis from global Y
PARALLEL: Final = 1e-3  # [rad] two axes closer than this define no plane
TIE: Final = 1e-6  # components closer than this are equally perpendicular

Triple = tuple[float, float, float]


def placement(body: Body) -> tuple[Array, Array]:
    """Position (3,) [m] of the origin and Euler parameters (4,) of the frame of `body`, global, as given (before
    assembly).

    Between two points: the origin is their midpoint and x points from the first to the second (`frame_between`).
    """
    shape = body.shape
    if shape is not None and not isinstance(shape, Standing) and shape.from_ is not None and shape.to is not None:
        start, end = np.array(shape.from_), np.array(shape.to)
        return (start + end) / 2, orientation.euler_parameters_from_matrix(frame_between(start, end))
    return np.array(body.position or (0.0, 0.0, 0.0)), orientation.euler_parameters(body.orientation)


def initial_velocity(body: Body) -> tuple[Array, Array]:
    """Velocity (3,) [m/s] of the origin, global axes, and angular velocity (3,) [rad/s] in body axes, as given
    (before assembly).
    """
    velocity = np.array(body.velocity)
    if body.angular_velocity_body is not None:
        return velocity, np.array(body.angular_velocity_body)
    if body.angular_velocity is None:
        return velocity, np.zeros(3)
    return velocity, orientation.matrix_from_euler_parameters(placement(body)[1]).T @ np.array(body.angular_velocity)


def marker_frame(marker: Marker) -> tuple[Array, Array]:
    """Position (3,) [m] and axes (3, 3) (columns x, y, z) of a marker, in the frame of its body."""
    if marker.axis is not None:
        return np.array(marker.position), frame_from_axes(marker.axis, marker.x_axis)
    return np.array(marker.position), orientation.rotation_matrix(marker.orientation)


def frame_between(start: ArrayLike, end: ArrayLike) -> Array:
    """(3, 3), columns x, y, z: x points from `start` to `end`; z is the global Z made perpendicular to x.

    Where x is within VERTICAL of ±Z, z is the global Y made perpendicular to x. y = z × x.
    """
    x = _unit(np.subtract(end, start))
    vertical = np.hypot(x[0], x[1]) < np.sin(VERTICAL)
    z = _perpendicular(np.array([0.0, 1.0, 0.0]) if vertical else np.array([0.0, 0.0, 1.0]), x)
    return np.column_stack([x, cross(z, x), z])


def frame_from_axes(axis: ArrayLike, x_axis: ArrayLike | None = None) -> Array:
    """(3, 3), columns x, y, z in the parent frame: z is along `axis`, x is `x_axis` made perpendicular to it; y = z ×
    x.

    Without `x_axis`, x comes from the parent axis most perpendicular to `axis`; among equals the first of X, Y, Z.
    """
    z = _unit(np.asarray(axis, dtype=float))
    x = _perpendicular(most_perpendicular(z) if x_axis is None else np.asarray(x_axis, dtype=float), z)
    return np.column_stack([x, cross(z, x), z])


def most_perpendicular(direction: Array) -> Array:
    """The parent axis (3,) with the smallest share of `direction` (3,); among equals the first."""
    share = [abs(each) for each in _unit(direction).tolist()]
    return np.eye(3)[next((k for k in range(3) if share[k] <= min(share) + TIE), 0)]


def angle_between(first: ArrayLike, second: ArrayLike) -> float:
    """[rad] between two directions, 0 to π."""
    a, b = _unit(np.asarray(first, dtype=float)), _unit(np.asarray(second, dtype=float))
    return float(np.arctan2(np.linalg.norm(cross(a, b)), a @ b))


def _unit(vector: Array) -> Array:
    vector = vector / max(map(abs, vector.tolist()))  # no overflow in the norm
    return vector / math.sqrt(vector @ vector)


def _perpendicular(vector: Array, to: Array) -> Array:
    """The unit vector along the part of `vector` that is perpendicular to the unit vector `to`."""
    # twice: the first difference is nearly zero where they are nearly parallel, and its round-off is not
    for _ in range(2):
        vector = _unit(vector)
        vector = vector - (vector @ to) * to
    return _unit(vector)


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
