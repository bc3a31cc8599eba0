"""Frames of joints and markers on their bodies, at interfaces of flexible bodies too, and their axes, parallel ones made so.

The direction is that of the first joint in the file that has it. The markers of the others are turned on their bodies, by the smallest
rotation, before anything is computed: all coordinates and formulations see the same axes.
"""

import math
from difflib import get_close_matches
from functools import lru_cache

import numpy as np

from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.errors import Fault, ModelError, gathered, located, refuse
from nivel.known import Interface
from nivel.lazy import Struct
from nivel.machine.core.element import End, GlobalPoint, Marker
from nivel.machine.core.placement import Triple, frame_from_axes, marker_frame
from nivel.machine.core.vectors import cross
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.references import markers_of
from nivel.system.flexible import reduced_body
from nivel.system.tables import Array

Placed = tuple[str, Array, Array]
Pair = tuple[Triple, Triple]


def joint_frames(machine: MachineRecord, joint: Joint) -> tuple[Placed, Placed]:
    """(body, point (3,), axes (3, 3)) of the first and of the second marker, point and axes in the body's frame."""
    if joint.markers is not None:
        first, second = (machine.marker_named[m] if isinstance(m, str) else m for m in joint.markers)
        return marker_place(machine, first), marker_place(machine, second)
    assert joint.bodies is not None  # the record was checked
    points = joint.points or (joint_point(machine, joint),) * 2
    first_axes, second_axes = _global_axes(joint.type, joint.axes, joint.axis, joint.x_axis, joint.x_direction)
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


@lru_cache(maxsize=64)  # many joints of a machine have one direction
def _global_axes(
    kind: str, both: Pair | None, axis: Triple | None, x_axis: Triple | None, x_direction: Triple | None
) -> tuple[Array, Array]:
    """Global axes of both markers of a joint placed by points, not to be changed: where they are equal, every joint coordinate starts at
    zero.

    A universal joint has z along its own arm and x along the other one; a pin in a slot z along the pin; a link that turns about an
    axis x towards its second point.
    """
    if both is not None:
        first, second = both
        match kind:
            case "revolute-translational":
                axes = frame_from_axes(first)
                return axes, axes
            case "rolling":
                return frame_from_axes(first, x_axis), frame_from_axes(second)
            case "revolute-cylindrical":
                return frame_from_axes(first), frame_from_axes(second)
            case "translational-universal":
                assert axis is not None  # the record was checked
                return frame_from_axes(axis, first), frame_from_axes(second, first)
        return frame_from_axes(first, second), frame_from_axes(second, first)
    if axis is None:
        return np.eye(3), np.eye(3)
    axes = frame_from_axes(axis, x_direction)
    return axes, axes


def seen_from(machine: MachineRecord, name: str, point: Array, axes: Array) -> Placed:
    """A global point (3,) and axes (3, 3) in the frame of the body `name` as it is placed in the file."""
    if name == "ground":
        return name, point, axes
    position, A = machine.placed[name]
    return name, A.T @ (point - position), A.T @ axes


def axes_as_placed(machine: MachineRecord, name: str) -> Array:
    """(3, 3) of a body as it is placed in the file, or of the ground."""
    return np.eye(3) if name == "ground" else machine.placed[name][1]


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
    a, b = (axes_as_placed(machine, body) @ frame[:, 2] for body, _, frame in (first, second))
    return float(a @ b)


# [m] two interfaces nearer than this, as placed, are one place of a joint
SAME = 1e-9


def refuse_unknown_interfaces(machine: MachineRecord) -> None:
    """Raises ModelError naming every marker and joint at an interface that is not there."""
    faults: list[Fault] = []
    for place, marker in markers_of(machine):
        section, at = str(place[0]), int(place[1])
        if marker.interface is not None:
            with gathered(faults), located(f"{section}.{getattr(machine, section)[at].name}"):
                interface_of(machine, marker.body, marker.interface)
    for joint in machine.joints:
        if joint.interface is not None:
            with gathered(faults), located(f"joints.{joint.name}.interface"):
                joint_point(machine, joint)
    refuse(faults)


def marker_place(machine: MachineRecord, marker: Marker) -> tuple[str, Array, Array]:
    """Body, point (3,) [m] and axes (3, 3) of a marker in the frame of its body; its interface exists."""
    position, axes = marker_frame(marker)
    if marker.interface is not None:
        position = interface_of(machine, marker.body, marker.interface).position
    return marker.body, position, axes


