"""Screw joints between a shaft in its bearing and a body on its rail, as couplings: one equation in place of five, of which four repeat
those of bearing and rail.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from math import pi

import numpy as np

from nivel.machine.joints.joint import Joint
from nivel.machine.machine_record import MachineRecord


def screws_as_couplings(machine: MachineRecord, names: Collection[str]) -> Iterator[tuple[str, str]]:
    """Name of each of these screw joints that can be written as a coupling, and the lines of the machine file for it."""
    for joint in machine.joints:
        if joint.type == "screw" and joint.name in names:
            line = _coupling(machine, joint)
            if line:
                yield joint.name, line


def _coupling(machine: MachineRecord, screw: Joint) -> str:
    """a·r d + (p/2π) a·v φ = 0 of the screw's axis a, the rail's r and the bearing's v, each of which carries its second body."""
    if screw.bodies is None or screw.axis is None:
        return ""
    for shaft, moved in (screw.bodies, screw.bodies[::-1]):
        bearing, rail = _carrying(machine, shaft, "revolute"), _carrying(machine, moved, "translational")
        if bearing is None or rail is None:
            continue
        a, v, r = (np.array(joint.axis, dtype=float) for joint in (screw, bearing, rail))
        a, v, r = a / np.linalg.norm(a), v / np.linalg.norm(v), r / np.linalg.norm(r)
        sides = [1.0 if joint.bodies[1] == body else -1.0 for joint, body in ((bearing, shaft), (rail, moved))]  # type: ignore[index]
        factor = (screw.pitch or 0.0) / (2.0 * pi) * round(float(a @ v)) * round(float(a @ r)) * sides[0] * sides[1]
        coordinates = f"[{rail.name}.displacement, {bearing.name}.angle]"
        return f"{screw.name}: {{type: linear, coordinates: {coordinates}, factors: [1, {factor:.12g}]}}"
    return ""


def _carrying(machine: MachineRecord, body: str, kind: str) -> Joint | None:
    """The joint of a type on a body, if it is placed by an axis."""
    found = [each for each in machine.joints if each.type == kind and each.axis and body in (each.bodies or ())]
    return found[0] if len(found) == 1 else None
