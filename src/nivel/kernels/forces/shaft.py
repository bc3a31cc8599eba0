"""Elastic shafts between two joint coordinates: a spring and a damper on their difference, with play between two flanks."""

from __future__ import annotations

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

# columns of `columns`; outputs: effort that resists, power, twist, its rate
OUTPUT, COORDINATE = 0, 1
# columns of `number`; FREE: value of the coordinate in the middle of the play, PLAY: half of it
STIFFNESS, DAMPING, FREE, PLAY = 0, 1, 2, 3


@leaf
def flank(depth, rate, stiffness, damping, remembered, followed):
    """(force, elastic force, 1 where it is remembered that the flank touches) at overlap `depth` and its `rate`; it never pulls.

    followed : the flank touches or is apart as in the last accepted state, see `nivel.kernels.forces.impact`.
    """
    nothing = 0.0 * depth
    if real(depth) <= 0.0 and not (followed == 1 and remembered > 0.0):
        return nothing, nothing, 0.0
    kept = 1.0 if real(depth) > 0.0 else 0.0
    if followed == 1 and remembered == 0.0:
        return nothing, nothing, kept
    elastic = stiffness * depth
    force = elastic + damping * rate
    if real(depth) > 0.0 and real(force) < 0.0:
        force = nothing
    return force, elastic, kept


@family
def apply(machine, number, t):
    """Effort against the twist: k c + d ċ without play, that of the flanks with it."""
    record = record_at(machine)
    elements, coordinates, control = record.elements, record.coordinates, record.control
    followed = record.watched.followed[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        n, q, out = elements.number[k], elements.columns[k, COORDINATE], elements.columns[k, OUTPUT]
        twist, rate = coordinates.value[q] - n[FREE], coordinates.rate[q]
        if n[PLAY] == 0.0:
            elastic = n[STIFFNESS] * twist
            effort = elastic + n[DAMPING] * rate
            control.stored[0] += 0.5 * elastic * twist
        else:
            memory, proposal, depth = elements.memory[k], elements.proposal[k], elements.depth[k]
            depth[0], depth[1] = -n[PLAY] - twist, twist - n[PLAY]
            if followed == 1:
                elements.depth_rate[k, 0], elements.depth_rate[k, 1] = -rate, rate
            down, low, proposal[0] = flank(depth[0], -rate, n[STIFFNESS], n[DAMPING], memory[0], followed)
            up, high, proposal[1] = flank(depth[1], rate, n[STIFFNESS], n[DAMPING], memory[1], followed)
            effort, elastic = up - down, high - low
            control.stored[0] += 0.5 * (low * depth[0] + high * depth[1])
        control.power[1] += (effort - elastic) * rate
        record.outputs.value[out] = effort
        record.outputs.value[out + 1] = add_coordinate_force(machine, q, -effort)
        record.outputs.value[out + 2], record.outputs.value[out + 3] = twist, rate
    return OK
