"""Limit stops on a joint coordinate."""

from __future__ import annotations

from nivel.kernels.algebra.analytic import maximum
from nivel.kernels.core.status import OK
from nivel.kernels.forces.impact import impact
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`; outputs: effort on the coordinate, power, overlap
OUTPUT, COORDINATE = 0, 1
# columns of `number`; LOSS is x of `nivel.kernels.forces.impact`
LOWER, UPPER, STIFFNESS, EXPONENT, LOSS = 0, 1, 2, 3, 4


@family
def apply(machine, number, t):
    """Compliant surfaces at LOWER and UPPER, see `nivel.kernels.forces.impact`."""
    record = record_at(machine)
    elements, coordinates, control = record.elements, record.coordinates, record.control
    followed = record.watched.followed[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        n, memory, proposal, depth = elements.number[k], elements.memory[k], elements.proposal[k], elements.depth[k]
        q, out = elements.columns[k, COORDINATE], elements.columns[k, OUTPUT]
        c, rate = coordinates.value[q], coordinates.rate[q]
        depth[0], depth[1] = n[LOWER] - c, c - n[UPPER]
        if followed == 1:
            elements.depth_rate[k, 0], elements.depth_rate[k, 1] = -rate, rate
        up, stored, loss, proposal[0] = impact(depth[0], -rate, n[STIFFNESS], n[EXPONENT], n[LOSS], memory[0], followed)
        control.stored[0] += stored
        control.power[1] += loss
        down, stored, loss, proposal[1] = impact(
            depth[1], rate, n[STIFFNESS], n[EXPONENT], n[LOSS], memory[1], followed
        )
        control.stored[0] += stored
        control.power[1] += loss
        record.outputs.value[out] = up - down
        record.outputs.value[out + 1] = add_coordinate_force(machine, q, up - down)
        record.outputs.value[out + 2] = maximum(maximum(depth[0], depth[1]), 0.0)
    return OK
