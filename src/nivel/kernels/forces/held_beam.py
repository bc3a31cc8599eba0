"""Elements of beams while derivatives of everything else are found on dual numbers: they keep the wrenches on their nodes as last
evaluated, so that what is left to differentiate is how these act."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.elements.beam_element import COUNT, NODE, push_node
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at


@family
def apply(machine, number, t):
    """All elements with the wrenches that they had."""
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
