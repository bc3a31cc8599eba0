"""Elements of beams without damping, whose derivatives are found by hand (`nivel.kernels.residual.beam_tangent`)."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.elements.beam_element import COUNT, FORCE, TORQUE, element_forces
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at


@family
def apply(machine, number, t):
    """All elements."""
    record = record_at(machine)
    elements, wrench = record.elements, record.beams.wrench
    first = elements.span[number, 0]
    for k in range(first, elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        element_forces(record.bodies, record.markers, index, n, record.control)
        if wrench.shape[0] > 0:
            kept = wrench[k - first]
            for a in range(index[COUNT]):
                for i in range(3):
                    kept[6 * a + i], kept[6 * a + 3 + i] = n[FORCE + 3 * a + i].real, n[TORQUE + 3 * a + i].real
    return OK