def interface_of(machine: MachineRecord, body: str, name: str) -> Interface:
    """The interface `name` of a flexible body. Raises ModelError where there is none."""
    reduced = reduced_body(machine.body_named[body])
    names = [each.name for each in reduced.interfaces]
    if name not in names:
        near = get_close_matches(name, names, n=1)
        hint = f"did you mean `{near[0]}`?" if near else f"there are {', '.join(names) or 'none'}"
        raise ModelError(Fault.at("", f"the flexible body `{body}` has no interface `{name}`; {hint}"))
    return reduced.interface(name)


def joint_point(machine: MachineRecord, joint: Joint) -> Array:
    """(3,) [m] the global point of a joint placed by one, as its bodies are placed: given, or that of the interface it names.

    Raises ModelError where none of its bodies has this interface, or both at different places.
    """
    if joint.interface is None:
        return np.array(joint.point, dtype=float)
    assert joint.bodies is not None  # the record was checked
    faults: list[Fault] = []
    points = []
    for body in joint.bodies:
        if body in machine.body_named and machine.body_named[body].flexible is not None:
            with gathered(faults):
                interface = interface_of(machine, body, joint.interface)
                position, axes = machine.placed[body]
                points.append(position + axes @ interface.position)
    if not points:
        raise ModelError(faults)
    if np.linalg.norm(points[0] - points[-1]) > SAME * (1.0 + np.abs(points).max()):
        message = (
            f"both bodies have an interface `{joint.interface}`, at different places: give the joint by two `markers`"
        )
        raise ModelError(Fault.at("", message))
    return points[0]


# Axes that differ by less than this [rad] are parallel to round-off: nothing is turned.
ROUND_OFF = 1e-15


class Directions:
    """Directions (3,) that axes of a machine have had so far, as placed; axes nearer than `tolerance` [rad] have one."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance, self.count, self.found = tolerance, 0, np.zeros((8, 3))

    def add(self, z: Array) -> None:
        """One more direction."""
        if self.count == len(self.found):
            self.found = np.concatenate([self.found, np.zeros_like(self.found)])
        self.found[self.count] = z
        self.count += 1

    def near(self, z: Array, most: float) -> list[tuple[int, float]]:
        """Number of each direction that is parallel to z to `most` [rad], and its angle [rad], in their order."""
        may = np.flatnonzero(np.abs(self.found[: self.count] @ z) >= np.cos(most) - 1e-12).tolist()
        return [(k, angle) for k in may if (angle := apart(self.found[k], z)) <= most]

    def straightened(self, machine: MachineRecord, placed: Placed) -> Placed:
        """The marker with its z axis, as the file places its body, along a direction that is there already; else it becomes one."""
        body, point, frame = placed
        A = axes_as_placed(machine, body)
        z = A @ frame[:, 2]
        k, off = next(iter(self.near(z, self.tolerance)), (self.count, 0.0))
        if k == self.count:
            self.add(z)
        if off <= ROUND_OFF:
            return placed
        known = self.found[k]
        along = known if known @ z > 0.0 else -known
        return body, point, A.T @ _turn(z, along) @ A @ frame


class Tilt(Struct):
    """An axis that is nearly parallel to those of `others`, more of them than of its own kind: their names, and the angle [rad]."""

    joint: str
    others: tuple[str, ...]
    angle: float


def tilted_axes(machine: MachineRecord, most: float) -> tuple[Tilt, ...]:
    """Axes that are parallel to others to `most` [rad] but not to the tolerance of the machine, the largest angle first."""
    directions, names = Directions(machine.assembly.parallel), list[list[str]]()
    for joint in machine.joints:
        if not JOINTS[joint.type].of(joint).parallel:
            continue
        body, _, frame = joint_frames(machine, joint)[0]
        z = axes_as_placed(machine, body) @ frame[:, 2]
        near = directions.near(z, directions.tolerance)
        if near:
            names[near[0][0]].append(joint.name)
        else:
            directions.add(z)
            names.append([joint.name])
    out = []
    for k in range(directions.count):
        for n, angle in directions.near(directions.found[k], most):
            if n != k and (len(names[n]), -n) > (len(names[k]), -k):
                out += [Tilt(name, tuple(names[n]), angle) for name in names[k]]
    return tuple(sorted(out, key=lambda tilt: -tilt.angle))


def apart(a: Array, b: Array) -> float:
    """The angle between two lines along unit vectors [rad]."""
    across = cross(a, b)
    return math.atan2(math.sqrt(across @ across), abs(a @ b))


def _turn(a: Array, b: Array) -> Array:
    """The smallest rotation (3, 3) that takes the unit vector a to b, which is near: 1 + ṽ + ṽ²/(1 + a·b), v = a × b."""
    x, y, z = cross(a, b)
    v = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + v + v @ v / (1.0 + a @ b)
