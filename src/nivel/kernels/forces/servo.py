"""Position servos on a joint coordinate: proportional, derivative and integral of the error, within a limit."""

from __future__ import annotations

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import evaluate_function, evaluate_motion
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at

# columns of `columns`; outputs: effort on the coordinate, power, coordinate, rate, error. STATE is NONE where nothing is integrated
OUTPUT, COORDINATE, TARGET, STATE = 0, 1, 2, 3
# columns of `number`; MOTION: whether the rate of the target is known
STIFFNESS, DAMPING, INTEGRAL, LIMIT, MOTION = 0, 1, 2, 3, 4


@family
def apply(machine, number, t):
    """Effort of all servos. At the limit the error is integrated only where that leads back (conditional integration)."""
    record = record_at(machine)
    elements, coordinates, out = record.elements, record.coordinates, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        q, x, first = index[COORDINATE], index[STATE], index[OUTPUT]
        rate = 0.0 * coordinates.rate[q]
        if real(n[MOTION]) > 0.0:
            target, rate, _ = evaluate_motion(machine, index[TARGET], t)
        else:
            target = evaluate_function(machine, index[TARGET], t)
        error = target - coordinates.value[q]
        effort = n[STIFFNESS] * error + n[DAMPING] * (rate - coordinates.rate[q])
        if x != NONE:
            effort = effort + n[INTEGRAL] * elements.state[x]
        wanted, limit = real(effort), real(n[LIMIT])
        if wanted > limit:
            effort = n[LIMIT]
        elif wanted < -limit:
            effort = -n[LIMIT]
        if x != NONE and not ((wanted > limit and real(error) > 0.0) or (wanted < -limit and real(error) < 0.0)):
            elements.state_rate[x] += error
        power = add_coordinate_force(machine, q, effort)
        out[first], out[first + 1] = effort, power
        out[first + 2], out[first + 3], out[first + 4] = coordinates.value[q], coordinates.rate[q], error
        record.control.power[0] += power
    return OK
