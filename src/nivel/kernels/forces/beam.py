"""Elements of beams: those whose derivatives are found on dual numbers, with damping or total interpolation; those without damping, whose
derivatives are found by hand (`nivel.kernels.residual.beam_tangent`); and the latter while everything else is differentiated."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.elements.beam_element import COUNT, FORCE, NODE, TORQUE, element_forces, push_node
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


@family
def apply_elastic(machine, number, t):
    """All elements without damping; their wrenches are kept."""
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


@family
def hold(machine, number, t):
    """The same with the wrenches that they had as last evaluated, so that what is left to differentiate is how these act."""
    record = record_at(machine)
    elements, wrench = record.elements, record.beams.wrench
    first = elements.span[number, 0]
    for k in range(first, elements.span[number, 1]):
        index, kept = elements.columns[k], wrench[k - first]
        for a in range(index[COUNT]):
            push_node(
                record.bodies, record.markers, index[NODE + a], kept[6 * a : 6 * a + 3], kept[6 * a + 3 : 6 * a + 6]
            )
    return OK
