"""Elastic belts, chains and freewheels between two joint coordinates: two strands that never push, and a slip between given ends.

With the way e of one rim against the other, the slip x and z = e - x, y = k z + d ż, the strands pull with T₁ = max(0, T₀ + y) while they
are taut, T₀ + k z > 0, and T₂ = max(0, T₀ - y) while T₀ - k z > 0; the effort T₁ - T₂ is left. z and y/k stay between LOW and HIGH: at
an end the belt slips. x is that of the last accepted state, and z what is left of e - x between the ends (the return mapping of
plasticity: exact where e turns back at no time within a step; where steps are chosen one ends there). Of Euler and Eytelwein, T₁ = m T₂
with m = exp(μ φ), the end is k z = T₀ (m - 1)/(m + 1).
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import maximum, minimum, real
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

# columns of `columns`; outputs: effort, power, rate of the slip, slip; with TENSIONS 1 the effort that resists,
# and the tensions of both strands
OUTPUT, COORDINATE, TENSIONS = 0, 1, 2
# columns of `number`
STIFFNESS, DAMPING, PRETENSION, LOW, HIGH = 0, 1, 2, 3, 4
# Places in the memory: the slip, and what is watched where steps are chosen: whether the upper and the lower end is reached, and whether
# each strand pulls.
SLIP, AT_HIGH, AT_LOW, PULLS, PULLS_BACK = 0, 1, 2, 3, 4
KEPT = 5
# z within this share of an end is there, or nearer than this [m or rad]
AT_END, AT_ZERO = 1e-9, 1e-15


@leaf
def near(end):
    """How far from an end it counts as reached."""
    return AT_END * np.abs(end) + AT_ZERO


@leaf
def watch(elements, k, place, value):
    """Note that `value` is watched, and on which side it is."""
    elements.depth[k, place] = value
    elements.proposal[k, place] = 1.0 if real(value) > 0.0 else 0.0


@leaf
def tension(elastic, whole, remembered, held):
    """Tension of a strand, of its spring and `whole`: none where it is slack, and it never pushes. held : it pulls or not as in the last
    accepted state, so that steps can end where that changes."""
    if held:
        return whole if remembered > 0.0 else 0.0 * whole
    return maximum(whole, 0.0) if real(elastic) > 0.0 else 0.0 * whole


@family
def apply(machine, number, t):
    """Efforts, slips and their power."""
    record = record_at(machine)
    elements, coordinates, control, value = record.elements, record.coordinates, record.control, record.outputs.value
    followed = record.watched.followed[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        n, q, out = elements.number[k], elements.columns[k, COORDINATE], elements.columns[k, OUTPUT]
        way, rate = coordinates.value[q], coordinates.rate[q]
        stiffness, pretension = n[STIFFNESS], n[PRETENSION]
        strained = way - elements.memory[k, SLIP]
        z, stretching, slipping = strained, rate, 0.0 * rate
        lag = n[DAMPING] / stiffness * rate
        beyond, below = strained + lag - n[HIGH], n[LOW] - strained - lag
        # what has slipped stands at the end itself, where the rate says whether it goes on
        if n[HIGH] < np.inf and real(strained) > n[HIGH] - (near(n[HIGH]) if real(rate) > 0.0 else 0.0):
            z, stretching, slipping, beyond = n[HIGH] + 0.0 * rate, 0.0 * rate, rate, rate
        elif n[LOW] > -np.inf and real(strained) < n[LOW] + (near(n[LOW]) if real(rate) < 0.0 else 0.0):
            z, stretching, slipping, below = n[LOW] + 0.0 * rate, 0.0 * rate, rate, -rate
        elements.proposal[k, SLIP] = way - z
        watch(elements, k, AT_HIGH, beyond)
        watch(elements, k, AT_LOW, below)
        y = stiffness * z + n[DAMPING] * stretching
        y = minimum(maximum(y, stiffness * n[LOW]), stiffness * n[HIGH])
        first, second = maximum(pretension + stiffness * z, 0.0), maximum(pretension - stiffness * z, 0.0)
        held = followed == 1 and n[HIGH] == np.inf
        pull = tension(pretension + stiffness * z, pretension + y, elements.memory[k, PULLS], held)
        back = tension(pretension - stiffness * z, pretension - y, elements.memory[k, PULLS_BACK], held)
        watch(elements, k, PULLS, minimum(pretension + stiffness * z, pretension + y))
        watch(elements, k, PULLS_BACK, minimum(pretension - stiffness * z, pretension - y))
        effort = pull - back
        control.stored[0] += 0.5 * (first * first + second * second) / stiffness
        control.power[1] += effort * rate - (first - second) * stretching
        value[out] = effort if elements.columns[k, TENSIONS] == 1 else -effort
        value[out + 1] = add_coordinate_force(machine, q, -effort)
        value[out + 2], value[out + 3] = slipping, way - z
        if elements.columns[k, TENSIONS] == 1:
            value[out + 4], value[out + 5] = pull, back
    return OK
