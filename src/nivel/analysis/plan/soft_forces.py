"""Forces that are soft beside a step, so that a method follows them without their derivatives."""

from __future__ import annotations

from math import inf, sqrt
from typing import Final

import numpy as np

from nivel.elements.forces.hand import Hand
from nivel.elements.forces.loads import PointForce, Torque
from nivel.elements.forces.springs import JointSpringDamper
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.bodies.shape import Box, Cylinder, Sphere
from nivel.machine.core.element import ForceElement
from nivel.machine.forces.contact import Contact
from nivel.machine.laws.functions import functions_in
from nivel.machine.laws.symbols import find_symbol
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
