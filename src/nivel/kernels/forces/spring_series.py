"""Springs and dampers in series without mass between them: one tension T in all parts, whose lengths add up.

A part with a damper has its length x_i as a state, c_i ẋ_i = T - k_i (x_i - f_i); one without has the length f_i + T/k_i. With L, the
distance of the ends, and sums over the parts without dampers (e) and with dampers (d),

    T = (L - Σ_d x_i - Σ_e f_i) / Σ_e 1/k_i

and where all parts have dampers, the last one has the length that is left, and T = (L̇ + Σ k_i (x_i - f_i)/c_i) / Σ 1/c_i. A spring and a
damper are Maxwell's element (1867).
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# columns of `columns`: STATES: of the first part, or NONE; outputs: tension, power, length, rate, lengths of the parts
OUTPUT, COORDINATE, COUNT, STATES = 0, 1, 2, 3
# columns of `number`; then PART for each part
ONLY_PULLS, PARTS = 0, 1
STIFFNESS, DAMPING, FREE = 0, 1, 2
PART = 3


@stage
def tension_of(machine, k, length, rate):
    """Tension of element k; the length of its last part, where all have dampers, else 0."""
    record = record_at(machine)
    index, numbers, states = record.elements.columns[k], record.elements.number[k], record.elements.state
    left, given, soft, loose = 1.0 * length, 1.0 * rate, 0.0 * length, 0.0 * length
    count = np.int64(index[COUNT])
    for i in range(count):
        own = numbers[PARTS + PART * i : PARTS + PART * (i + 1)]
        if real(own[DAMPING]) == 0.0:
            left -= own[FREE]
            soft += 1.0 / own[STIFFNESS]
        else:
            loose += 1.0 / own[DAMPING]
            if index[STATES + i] != NONE:
                x = states[index[STATES + i]]
                left -= x
                given += own[STIFFNESS] * (x - own[FREE]) / own[DAMPING]
    if real(soft) > 0.0:
        tension = left / soft
        if real(numbers[ONLY_PULLS]) > 0.0 and real(tension) < 0.0:
            tension = 0.0 * tension
        return tension, 0.0 * left
    last = numbers[PARTS + PART * (count - 1) : PARTS + PART * count]
    given += last[STIFFNESS] * (left - last[FREE]) / last[DAMPING]
    return given / loose, left


@family
def apply(machine, number, t):
    """Tension, energies, and rates of the lengths of parts with dampers."""
    record = record_at(machine)
    elements, coordinates, control, out = record.elements, record.coordinates, record.control, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, numbers = elements.columns[k], elements.number[k]
        q, first = index[COORDINATE], index[OUTPUT]
        length, rate = coordinates.value[q], coordinates.rate[q]
        tension, last = tension_of(machine, k, length, rate)
        for i in range(np.int64(index[COUNT])):
            own = numbers[PARTS + PART * i : PARTS + PART * (i + 1)]
            if real(own[DAMPING]) == 0.0:
                stretch = tension / own[STIFFNESS]
            else:
                x = last
                if index[STATES + i] != NONE:
                    x = elements.state[index[STATES + i]]
                stretch = x - own[FREE]
                speed = (tension - own[STIFFNESS] * stretch) / own[DAMPING]
                if index[STATES + i] != NONE:
                    elements.state_rate[index[STATES + i]] += speed
                control.power[1] += own[DAMPING] * speed * speed
            control.stored[0] += 0.5 * own[STIFFNESS] * stretch * stretch
            out[first + 4 + i] = own[FREE] + stretch
        out[first], out[first + 1] = tension, add_coordinate_force(machine, q, -tension)
        out[first + 2], out[first + 3] = length, rate
    return OK
