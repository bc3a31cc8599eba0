"""Turns that mean nothing: of a rod between two balls, of a piston in its bore; and which joint stops them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nivel.machine.core.record import GROUND
from nivel.machine.joints.joint import Joint
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import UnknownCoordinateError, resolve
from nivel.system.joints.joints import JOINTS
from nivel.system.system import Array


def idle_angles(machine: MachineRecord) -> frozenset[str]:
    """Angles of cylindrical joints that no driver, coupling or force acts on, as `JOINT.angle`."""
    used = set()
    for each in (*machine.drivers, *machine.forces, *machine.couplings):
        references = (getattr(each, "coordinate", None), *(getattr(each, "coordinates", None) or ()))
        for reference in (*references, *(getattr(each, "joints", None) or ())):
            if isinstance(reference, str):
                used.add(_resolved(machine, reference))
    return frozenset(f"{joint.name}.angle" for joint in machine.joints if _is_bore(joint)) - used


def _resolved(machine: MachineRecord, reference: str) -> str:
    try:
        return ".".join(resolve(reference, machine.joints))
    except UnknownCoordinateError:  # only an angle can be meant
        return f"{reference}.angle"


def without_turn(machine: MachineRecord, joints: Sequence[str], axis: Array) -> str:
    """Which of the `joints` on the `axis` (3,) of a turn to change so that it stops, in words; empty where none is known."""
    through = [joint for joint in machine.joints if joint.name in joints]
    bores = [joint for joint in through if _is_bore(joint)]
    balls = [joint for joint in through if JOINTS[joint.type].is_ball and JOINTS[joint.type].without_turn]
    fixed = [joint for joint in bores if GROUND in (joint.bodies or ())]
    if fixed or (bores and not balls):
        bore = (fixed or bores)[0]
        return f"make {bore.name} {JOINTS[bore.type].without_turn}"
    if not balls:
        return ""
    change = f"make {balls[0].name} {JOINTS[balls[0].type].without_turn}"
    if balls[0].markers is not None:
        return f"{change}, with the z axes of its markers across that axis"
    return f"{change}, with `axes: {_across(axis)}`"


def _is_bore(joint: Joint) -> bool:
    """Whether it slides and turns about one axis, and a kind that only slides can stand in its place."""
    return "angle" in joint.coordinates and bool(JOINTS[joint.type].without_turn)


def _across(axis: Array) -> str:
    """Two directions across `axis` and each other, as they are written in a file."""
    along = axis / np.linalg.norm(axis)
    first = np.eye(3)[int(np.argmin(np.abs(axis)))]
    across = np.asarray(np.cross(along, first), dtype=np.float64)
    first = across / np.linalg.norm(across)
    return "[" + ", ".join(_written(each) for each in np.array([first, np.cross(axis, first)])) + "]"


def _written(direction: Array) -> str:
    return "[" + ", ".join(f"{round(float(each), 6) + 0.0:g}" for each in direction) + "]"
