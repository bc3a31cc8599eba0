"""The hook of machines that measure coordinates: those that every evaluation needs, angles at accepted states, joint coordinates."""

from __future__ import annotations

from nivel.kernels.constraint import combine
from nivel.kernels.coordinate import LAST_ANGLE
from nivel.kernels.coordinate import measure as measure_one
from nivel.kernels.hook import ACCEPTED, ACTIVE, family
from nivel.kernels.record import record_at
from nivel.kernels.status import OK


@family
def measure(machine, job, t):
    """ACTIVE: coordinates that constraints, forces or laws need, and the rows made of them, see `nivel.kernels.constraint.combine`.

    ACCEPTED: angles are followed from this state on, across ±π (a step turns a joint by less than half a turn). Otherwise (SHOWN)
    value and rate of all joint coordinates.
    """
    record = record_at(machine)
    if job == ACTIVE:
        combine(record, t)
        return OK
    coordinates = record.coordinates
    for k in range(coordinates.reference.shape[0]):
        if job != ACCEPTED or coordinates.what[k, 0] <= LAST_ANGLE:
            value, rate, bias = measure_one(record.bodies, record.markers, coordinates, k)
            coordinates.value[k], coordinates.rate[k], coordinates.bias[k] = value, rate, bias
            if job == ACCEPTED:
                coordinates.reference[k] = value
    return OK
