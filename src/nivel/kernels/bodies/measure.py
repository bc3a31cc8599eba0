"""The hook of machines that measure coordinates: those that every evaluation needs, angles at accepted states, joint coordinates."""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.bodies.combined import COMBINED, combined
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
