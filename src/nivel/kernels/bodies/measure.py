"""The hook of machines that measure coordinates: those that every evaluation needs, angles at accepted states, joint coordinates."""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.bodies.constraint import combine
from nivel.kernels.bodies.coordinate import ALONG
from nivel.kernels.bodies.coordinate import measure as measure_one
from nivel.kernels.bodies.driven_turn import TURN_X, driven_turn, note_motions
from nivel.kernels.bodies.patch_coordinate import KEPT, PATCH, PROPOSED, RESTING, RESTS
from nivel.kernels.bodies.rolling import CONTACT, rolling
from nivel.kernels.core.lanes import is_whole
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import ACCEPTED, ACTIVE, SHOWN, call_hook, family
from nivel.kernels.record.record import RAIL, record_at
from nivel.native.function import stage

# Combined coordinates: Σ factor coordinate of other coordinates, such as the slip of a clutch between two shafts.
#
# The parts of a combined coordinate are those of the coordinates that it is made of, one after the other, each of which has two parts or
# more: at the first of them `coordinates.station` is the factor, at the second the number of the coordinate. These are measured before, as
# they have lower numbers.

# kind of the coordinates
COMBINED = 21


@stage
def combined(coordinates, k):
    """(value, rate, bias) of coordinate k; its parts of C_q are filled."""
    part, last = np.int64(coordinates.start[k]), np.int64(coordinates.start[k + 1])
    first = np.int64(coordinates.station[part + 1])
    factor = coordinates.station[part]
    value, rate = factor * coordinates.value[first], factor * coordinates.rate[first]
    bias = factor * coordinates.bias[first]
    begin = part
    while part < last:
        factor, q = coordinates.station[part], np.int64(coordinates.station[part + 1])
        if part > begin:
            value += factor * coordinates.value[q]
            rate += factor * coordinates.rate[q]
            bias += factor * coordinates.bias[q]
        for source in range(np.int64(coordinates.start[q]), np.int64(coordinates.start[q + 1])):
            for i in range(6):
                coordinates.J[part, i] = factor * coordinates.J[source, i]
            part += 1
    return value, rate, bias


@family
def measure(machine, job, t):
    """ACTIVE: coordinates that constraints, forces or laws need, and the rows made of them, see `nivel.kernels.bodies.constraint.combine`.

    ACCEPTED: angles are followed from this state on, across ±π (a step turns them by less than half a turn), and sliders on beams from
    where they are; frictions remember whether they slide. Otherwise (SHOWN) value and rate of all joint coordinates.
    """
    record = record_at(machine)
    coordinates = record.coordinates
    listed = coordinates.active if job == ACTIVE else coordinates.followed
    count = coordinates.reference.shape[0] if job == SHOWN else listed.shape[0]
    for n in range(count):
        k = n if job == SHOWN else np.int64(listed[n])
        if coordinates.what[k, 0] == PATCH:
            continue  # what touches knows it, when forces act
        if coordinates.what[k, 0] == COMBINED:
            value, rate, bias = combined(coordinates, k)
            coordinates.value[k], coordinates.rate[k], coordinates.bias[k] = value, rate, bias
        elif coordinates.what[k, 0] >= TURN_X:
            value, rate, bias = driven_turn(machine, k, t)
            coordinates.value[k], coordinates.rate[k], coordinates.bias[k] = value, rate, bias
        elif coordinates.what[k, 0] >= CONTACT:
            value, rate, bias = rolling(record.bodies, record.markers, coordinates, k)
            if is_whole(machine) and coordinates.what[k, 0] != CONTACT:
                value *= 0.0
            coordinates.value[k], coordinates.rate[k], coordinates.bias[k] = value, rate, bias
        elif coordinates.what[k, 0] >= ALONG:
            status = call_hook(machine, RAIL, k, t)
            if status != OK:
                return status
        else:
            value, rate, bias = measure_one(record.bodies, record.markers, coordinates, k)
            coordinates.value[k], coordinates.rate[k], coordinates.bias[k] = value, rate, bias
        if job == ACCEPTED:
            coordinates.reference[k] = real(coordinates.value[k])
    if job == ACCEPTED:
        for k in range(record.friction.force.shape[0]):
            record.friction.work[KEPT, k] = record.friction.work[PROPOSED, k]
            record.friction.work[RESTS, k] = record.friction.work[RESTING, k]
    if job == ACTIVE:
        combine(machine, record.constraints, coordinates, record.friction, t)
        note_motions(machine)
    return OK
