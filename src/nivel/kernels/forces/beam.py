"""Elements of beams whose derivatives are found on dual numbers: those with damping, and those with total interpolation."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.elements.beam_element import element_forces
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at


@family
def apply(machine, number, t):
    """All elements."""
    record = record_at(machine)
    elements = record.elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        element_forces(record.bodies, record.markers, elements.columns[k], elements.number[k], record.control)
    return OK
