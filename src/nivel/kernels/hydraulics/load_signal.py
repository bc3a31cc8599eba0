"""The highest load of several directional valves, as a pressure that follows it: τ ṗ = p_max - p.

The load of a valve is the pressure at A or B, whichever it feeds, and that of its tank while it is closed.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called, slopes_of
from nivel.kernels.hydraulics.smooth import maximum_within, ramp, step
from nivel.kernels.hydraulics.spool import clipped
from nivel.kernels.hydraulics.tangent import add_by_pressure
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# columns of `columns`: STATE, then for each of MOST valves the output that is its position, and nodes A, B, T
STATE, FIRST = 0, 1
POSITION, NODE_A, NODE_B, NODE_T, WIDE = 0, 1, 2, 3, 4
MOST = 8
# columns of `number`: time constant [s], opening at which a load is wholly felt, then overlap and width of the ramp of each valve
LAG, OPENS_WITHIN, FIRST_VALVE = 0, 1, 2
# pressure [Pa] within which the highest load passes from one valve to the next
ROUNDED = 1e4


@stage
def feeds(machine, position, n, i):
    """Shares by which valve i, with the output `position`, feels A and B."""
    u = clipped(record_at(machine).outputs.value[position], -1.0)
    overlap, width = n[FIRST_VALVE + 2 * i], n[FIRST_VALVE + 2 * i + 1]
    to_a, to_b = step(ramp(u - overlap, width) / n[OPENS_WITHIN]), step(ramp(-u - overlap, width) / n[OPENS_WITHIN])
    return to_a, to_b


@called(Phase.FLOWS)
@family
def apply(machine, number, t):
    """Rates of the signals."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        highest = 0.0 * n[LAG]
        for i in range(MOST):
            first = FIRST + WIDE * i
            if index[first] == NONE:
                break
            to_a, to_b = feeds(machine, index[first + POSITION], n, i)
            tank = circuit.pressure[index[first + NODE_T]]
            load = tank + to_a * (circuit.pressure[index[first + NODE_A]] - tank)
            load += to_b * (circuit.pressure[index[first + NODE_B]] - tank)
            highest = maximum_within(highest, load, ROUNDED)
        own = index[STATE]
        elements.state_rate[own] += (highest - elements.state[own]) / n[LAG]
    return OK


@slopes_of(apply)
@family
def add_slopes(machine, number, t):
    """Slopes of the signals with pressures; what positions of valves change in them is left out."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    tangent = circuit.tangent
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        own, highest = tangent.unknown[index[STATE]], 0.0
        row = tangent.slopes[own]
        for i in range(MOST):
            first = FIRST + WIDE * i
            if index[first] == NONE:
                break
            to_a, to_b = feeds(machine, index[first + POSITION], n, i)
            a, b, drain = index[first + NODE_A], index[first + NODE_B], index[first + NODE_T]
            tank = circuit.pressure[drain]
            load = tank + to_a * (circuit.pressure[a] - tank) + to_b * (circuit.pressure[b] - tank)
            lead = (load - highest) / np.sqrt((load - highest) ** 2 + ROUNDED * ROUNDED)
            for j in range(row.shape[0]):
                row[j] *= 0.5 * (1.0 - lead)
            share = 0.5 * (1.0 + lead) / n[LAG]
            add_by_pressure(circuit, row, a, share * to_a)
            add_by_pressure(circuit, row, b, share * to_b)
            add_by_pressure(circuit, row, drain, share * (1.0 - to_a - to_b))
            highest = maximum_within(highest, load, ROUNDED)
        row[own] -= 1.0 / n[LAG]
    return OK
