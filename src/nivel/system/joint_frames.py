"""Where a joint's two markers are on their bodies."""

from __future__ import annotations

import numpy as np

from nivel.machine.joint import Joint
from nivel.machine.machine_record import MachineRecord
from nivel.machine.marker import Marker
from nivel.machine.orientation import matrix_from_euler_parameters
from nivel.machine.placement import frame_from_axes, marker_frame, placement
from nivel.system.system import Array

Placed = tuple[str, Array, Array]


def joint_frames(machine: MachineRecord, joint: Joint) -> tuple[Placed, Placed]:
    """(body, point (3,), axes (3, 3)) of the first and of the second marker, point and axes in the body's frame."""
    if joint.markers is not None:
        named = {marker.name: marker for marker in machine.markers}
        first, second = (named[m] if isinstance(m, str) else m for m in joint.markers)
        return _of_marker(first), _of_marker(second)
    assert joint.bodies is not None  # the record was checked
    assert joint.point is not None
    first_axes, second_axes = _global_axes(joint)
    point = np.array(joint.point, dtype=float)
    first, second = joint.bodies
    return _seen_from(machine, first, point, first_axes), _seen_from(machine, second, point, second_axes)


def _of_marker(marker: Marker) -> Placed:
    return marker.body, *marker_frame(marker)


def _global_axes(joint: Joint) -> tuple[Array, Array]:
    """Global axes of both markers of a joint placed by a point: equal, so every joint coordinate starts at zero.

    A universal joint has z along its own arm and x along the other one.
    """
    if joint.axes is not None:
        arm_1, arm_2 = (np.array(axis, dtype=float) for axis in joint.axes)
        return frame_from_axes(arm_1, arm_2), frame_from_axes(arm_2, arm_1)
    if joint.axis is None:
        return np.eye(3), np.eye(3)
    x_axis = None if joint.x_axis is None else np.array(joint.x_axis, dtype=float)
    axes = frame_from_axes(np.array(joint.axis, dtype=float), x_axis)
    return axes, axes


def _seen_from(machine: MachineRecord, name: str, point: Array, axes: Array) -> Placed:
    """A global point and axes in the frame of the body as it is placed in the file."""
    if name == "ground":
        return name, point, axes
    body = next(body for body in machine.bodies if body.name == name)
    position, theta = placement(body)
    A = matrix_from_euler_parameters(theta)
    return name, A.T @ (point - position), A.T @ axes
