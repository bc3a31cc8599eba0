"""The highest load of several directional valves, as a pressure that follows it: τ ṗ = p_max - p.

The load of a valve is the pressure at A or B, whichever it feeds, and that of its tank while it is closed.
"""

from __future__ import annotations

from nivel.kernels.hook import family
from nivel.kernels.hydraulics.smooth import maximum_within, ramp, step
from nivel.kernels.hydraulics.spool import clipped
from nivel.kernels.record import NONE, record_at
from nivel.kernels.status import OK

# columns of `columns`: STATE, then for each of MOST valves the output that is its position, and nodes A, B, T
STATE, FIRST = 0, 1
POSITION, NODE_A, NODE_B, NODE_T, WIDE = 0, 1, 2, 3, 4
MOST = 8
# columns of `number`: time constant [s], opening at which a load is wholly felt, then overlap and width of the ramp of each valve
LAG, OPENS_WITHIN, FIRST_VALVE = 0, 1, 2
# pressure [Pa] within which the highest load passes from one valve to the next
ROUNDED = 1e4


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
            u = clipped(record.outputs.value[index[first + POSITION]], -1.0)
            overlap, width = n[FIRST_VALVE + 2 * i], n[FIRST_VALVE + 2 * i + 1]
            to_a, to_b = (
                step(ramp(u - overlap, width) / n[OPENS_WITHIN]),
                step(ramp(-u - overlap, width) / n[OPENS_WITHIN]),
            )
            tank = circuit.pressure[index[first + NODE_T]]
            load = tank + to_a * (circuit.pressure[index[first + NODE_A]] - tank)
            load += to_b * (circuit.pressure[index[first + NODE_B]] - tank)
            highest = maximum_within(highest, load, ROUNDED)
        own = index[STATE]
        elements.state_rate[own] += (highest - elements.state[own]) / n[LAG]
    return OK
