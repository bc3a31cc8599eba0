"""Parallel axes of joints: those that differ by no more than the digits of an export are taken as one direction.

The direction is that of the first joint in the file that has it. The markers of the others are turned on their bodies, by the smallest
rotation, before anything is computed: all coordinates and formulations see the same axes.
"""

from __future__ import annotations

import numpy as np

from nivel.lazy import dataclass, field
from nivel.machine.core.vectors import cross
from nivel.machine.machine_record import MachineRecord
from nivel.system.joints.joint_frames import Placed, joint_frames
from nivel.system.joints.joints import composition_of
from nivel.system.tables import Array

# Axes that differ by less than this [rad] are parallel to round-off: nothing is turned.
ROUND_OFF = 1e-15


@dataclass
class Directions:
    """The directions (3,) that the axes of a machine have had so far, as placed; axes nearer than `tolerance` [rad] have one."""

    tolerance: float
    found: list[Array] = field(default_factory=list)

    def straightened(self, machine: MachineRecord, placed: Placed) -> Placed:
        """The marker with its z axis, as the file places its body, along a direction that is there already; else it becomes one."""
        body, point, frame = placed
        A = np.eye(3) if body == "ground" else machine.placed[body][1]
        z = A @ frame[:, 2]
        for k in _near(self.found, z, self.tolerance):
            known = self.found[k]
            along = known if known @ z > 0.0 else -known
            off = apart(along, z)
            if off <= ROUND_OFF:
                return placed
            if off <= self.tolerance:
                return body, point, A.T @ _turn(z, along) @ A @ frame
        self.found.append(z)
        return placed


@dataclass(frozen=True)
class Tilt:
    """An axis that is nearly parallel to those of `others`, more of them than of its own kind: their names, and the angle [rad]."""

    joint: str
    others: tuple[str, ...]
    angle: float


def tilted_axes(machine: MachineRecord, most: float) -> tuple[Tilt, ...]:
    """Axes that are parallel to others to `most` [rad] but not to the tolerance of the machine, the largest angle first."""
    directions: list[Array] = []
    names: list[list[str]] = []
    for joint in machine.joints:
        if not composition_of(joint).parallel:
            continue
        body, _, frame = joint_frames(machine, joint)[0]
        z = (np.eye(3) if body == "ground" else machine.placed[body][1]) @ frame[:, 2]
        near = _near(directions, z, machine.assembly.parallel)
        own = next((k for k in near if apart(directions[k], z) <= machine.assembly.parallel), None)
        if own is None:
            directions.append(z)
            names.append([joint.name])
        else:
            names[own].append(joint.name)
    out = []
    for k, z in enumerate(directions):
        for n in _near(directions, z, most):
            if n != k and apart(directions[n], z) <= most and (len(names[n]), -n) > (len(names[k]), -k):
                out += [Tilt(name, tuple(names[n]), apart(directions[n], z)) for name in names[k]]
    return tuple(sorted(out, key=lambda tilt: -tilt.angle))


def _near(directions: list[Array], z: Array, most: float) -> list[int]:
    """Those of the directions that may be parallel to z to `most` [rad]."""
    if not directions:
        return []
    return np.flatnonzero(np.abs(np.array(directions) @ z) >= np.cos(most) - 1e-12).tolist()


def apart(a: Array, b: Array) -> float:
    """The angle between two lines along unit vectors [rad]."""
    return float(np.arctan2(np.linalg.norm(cross(a, b)), abs(a @ b)))


def _turn(a: Array, b: Array) -> Array:
    """The smallest rotation (3, 3) that takes the unit vector a to b, which is near: 1 + ṽ + ṽ²/(1 + a·b), v = a × b."""
    x, y, z = cross(a, b)
    v = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + v + v @ v / (1.0 + a @ b)
