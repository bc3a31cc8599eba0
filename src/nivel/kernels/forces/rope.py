"""Ropes over pulleys: one tension along distances from marker to marker, never a push."""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at

# columns of `columns`; FIRST: the first of COUNT distances; outputs: tension, power, stretch
OUTPUT, LENGTH, SPEED, COUNT, FIRST = 0, 1, 2, 3, 4
# columns of `number`
STIFFNESS, DAMPING, UNSTRESSED = 0, 1, 2


@family
def apply(machine, number, t):
    """Tension T = k x + d ẋ of the stretch x = s - l, zero where x < 0 or T < 0; s = Σ distances, l̇ = the speed of the winch.

    Where steps are chosen one ends where x passes zero. The rope stores ½ k x², the winch works by -T l̇, and (T - k x) ẋ is dissipated,
    also where the rope goes slack.
    """
    record = record_at(machine)
    elements, coordinates, control, out = record.elements, record.coordinates, record.control, record.outputs.value
    followed = record.watched.followed[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, numbers = elements.columns[k], elements.number[k]
        length, speed = (
            0.0 * coordinates.value[index[FIRST]] + numbers[UNSTRESSED],
            0.0 * coordinates.rate[index[FIRST]],
        )
        if index[LENGTH] != NONE:
            length = elements.state[index[LENGTH]]
            speed = speed + evaluate_function(machine, index[SPEED], t)
            elements.state_rate[index[LENGTH]] += speed
        stretch, rate = -length, -speed
        for j in range(np.int64(index[COUNT])):
            q = index[FIRST + j]
            stretch += coordinates.value[q]
            rate += coordinates.rate[q]
        elements.depth[k, 0] = stretch
        if followed == 1:
            elements.depth_rate[k, 0] = rate
        elastic = 0.0 * stretch
        if real(stretch) > 0.0:
            elastic = numbers[STIFFNESS] * stretch
        tension = 0.0 * stretch
        if real(stretch) > 0.0 and real(elastic + numbers[DAMPING] * rate) > 0.0:
            tension = elastic + numbers[DAMPING] * rate
        control.stored[0] += 0.5 * elastic * stretch
        control.power[0] -= tension * speed
        control.power[1] += (tension - elastic) * rate
        power = 0.0 * stretch
        for j in range(np.int64(index[COUNT])):
            power += add_coordinate_force(machine, index[FIRST + j], -tension)
        first = index[OUTPUT]
        out[first], out[first + 1], out[first + 2] = tension, power, stretch
    return OK
