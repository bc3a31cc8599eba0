"""Flows through restrictions: orifices, edges of valves, leaks.

    Q = K x Δp (Δp² + c²)^(-1/4) + G Δp        ṁ = ½ (ρ_a + ρ_b) Q

x is an opening from 0 to 1. Edges of spools open as R(z)/R(z at a full stroke), z = factor u + shift, R a ramp: exactly closed within
their overlap.
"""

from __future__ import annotations

from nivel.kernels.analytic import real
from nivel.kernels.function import evaluate_function
from nivel.kernels.hook import family
from nivel.kernels.hydraulics.smooth import magnitude_within, ramp, root_flow, step
from nivel.kernels.hydraulics.spool import clipped
from nivel.kernels.hydraulics.transfer import lose, transfer
from nivel.kernels.record import record_at
from nivel.kernels.status import OK
from nivel.native.function import stage

# columns of `columns`; POSITION: output of the valve, or a function. Output: flow [m³/s]
OUTPUT, FROM, TO, KIND, POSITION = 0, 1, 2, 3, 4
# kinds of openings: one; a function; the position of a valve; that of an edge; of an edge that is open about the middle; of a cushion
FIXED, GIVEN, DIRECT, EDGE, MIDDLE, CUSHION = 0, 1, 2, 3, 4, 5
# columns of `number`: K [m³/s/√Pa], corner c [Pa], leak G [m³/s/Pa]; of edges the factor and shift of z, the width of the ramp, 1 over its
# greatest value; of cushions the place of the end, 1 or -1 where the piston comes from below or above, their length, the least opening
FLOW, CORNER, LEAK, FACTOR, SHIFT, WIDTH, SCALE, LEAST = 0, 1, 2, 3, 4, 5, 6, 7


@stage
def opening_of(machine, index, n, t):
    """The opening of a restriction."""
    value = record_at(machine).outputs.value
    kind = index[KIND]
    if kind == GIVEN:
        return clipped(evaluate_function(machine, index[POSITION], t), 0.0)
    if kind == DIRECT:
        return clipped(value[index[POSITION]], 0.0)
    if kind == EDGE:
        u = clipped(value[index[POSITION]], -1.0)
        return ramp(n[FACTOR] * u + n[SHIFT], n[WIDTH]) * n[SCALE]
    if kind == MIDDLE:
        u = clipped(value[index[POSITION]], -1.0)
        return 1.0 - step(magnitude_within(u, 1e-6) / n[WIDTH])
    if kind == CUSHION:
        away = (value[index[POSITION]] - n[SHIFT]) * n[FACTOR]
        return n[LEAST] + (1.0 - n[LEAST]) * step(away / n[WIDTH])
    return 0.0 * value[index[OUTPUT]] + 1.0


@family
def apply(machine, number, t):
    """Flows of all restrictions."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    secant = circuit.secant[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        difference = circuit.pressure[a] - circuit.pressure[b]
        opening = opening_of(machine, index, n, t)
        flow = real(n[FLOW]) * opening * root_flow(difference, n[CORNER], secant) + real(n[LEAK]) * difference
        lose(machine, transfer(machine, a, b, 0.5 * (circuit.density[a] + circuit.density[b]) * flow))
        record.outputs.value[index[OUTPUT]] = flow
    return OK
