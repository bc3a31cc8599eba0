"""Flows through edges of spools that are known by curves over the position, one for each difference of pressure.

    Q = K(u, |Δp|) Δp (Δp² + c²)^(-1/4) + G Δp        ṁ = ½ (ρ_a + ρ_b) Q

The force of the flow on its spool, f Q √Δp, closes the edge; it belongs to the balance of `nivel.kernels.hydraulics.spool_drive`.

K lies on its curves at their differences of pressure and on a straight line between them; outside, the nearest curve holds. A single
curve is that of a sharp edge, whose flow grows with √Δp.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called, slopes_of
from nivel.kernels.hydraulics.smooth import root_flow
from nivel.kernels.hydraulics.tangent import add_by_pressure, add_flow_by_column, add_flow_by_pressure
from nivel.kernels.hydraulics.transfer import lose_between, transfer
from nivel.kernels.hydraulics.viscosity import thickness
from nivel.kernels.record.function import table_value
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf

# columns of `columns`; POSITION: output of the valve; SPEED: state of its spool on which the flow acts, or NONE; then its curves, which are
# tables. Output: flow [m³/s]
OUTPUT, FROM, TO, POSITION, SPEED, FIRST_CURVE = 0, 1, 2, 3, 4, 5
MOST = 8  # curves of an edge
# columns of `number`: corner c [Pa], leak G [m³/s/Pa], acceleration of the spool over Q √Δp, then the difference of pressure [Pa] of each
# curve
CORNER, LEAK, FORCE, FIRST_DROP = 0, 1, 2, 3


@leaf
def has_curve(index, i):
    """Whether an edge has a curve of this number."""
    return i < MOST and FIRST_CURVE + i < index.shape[0] and index[FIRST_CURVE + i] != NONE


@leaf
def curve_below(index, n, size):
    """Number of the curve at or below the difference of pressure `size`, the first one where there is none."""
    low = np.int64(0)
    while has_curve(index, low + 1) and size >= n[FIRST_DROP + low + 1]:
        low += 1
    return low


@leaf
def conductance_at(functions, index, n, u, difference):
    """(K [m³/s/√Pa], ∂K/∂u) at the position u and a real difference of pressure."""
    size = np.abs(difference)
    low = curve_below(index, n, size)
    value, slope, _ = table_value(functions, index[FIRST_CURVE + low], u)
    if has_curve(index, low + 1) and size > n[FIRST_DROP + low]:
        above, steeper, _ = table_value(functions, index[FIRST_CURVE + low + 1], u)
        share = (size - n[FIRST_DROP + low]) / (n[FIRST_DROP + low + 1] - n[FIRST_DROP + low])
        value = value + share * (above - value)
        slope = slope + share * (steeper - slope)
    return value, slope


@leaf
def rise_of_conductance(functions, index, n, u, difference):
    """∂K/∂|Δp| at a real position and difference of pressure."""
    size = np.abs(difference)
    low = curve_below(index, n, size)
    if has_curve(index, low + 1) and size > n[FIRST_DROP + low]:
        value, _, _ = table_value(functions, index[FIRST_CURVE + low], u)
        above, _, _ = table_value(functions, index[FIRST_CURVE + low + 1], u)
        return (above - value) / (n[FIRST_DROP + low + 1] - n[FIRST_DROP + low])
    return 0.0


@called(Phase.FLOWS)
@family
def apply(machine, number, t):
    """Flows of all edges."""
    record = record_at(machine)
    elements, circuit, functions = record.elements, record.circuit, record.functions
    secant = circuit.secant[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        u = record.outputs.value[index[POSITION]]
        difference = circuit.pressure[a] - circuit.pressure[b]
        conductance, _ = conductance_at(functions, index, n, u, real(difference))
        if secant == 0:
            rise = rise_of_conductance(functions, index, n, real(u), real(difference))
            way = rise if real(difference) >= 0.0 else -rise
            conductance = conductance + way * (difference - real(difference))
        flow = conductance * root_flow(difference, n[CORNER], secant) + n[LEAK] / thickness(circuit, a, b) * difference
        mass_flow = 0.5 * (circuit.density[a] + circuit.density[b]) * flow
        lose_between(machine, a, b, mass_flow, transfer(machine, a, b, mass_flow))
        record.outputs.value[index[OUTPUT]] = flow
        if index[SPEED] != NONE:
            elements.state_rate[index[SPEED]] += n[FORCE] * flow * root_flow(difference, n[CORNER], 0)
    return OK


@slopes_of(apply)
@family
def add_slopes(machine, number, t):
    """Slopes of all flows, those with pressures as secants."""
    record = record_at(machine)
    elements, circuit, functions = record.elements, record.circuit, record.functions
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        difference = circuit.pressure[a] - circuit.pressure[b]
        density = 0.5 * (circuit.density[a] + circuit.density[b])
        through = density / np.sqrt(np.sqrt(difference * difference + n[CORNER] * n[CORNER]))
        u = record.outputs.value[index[POSITION]]
        conductance, slope = conductance_at(functions, index, n, u, difference)
        by_pressure = through * conductance + density * n[LEAK] / thickness(circuit, a, b)
        if by_pressure != 0.0:
            add_flow_by_pressure(circuit, a, b, a, by_pressure)
            add_flow_by_pressure(circuit, a, b, b, -by_pressure)
        state = circuit.tangent.source[index[POSITION], 0]
        if state != NONE and slope != 0.0:
            add_flow_by_column(circuit, a, b, state, through * difference * slope)
        if index[SPEED] != NONE:
            size = np.sqrt(difference * difference + n[CORNER] * n[CORNER])
            tangent = circuit.tangent
            row = tangent.slopes[tangent.unknown[index[SPEED]]]
            by_difference = n[FORCE] * record.outputs.value[index[OUTPUT]] / np.sqrt(size)
            add_by_pressure(circuit, row, a, by_difference)
            add_by_pressure(circuit, row, b, -by_difference)
            if state != NONE:
                row[state] += n[FORCE] * slope * difference * difference / size
    return OK
