"""Forces that can hold bodies at rest by friction."""

from __future__ import annotations

from nivel.machine.forces.contact import Contact
from nivel.machine.forces.element import ForceElement
from nivel.machine.forces.friction import Friction


def is_sticking(force: ForceElement) -> bool:
    """Whether friction of the force can hold bodies at rest: its efforts are unknowns of the equations of motion."""
    return (isinstance(force, Friction) and force.model == "stiction") or (isinstance(force, Contact) and force.sticks)
