"""Coordinates without stiffness, named free: an equilibrium leaves them where they are placed, and no force may act on them."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from nivel.analysis.plan.choice import choose_coordinates
from nivel.analysis.plan.plan import Methods, methods_of, with_smooth_contacts
from nivel.elements.joints.drivers import Driver
from nivel.errors import Fault, SolveError, retold
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import StaticsSettings
from nivel.machine.settings.values import settings_of, static_coordinates
from nivel.machine.uses.coordinate_reference import resolve
from nivel.results.result import Result
from nivel.system.system import Array

# Accelerations and efforts below this share of the largest loads are round-off of the search.
ROUND_OFF = 1e-6


def holding_free(machine: MachineRecord) -> MachineRecord:
    """The machine with a driver that holds each free coordinate where it is placed."""
    drivers = []
    for reference in machine.simulation.free:
        joint, coordinate = resolve(reference, machine.joints)
        name = _name(joint, coordinate)
        drivers.append(Driver(name=name, coordinate=f"{joint}.{coordinate}", value=0.0, from_start=True))
    simulation = machine.simulation.replace(free=())
    return machine.replace(drivers=(*machine.drivers, *drivers), simulation=simulation) if drivers else machine


def _name(joint: str, coordinate: str) -> str:
    return f"free_{joint}_{coordinate}"


def refuse_moving(machine: MachineRecord, accelerations: Array, size: float) -> None:
    """Refuse a start at rest from which a free coordinate moves off. accelerations (B, 6) of (Ṙ, ω̄) at rest.

    Raises SolveError.
    """
    if not machine.simulation.free:
        return
    g = float(np.linalg.norm(machine.gravity)) or 1.0
    if np.abs(accelerations[:, :3]).max() > ROUND_OFF * g or np.abs(accelerations[:, 3:]).max() * size > ROUND_OFF * g:
        raise SolveError(_not_free(machine, "the machine does not stay there"), time=0.0, advice=ADVICE)


def loaded_free(machine: MachineRecord, result: Result, size: float) -> tuple[str, str] | None:
    """(message, advice) where in a state found a force acts on a free coordinate: it is no equilibrium then."""
    if not machine.simulation.free or not len(result.time):
        return None
    forces = np.abs(result.array("joint_force")).max() if "joint_force" in result.variables else 0.0
    least = ROUND_OFF * max(float(forces), 1e-12) * max(size, 1.0)
    for reference in machine.simulation.free:
        joint, coordinate = resolve(reference, machine.joints)
        effort = np.abs(result.array(f"driver.{_name(joint, coordinate)}.effort"))
        if effort.max() > least:
            units = "N m" if coordinate.startswith("angle") else "N"
            return _not_free(machine, f"{effort.max():.4g} {units} act on {joint}.{coordinate}"), ADVICE
    return None


ADVICE = "Take it out of `simulation: {free: …}`, or hold it by a spring or a driver."


def _not_free(machine: MachineRecord, why: str) -> str:
    named = ", ".join(machine.simulation.free)
    return f"this is no equilibrium: {why} with {named} where the file places it"


def for_statics(machine: MachineRecord, settings: StaticsSettings) -> tuple[MachineRecord, str]:
    """The machine with simulation settings that mean nothing but the equations of statics, and the coordinates."""
    duration = settings.duration or 1.0
    simulation = machine.simulation.replace(
        integrator="generalised-alpha",
        formulation="newton-euler",
        coordinates=settings.coordinates,
        stabilisation="direct",
        rotations="euler-parameters",
        baumgarte=None,
        independent=(),
        start="as-given",
        duration=duration,
        step=min(settings.interval, duration),
        output_interval=None,
        step_control="own",
    )
    neutral = holding_free(with_smooth_contacts(machine).with_simulation(simulation))
    coordinates = choose_coordinates(neutral)
    return neutral.with_simulation(neutral.simulation.replace(coordinates=coordinates)), coordinates


def planned(
    record: MachineRecord, given: Mapping[str, Any], placed: Callable[[Fault], Fault]
) -> tuple[StaticsSettings, Methods]:
    """Settings of statics for a machine, and its methods. placed : gives faults of the machine their places. Raises ModelError."""
    own = {"duration": record.simulation.duration, "coordinates": static_coordinates(record.simulation.coordinates)}
    asked = settings_of(StaticsSettings, "statics", own | dict(given))
    neutral, chosen = for_statics(record, asked)
    with retold(placed):
        return asked, methods_of(neutral, "newton-euler", chosen)
