"""Machines whose only stiffness is that of the modes of their flexible bodies: some methods need no tangents of these."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, sqrt
from typing import Final

import numpy as np

from nivel.integrate.catalogue import INTEGRATORS, step_for
from nivel.integrate.facts import IntegratorFacts
from nivel.known import Component, Contact, Hand, JointSpringDamper, PointForce, Torque
from nivel.lazy import nivel
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.bodies.shape import Box, Cylinder, Sphere
from nivel.machine.core.element import ForceElement
from nivel.machine.laws.functions import functions_in
from nivel.machine.laws.symbols import find_symbol
from nivel.machine.laws.time_function import signals_of
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import resolve

SOFT: Final = 0.2  # frequency, or rate of decay, times the step
CORNER: Final = 4.0  # mass of a solid over that which a corner of it feels
WAITING: Final = ("inputs",)  # signals that the motion does not change
IMPACT: Final = 3.0  # normal force over weight, of bodies set down


def is_soft(machine: MachineRecord, force: ForceElement) -> bool:
    """Whether no motion of a body that the force alone makes is quicker than some steps."""
    match force:
        case PointForce() | Torque() | Hand():
            return not _follows_motion(machine, force)
        case Contact() | JointSpringDamper():
            return _rate(machine, force) * machine.simulation.step <= SOFT
    return False


def _follows_motion(machine: MachineRecord, force: ForceElement) -> bool:
    """Whether a force given as functions may change with the motion within a step; what it follows then is not bounded."""
    paths = [path for _, function in functions_in(force) for path in function.signals]
    return any(find_symbol(path, machine).section not in WAITING for path in paths)


def _rate(machine: MachineRecord, force: Contact | JointSpringDamper) -> float:
    """Frequency or rate of decay, whichever is larger [1/s]; infinite where it does not follow from a few numbers."""
    if isinstance(force, Contact):
        return _rate_of_contact(machine, force)
    if force.table is not None or force.law is not None:
        return inf
    name, coordinate = resolve(force.coordinate, machine.joints)
    joint = next(each for each in machine.joints if each.name == name)
    bodies = [machine.body_named[each] for each in joint.bodies or () if each in machine.body_named]
    least = min((_inertia(body, is_angle="angle" in coordinate) for body in bodies), default=0.0)
    return max(sqrt((force.stiffness or 0.0) / least), force.damping / least) if least else inf


def _rate_of_contact(machine: MachineRecord, contact: Contact) -> float:
    body = machine.body_named.get(contact.body or "")
    if (
        body is None
        or not isinstance(body.shape, Sphere | Box | Cylinder)
        or contact.law is not None
        or contact.exponent != 1.0
        or not isinstance(contact.stiffness, int | float)
    ):
        return inf
    mass = _inertia(body, is_angle=False)
    if not mass:
        return inf
    transition = inf if contact.sticks else contact.friction_transition_speed or inf
    sliding = IMPACT * contact.friction * float(np.linalg.norm(machine.gravity)) / transition
    return max(sqrt(CORNER * contact.stiffness / mass), sliding)


def _inertia(body: Body, *, is_angle: bool) -> float:
    """Mass, or the least moment of inertia; 0 where a file has it."""
    if body.flexible is not None or body.point_mass:
        return 0.0
    properties = mass_properties(body)
    return float(np.linalg.eigvalsh(properties.inertia)[0]) if is_angle else properties.mass


MOVING = ("joints", "inputs", "markers", "bodies")  # what signals of the motion are read from


def only_circuits_are_stiff(machine: MachineRecord) -> bool:
    """Whether a machine has circuits with derivatives by hand, and besides them and weight no forces but soft ones and those given in
    time, no continuous states, and in circuits no commands that follow pressures at once."""
    return (
        bool(machine.hydraulics)
        and not machine.beams
        and all(is_soft(machine, each) for each in machine.forces)
        and all(state.update is not None for state in machine.states)
        and all(part.role != "state" for block in machine.control for part in block.parts)
        and nivel.system.circuit_elements.has_slopes(machine)
        and all(_waits(machine, path) for component in machine.hydraulics for path in _signals(component))
    )


def _signals(component: Component) -> Iterator[str]:
    """The paths of what a component follows."""
    for key in component.functions:
        yield from signals_of(getattr(component, key) or 0.0)


def _waits(machine: MachineRecord, path: str) -> bool:
    """Whether a signal follows the time, samples or the motion: what acts on a circuit is not back within a step."""
    blocks, open_paths = {block.name: block for block in machine.control}, [path]
    while open_paths:
        symbol = find_symbol(open_paths.pop(), machine)
        if symbol.section != "control" and symbol.section not in (*MOVING, "states"):
            return False
        # blocks may follow each other, and their own parts: each is looked at once
        if symbol.section == "control" and (block := blocks.pop(symbol.name, None)) is not None:
            present = [part.function for part in block.parts if part.role == "signal"]
            varying = [function for function in present if not isinstance(function, float | int)]
            open_paths += [each for function in varying for each in function.signals]
    return True


def only_modes_are_stiff(machine: MachineRecord) -> bool:
    """Whether a machine has flexible bodies, and besides weight no forces but those that are given in time."""
    return (
        machine.is_flexible
        and not machine.beams
        and all(isinstance(each, PointForce | Torque) for each in machine.forces)
    )


def integrator_of(machine: MachineRecord, coordinates: str) -> IntegratorFacts:
    """The integrator of a run of `machine` in these coordinates."""
    name = machine.simulation.integrator
    by_circuits = step_for(name, "flexible circuits" if machine.is_flexible else "circuits")
    if by_circuits and goes_by_circuits(machine, coordinates):
        return by_circuits
    by_modes = step_for(name, "modes")
    return by_modes if by_modes and coordinates == "relative" and only_modes_are_stiff(machine) else INTEGRATORS[name]


def goes_by_circuits(machine: MachineRecord, coordinates: str) -> bool:
    """Whether a machine is one for integrators that take derivatives of circuits by hand."""
    formulation = machine.simulation.formulation
    return coordinates == "relative" and formulation == "newton-euler" and only_circuits_are_stiff(machine)
