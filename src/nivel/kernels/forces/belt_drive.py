"""Elastic belts, chains and freewheels between two joint coordinates: two strands that never push, and a slip between given ends.

With the way e of one rim against the other, the slip x and z = e - x, the strands pull with T₁ = max(0, T₀ + k z) and
T₂ = max(0, T₀ - k z), of which the effort T₁ - T₂ is left. z stays between LOW and HIGH: at an end the belt slips, ẋ = ė, and what a step
went beyond it is given up within RETURN. Of Euler and Eytelwein, T₁ = m T₂ with m = exp(μ φ), the end is k z = T₀ (m - 1)/(m + 1).
"""

from __future__ import annotations

from nivel.kernels.algebra.analytic import maximum, minimum, real
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`; outputs: effort that resists, power, rate of the slip, slip; with TENSIONS 1 those of both strands
OUTPUT, COORDINATE, SLIP, TENSIONS = 0, 1, 2, 3
# columns of `number`
STIFFNESS, DAMPING, PRETENSION, LOW, HIGH = 0, 1, 2, 3, 4
# [s]
RETURN = 2e-3


@family
def apply(machine, number, t):
    """Efforts, slips and their power."""
    record = record_at(machine)
    elements, coordinates, control, value = record.elements, record.coordinates, record.control, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        n, q, out, x = elements.number[k], elements.columns[k, COORDINATE], elements.columns[k, OUTPUT], elements.columns[k, SLIP]
        rate, slip = coordinates.rate[q], elements.state[x]
        z = coordinates.value[q] - slip
        slipping = 0.0 * z
        if real(z) >= n[HIGH]:
            slipping = maximum(rate, 0.0 * z) + (z - n[HIGH]) / RETURN
        elif real(z) <= n[LOW]:
            slipping = minimum(rate, 0.0 * z) + (z - n[LOW]) / RETURN
        elements.state_rate[x] += slipping
        stretching = rate - slipping
        first, second = n[PRETENSION] + n[STIFFNESS] * z, n[PRETENSION] - n[STIFFNESS] * z
        first, second = maximum(first, 0.0 * z), maximum(second, 0.0 * z)
        elastic = first - second
        damped = n[DAMPING] * stretching
        # a strand that is slack has no damping, and none pushes
        pull, back = first, second
        if real(first) > 0.0:
            pull = maximum(first + damped, 0.0 * z)
        if real(second) > 0.0:
            back = maximum(second - damped, 0.0 * z)
        effort = pull - back
        if n[STIFFNESS] > 0.0:
            control.stored[0] += 0.5 * (first * first + second * second) / n[STIFFNESS]
        control.power[1] += effort * rate - elastic * stretching
        value[out] = effort
        value[out + 1] = add_coordinate_force(machine, q, -effort)
        value[out + 2], value[out + 3] = slipping, slip
        if elements.columns[k, TENSIONS] == 1:
            value[out + 4], value[out + 5] = pull, back
    return OK
