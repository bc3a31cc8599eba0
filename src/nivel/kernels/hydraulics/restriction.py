"""Flows through restrictions: orifices, edges of valves, leaks.

    Q = K x Δp (Δp² + c²)^(-1/4) + G Δp        ṁ = ½ (ρ_a + ρ_b) Q

x is an opening from 0 to 1. Edges of spools open as R(z)/R(z at a full stroke), z = factor u + shift, R a ramp: exactly closed within
their overlap.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called, slopes_of
from nivel.kernels.hydraulics.smooth import magnitude_within, ramp, root_flow, slope_of_step, step
from nivel.kernels.hydraulics.spool import FIRST_FACTOR, FIRST_NODE, NODES, clipped, slope_of_poppet
from nivel.kernels.hydraulics.tangent import add_flow_by_column, add_flow_by_pressure
from nivel.kernels.hydraulics.transfer import lose_between, transfer
from nivel.kernels.hydraulics.viscosity import thickness
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

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


@called(Phase.FLOWS)
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
        flow = (
            n[FLOW] * opening * root_flow(difference, n[CORNER], secant)
            + n[LEAK] / thickness(circuit, a, b) * difference
        )
        mass_flow = 0.5 * (circuit.density[a] + circuit.density[b]) * flow
        lose_between(machine, a, b, mass_flow, transfer(machine, a, b, mass_flow))
        record.outputs.value[index[OUTPUT]] = flow
    return OK


@leaf
def slope_of_opening(index, n, u):
    """Slope of the opening of a restriction with the position u of its valve."""
    kind = index[KIND]
    if kind == DIRECT:
        return 1.0 if 0.0 <= u <= 1.0 else 0.0
    if not -1.0 <= u <= 1.0:
        return 0.0
    if kind == EDGE:
        return n[FACTOR] * step((n[FACTOR] * u + n[SHIFT]) / n[WIDTH]) * n[SCALE]
    size = magnitude_within(u, 1e-6)
    return -slope_of_step(size / n[WIDTH]) / n[WIDTH] * u / size


@slopes_of(apply)
@family
def add_slopes(machine, number, t):
    """Slopes of all flows, those with pressures as secants."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b, kind = index[FROM], index[TO], index[KIND]
        difference = circuit.pressure[a] - circuit.pressure[b]
        density = 0.5 * (circuit.density[a] + circuit.density[b])
        through = n[FLOW] / np.sqrt(np.sqrt(difference * difference + n[CORNER] * n[CORNER]))
        conductance = density * (through * opening_of(machine, index, n, t) + n[LEAK] / thickness(circuit, a, b))
        if conductance != 0.0:
            add_flow_by_pressure(circuit, a, b, a, conductance)
            add_flow_by_pressure(circuit, a, b, b, -conductance)
        if kind in (FIXED, GIVEN, CUSHION):
            continue
        slope = density * through * difference * slope_of_opening(index, n, value[index[POSITION]])
        if slope == 0.0:
            continue
        state, poppet = circuit.tangent.source[index[POSITION], 0], circuit.tangent.source[index[POSITION], 1]
        if state != NONE:
            add_flow_by_column(circuit, a, b, state, slope)
        elif poppet != NONE:
            valve, factors = elements.columns[poppet], elements.number[poppet]
            slope *= slope_of_poppet(machine, valve, factors, t)
            for i in range(NODES):
                if slope != 0.0 and valve[FIRST_NODE + i] != NONE:
                    add_flow_by_pressure(circuit, a, b, valve[FIRST_NODE + i], slope * factors[FIRST_FACTOR + i])
    return OK
