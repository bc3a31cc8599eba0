"""Elements of beams whose derivatives are found on complex numbers: those with damping, and those with total interpolation."""

from __future__ import annotations

from nivel.kernels.beam_element import element_forces
from nivel.kernels.hook import family
from nivel.kernels.record import record_at
from nivel.kernels.status import OK


@family
def apply(machine, number, t):
    """All elements."""
    record = record_at(machine)
    elements = record.elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        element_forces(record.bodies, record.markers, elements.columns[k], elements.number[k], record.control)
    return OK
