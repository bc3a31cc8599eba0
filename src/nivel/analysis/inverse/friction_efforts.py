"""Inverse dynamics of machines with friction: where the actuators act on what drivers prescribe, their efforts are those of the drivers.

Friction is loaded by reactions, which depend on the efforts that are sought. The kinematic analysis finds both together; the effort of a
driver on a joint coordinate is then that of an actuator in its place.
"""

from __future__ import annotations

import numpy as np

from nivel.analysis.inverse.actuators import Actuation
from nivel.elements.forces.friction import Friction
from nivel.errors import Fault, ModelError
from nivel.machine.forces.sticking import holds_by_capacity
from nivel.machine.machine_record import MachineRecord
from nivel.results.analyses.efforts import Efforts
from nivel.results.result import Result


def rubs(machine: MachineRecord) -> bool:
    """Whether the machine has friction."""
    return any(isinstance(force, Friction) or holds_by_capacity(force) for force in machine.forces)


def acting_drivers(machine: MachineRecord, actuation: Actuation, *, recorded: bool) -> tuple[str, ...]:
    """The drivers in whose place the actuators are, in their order. recorded : whether the motion is not that of the drivers.

    Raises ModelError, by the first friction, where the actuators are not in the place of the drivers.
    """
    by_coordinate = {driver.coordinate: driver.name for driver in machine.drivers if driver.name not in actuation.hold}
    found = [by_coordinate.get(each.coordinate) for each in actuation.actuators]
    alike = None not in found and len(found) == len(by_coordinate)
    if alike and not recorded and not np.isfinite(actuation.limits).any():
        return tuple(str(name) for name in found)
    what = "limits" if alike and not recorded else "a recorded motion" if recorded else "actuators elsewhere"
    driven = ", ".join(str(name) for name in by_coordinate) or "nothing"
    name = next(force.name for force in machine.forces if isinstance(force, Friction) or holds_by_capacity(force))
    message = (
        f"friction is loaded by the reactions, which depend on the efforts that are sought: with {what} they are not found; let drivers or "
        f"a trajectory prescribe exactly the coordinates of the actuators, without limits (drivers prescribe {driven})"
    )
    raise ModelError(Fault.at(f"forces.{name}", message))


def driven_alone(machine: MachineRecord, actuation: Actuation) -> MachineRecord:
    """The machine without the motors that stand for actuators; its drivers do their work."""
    taken = {each.motor for each in actuation.actuators}
    return machine.replace(
        forces=tuple(force for force in machine.forces if force.name not in taken),
        sensors=tuple(each for each in machine.sensors if each.force not in taken),
    )


def efforts_of_drivers(actuation: Actuation, drivers: tuple[str, ...], motion: Result) -> Efforts:
    """The efforts of the drivers of a kinematic analysis as those of the actuators."""
    effort = np.column_stack([motion.array(f"driver.{name}.effort") for name in drivers])
    names = list(motion.coordinates["joint_coordinate_name"])
    places = [names.index(each.coordinate) for each in actuation.actuators]
    frames, count, trust = len(motion.time), len(drivers), motion.trust
    return Efforts(
        name=motion.name,
        time=motion.time,
        actuators=tuple(each.name for each in actuation.actuators),
        coordinates=tuple(each.coordinate for each in actuation.actuators),
        units=tuple(each.unit for each in actuation.actuators),
        effort=effort,
        rate=motion.array("joint_rate")[:, places],
        missing=np.zeros(frames),
        missing_share=np.zeros(frames),
        missing_at="",
        limits=actuation.limits,
        limited=False,
        violation=trust.constraint_violation_max / max(trust.size, 1e-300),
        freedoms=count,
        rank=count,
    )
