"""Motors on a joint coordinate: a given effort, or a speed to be held, both within a limit."""

from __future__ import annotations

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`; outputs: effort on the coordinate, power, coordinate, rate
OUTPUT, COORDINATE, COMMAND = 0, 1, 2
# columns of `number`; a gain of zero means that the command is the effort
GAIN, LIMIT = 0, 1


@family
def apply(machine, number, t):
    """Effort command, or gain (command - rate), cut off at ± limit."""
    record = record_at(machine)
    elements, coordinates = record.elements, record.coordinates
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        q, out = elements.columns[k, COORDINATE], elements.columns[k, OUTPUT]
        gain, limit = elements.number[k, GAIN], elements.number[k, LIMIT]
        effort = evaluate_function(machine, elements.columns[k, COMMAND], t)
        if real(gain) > 0.0:
            effort = gain * (effort - coordinates.rate[q])
        # not min and max: these would hide an effort that is not a number
        if real(effort) > real(limit):
            effort = limit
        elif real(effort) < -real(limit):
            effort = -limit
        record.outputs.value[out] = effort
        power = add_coordinate_force(machine, q, effort)
        record.outputs.value[out + 1] = power
        record.outputs.value[out + 2], record.outputs.value[out + 3] = coordinates.value[q], coordinates.rate[q]
        record.control.power[0] += power
    return OK
