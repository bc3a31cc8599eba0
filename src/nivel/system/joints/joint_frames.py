"""Frames of a joint: its two markers on their bodies."""

from __future__ import annotations

import numpy as np

from nivel.machine.core.between import End, GlobalPoint
from nivel.machine.core.placement import frame_from_axes
from nivel.machine.joints.joint import Joint
from nivel.machine.machine_record import MachineRecord
from nivel.system.joints.interfaces import joint_point, marker_place
from nivel.system.tables import Array

Placed = tuple[str, Array, Array]


def joint_frames(machine: MachineRecord, joint: Joint) -> tuple[Placed, Placed]:
    """(body, point (3,), axes (3, 3)) of the first and of the second marker, point and axes in the body's frame."""
    if joint.markers is not None:
        first, second = (machine.marker_named[m] if isinstance(m, str) else m for m in joint.markers)
        return marker_place(machine, first), marker_place(machine, second)
    assert joint.bodies is not None  # the record was checked
    points = joint.points or (joint_point(machine, joint),) * 2
    first_axes, second_axes = _global_axes(joint)
    first, second = (np.array(point, dtype=float) for point in points)
    return (
        seen_from(machine, joint.bodies[0], first, first_axes),
        seen_from(machine, joint.bodies[1], second, second_axes),
    )


def slot_frame(machine: MachineRecord, joint: Joint) -> Placed:
    """Of a pin in a slot: a third marker, at the second, with z along the slot; given by markers this is the second's x axis."""
    _, (body, point, frame) = joint_frames(machine, joint)
    if joint.axes is None:
        return body, point, frame_from_axes(frame[:, 0])
    return seen_from(machine, body, joint_point(machine, joint), frame_from_axes(joint.axes[1]))


def _global_axes(joint: Joint) -> tuple[Array, Array]:
    """Global axes of both markers of a joint placed by points: where they are equal, every joint coordinate starts at zero.

    A universal joint has z along its own arm and x along the other one; a pin in a slot z along the pin; a link that turns about an
    axis x towards its second point.
    """
    if joint.axes is not None:
        first, second = (np.array(axis, dtype=float) for axis in joint.axes)
        match joint.type:
            case "revolute-translational":
                axes = frame_from_axes(first)
                return axes, axes
            case "rolling":
                return frame_from_axes(first, joint.x_axis), frame_from_axes(second)
            case "revolute-cylindrical":
                return frame_from_axes(first), frame_from_axes(second)
            case "translational-universal":
                assert joint.axis is not None  # the record was checked
                return frame_from_axes(joint.axis, first), frame_from_axes(second, first)
        return frame_from_axes(first, second), frame_from_axes(second, first)
    if joint.axis is None:
        return np.eye(3), np.eye(3)
    axes = frame_from_axes(joint.axis, joint.x_direction)
    return axes, axes


def seen_from(machine: MachineRecord, name: str, point: Array, axes: Array) -> Placed:
    """A global point (3,) and axes (3, 3) in the frame of the body `name` as it is placed in the file."""
    if name == "ground":
        return name, point, axes
    position, A = machine.placed[name]
    return name, A.T @ (point - position), A.T @ axes


def as_placed(machine: MachineRecord, end: End) -> Placed:
    """Body, global point (3,) and global axes (3, 3) of where something acts, as its body is placed; the axes of a point are global."""
    if isinstance(end, GlobalPoint):
        return end.body, np.array(end.point, dtype=float), np.eye(3)
    body, point, axes = marker_place(machine, machine.marker_named[end] if isinstance(end, str) else end)
    if body == "ground":
        return body, point, axes
    position, A = machine.placed[body]
    return body, position + A @ point, A @ axes


def cosine_as_placed(machine: MachineRecord, first: Placed, second: Placed) -> float:
    """Cosine of the angle between the z axes of two markers as the file places their bodies."""
    axes = []
    for body, _, frame in (first, second):
        A = np.eye(3) if body == "ground" else machine.placed[body][1]
        axes.append(A @ frame[:, 2])
    return float(axes[0] @ axes[1])
