"""Actuators of inverse dynamics in a machine, with limits and weights of their efforts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from nivel.elements.forces.actuators import Motor
from nivel.errors import Fault, refuse
from nivel.lazy import dataclass
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.inverse import InverseSettings
from nivel.machine.units.quantity import expression_fault, read_quantity, shown
from nivel.machine.units.tree import ExpressionError
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, UnknownCoordinateError, resolve, unknown_name
from nivel.system.system import Array


@dataclass(frozen=True)
class Actuator:
    """An effort on a joint coordinate. motor : force of the machine that it stands for, which then does not act itself; empty: none."""

    name: str
    coordinate: str
    motor: str
    unit: str


@dataclass(frozen=True)
class Actuation:
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
