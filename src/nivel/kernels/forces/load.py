"""Point forces and torques on one body, and vector forces between two."""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_marker_force, add_torque
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at

# columns of `columns`; outputs: magnitude, power, and between two bodies LENGTH and its rate
OUTPUT, KIND, MARKER, AXES, X, Y, Z, COUNTER, LENGTH = 0, 1, 2, 3, 4, 5, 6, 7, 8
FORCE, TORQUE = 0, 1


@family
def apply(machine, number, t):
    """A vector of three functions in global axes (AXES = NONE) or in those of marker AXES, on the body of MARKER.

    COUNTER : marker that gets the opposite force, or NONE. LENGTH : coordinate that is reported with it.
    """
    record = record_at(machine)
    bodies, markers, elements = record.bodies, record.markers, record.elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        marker, axes = index[MARKER], index[AXES]
        x = evaluate_function(machine, index[X], t)
        y = evaluate_function(machine, index[Y], t)
        z = evaluate_function(machine, index[Z], t)
        out = index[OUTPUT]
        record.outputs.value[out] = np.sqrt(x * x + y * y + z * z)
        if axes != NONE:
            A = markers.A[axes]
            x, y, z = (
                A[0, 0] * x + A[0, 1] * y + A[0, 2] * z,
                A[1, 0] * x + A[1, 1] * y + A[1, 2] * z,
                A[2, 0] * x + A[2, 1] * y + A[2, 2] * z,
            )
        body = markers.body[marker]
        forced = index[KIND] == FORCE
        power = add_marker_force(bodies, markers, marker, x, y, z) if forced else add_torque(bodies, body, x, y, z)
        if index[COUNTER] != NONE:
            power += add_marker_force(bodies, markers, index[COUNTER], -x, -y, -z)
            record.outputs.value[out + 2] = record.coordinates.value[index[LENGTH]]
            record.outputs.value[out + 3] = record.coordinates.rate[index[LENGTH]]
        record.outputs.value[out + 1] = power
        record.control.power[0] += power
    return OK
