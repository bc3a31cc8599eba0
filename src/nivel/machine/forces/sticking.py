"""Forces that can hold bodies at rest by friction."""

from __future__ import annotations

from nivel.elements.forces.drive_lines import Brake, Clutch, Freewheel, TransmissionLoss
from nivel.elements.forces.friction import Friction
from nivel.machine.core.element import ForceElement
from nivel.machine.forces.contact import Contact


def is_sticking(force: ForceElement) -> bool:
    """Whether friction of the force can hold bodies at rest: its efforts are unknowns of the equations of motion."""
    return (
        (isinstance(force, Friction) and force.model == "stiction")
        or (isinstance(force, Contact) and force.sticks)
        or holds_by_capacity(force)
    )


def holds_by_capacity(force: ForceElement) -> bool:
    """Whether it is an element of a drive train that can hold coordinates at rest: a brake, a clutch, a rigid freewheel, a loss."""
    return isinstance(force, Brake | Clutch | TransmissionLoss) or (isinstance(force, Freewheel) and force.is_rigid)
