"""Connection of a machine to the ground: joined, or flying freely."""

from __future__ import annotations

from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.system.states.relative import bodies_of
from nivel.system.system import System


def touches_ground(machine: MachineRecord, system: System) -> bool:
    """Whether a joint, a driver of a marker or a force joins a body to the ground."""
    joined = {body for joint in machine.joints for body in bodies_of(machine, joint)}
    for driver in machine.drivers:
        if driver.marker is not None:
            seen = driver.reference
            joined |= {machine.marker_named[name].body for name in (driver.marker, seen) if name is not None}
            joined |= {GROUND} if seen is None else set()
    return GROUND in joined or any(system.body_count in each.bodies for each in system.coupled)
