"""Actuators of inverse dynamics in a machine, with limits and weights of their efforts.

Inverse dynamics of machines with friction: where the actuators act on what drivers prescribe, their efforts are those of the drivers.
Friction is loaded by reactions, which depend on the efforts that are sought. The kinematic analysis finds both together; the effort of a
driver on a joint coordinate is then that of an actuator in its place.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from nivel.elements.forces.actuators import Motor
from nivel.elements.forces.drive_lines import holds_by_capacity
from nivel.elements.forces.friction import Friction
from nivel.errors import Fault, ModelError, refuse
from nivel.lazy import Struct
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import InverseSettings
from nivel.machine.units.quantity import expression_fault, read_quantity, shown
from nivel.machine.units.tree import ExpressionError
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, UnknownCoordinateError, resolve, unknown_name
from nivel.results.analyses.efforts import Efforts
from nivel.results.result import Result
from nivel.system.system import Array


class Actuator(Struct):
    """An effort on a joint coordinate. motor : force of the machine that it stands for, which then does not act itself; empty: none."""

    name: str
    coordinate: str
    motor: str
    unit: str


class Actuation(Struct):
    """actuators; weights (m,) : of their efforts in the norm that is made least; limits (m,) : greatest magnitudes, infinite for none.
    hold : drivers that go on holding what they prescribe, with efforts of their own."""

    actuators: tuple[Actuator, ...]
    weights: Array
    limits: Array
    hold: tuple[str, ...]


def actuation(machine: MachineRecord, settings: InverseSettings) -> Actuation:
    """What settings ask for. Raises ModelError with everything that is wrong."""
    faults: list[Fault] = []
    names, hold = settings.actuators, settings.hold
    drivers = {driver.name: driver for driver in machine.drivers}
    faults += [_fault("hold", unknown_name("driver", name, list(drivers))) for name in hold if name not in drivers]
    motors = {force.name: force for force in machine.forces if isinstance(force, Motor)}
    if names is None:
        free = [driver.coordinate for driver in machine.drivers if driver.name not in hold and driver.coordinate]
        names = tuple(motors) or tuple(free)
    actuators = [each for each in (_actuator(machine, motors, name, faults) for name in names) if each is not None]
    if not names and not faults:
        faults.append(
            _fault(
                "actuators",
                "the machine has no motors and no drivers of joint coordinates: name joint coordinates that act, as in "
                "`--actuators hinge.angle`; efforts of drivers of markers are in the result of `kinematics`",
            )
        )
    limits, weights = (_numbers(field, getattr(settings, field), actuators, faults) for field in ("limits", "weights"))
    bounds = np.array([_limit(each, motors, limits) for each in actuators])
    default = np.where(np.isfinite(bounds), 1.0 / bounds, 1.0)
    chosen = np.array([weights.get(each.name, weight) for each, weight in zip(actuators, default, strict=True)])
    refuse(faults)
    return Actuation(tuple(actuators), chosen, bounds, hold)


def _actuator(machine: MachineRecord, motors: Mapping[str, Motor], name: str, faults: list[Fault]) -> Actuator | None:
    motor = motors.get(name)
    try:
        joint, coordinate = resolve(motor.coordinate if motor else name, machine.joints)
    except UnknownCoordinateError as error:
        known = f"; motors are {', '.join(motors)}" if motors else ""
        faults.append(_fault("actuators", f"{error}{known}"))
        return None
    unit = "N m" if COORDINATE_KINDS[coordinate] == "angle" else "N"
    return Actuator(name if motor else f"{joint}.{coordinate}", f"{joint}.{coordinate}", name if motor else "", unit)


def _limit(actuator: Actuator, motors: Mapping[str, Motor], given: Mapping[str, float]) -> float:
    if actuator.name in given:
        return given[actuator.name]
    motor = motors.get(actuator.motor)
    return motor.limit if motor is not None and motor.limit is not None else np.inf


def _numbers(
    field: str, wanted: Mapping[str, Any], actuators: Sequence[Actuator], faults: list[Fault]
) -> dict[str, float]:
    """Numbers by name of actuators, all greater than zero."""
    out: dict[str, float] = {}
    known = {each.coordinate.partition(".")[0]: each for each in actuators}
    known |= {each.coordinate: each for each in actuators} | {each.name: each for each in actuators}
    for name, value in wanted.items():
        each = known.get(name)
        if each is None:
            faults.append(_fault(field, unknown_name("actuator", name, list(known))))
            continue
        kind = {"N m": "torque", "N": "force"}[each.unit] if field == "limits" else "number"
        try:
            number = float(value) if kind == "number" else read_quantity(value, kind, {})
        except ExpressionError as problem:
            faults.append(_fault(field, expression_fault(problem, value).message()))
            continue
        except ValueError:
            faults.append(_fault(field, f"a number was expected, got {shown(value)}"))
            continue
        if not number > 0.0:
            faults.append(_fault(field, f"a number greater than zero was expected for {name}, got {shown(value)}"))
        out[each.name] = number
    return out


def _fault(field: str, message: str) -> Fault:
    return Fault.at(f"inverse.{field}", message)


def rubs(machine: MachineRecord) -> bool:
    """Whether the machine has friction."""
    return any(isinstance(force, Friction) or holds_by_capacity(force) for force in machine.forces)


def drivers_replaced(machine: MachineRecord, actuation: Actuation) -> tuple[str, ...]:
    """The drivers of the coordinates of the actuators, in their order; none where these are not all that are driven."""
    driven = {driver.coordinate: driver.name for driver in machine.drivers if driver.name not in actuation.hold}
    found = [driven[each.coordinate] for each in actuation.actuators if each.coordinate in driven]
    return tuple(found) if len(found) == len(actuation.actuators) == len(driven) else ()


def acting_drivers(machine: MachineRecord, actuation: Actuation, *, recorded: bool) -> tuple[str, ...]:
    """The drivers in whose place the actuators are, in their order. recorded : whether the motion is not that of the drivers.

    Raises ModelError, by the first friction, where the actuators are not in the place of the drivers.
    """
    found = drivers_replaced(machine, actuation)
    if found and not recorded and not np.isfinite(actuation.limits).any():
        return found
    what = "limits" if found and not recorded else "a recorded motion" if recorded else "actuators elsewhere"
    driven = (
        ", ".join(each.coordinate or "" for each in machine.drivers if each.name not in actuation.hold) or "nothing"
    )
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
