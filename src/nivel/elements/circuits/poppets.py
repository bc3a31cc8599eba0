"""Positions of poppets, which pressures open."""

from nivel.elements.circuits.kind import Phase, called, slopes_of
from nivel.elements.circuits.smooth import slope_of_step, step
from nivel.elements.circuits.tangent import add_by_pressure
from nivel.elements.rows import element
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

# columns of `columns`; output: position
OUTPUT, STATE, SPEED, COMMAND = 0, 1, 2, 3

# poppets: columns of `columns` from COMMAND on, a setting; then nodes
FIRST_NODE, NODES = 4, 4
# columns of `number`: range of pressures over which it opens [Pa], time constant [s], factor of the setting, constant pressure [Pa],
# factors of the nodes
RANGE, LAG, SETTING, OFFSET, FIRST_FACTOR = 0, 1, 2, 3, 4


@stage
def opening_pressure(machine, index, n, t):
    """Σ factor p + setting + offset of a poppet."""
    circuit = record_at(machine).circuit
    pressure = n[OFFSET] + n[SETTING] * evaluate_function(machine, index[COMMAND], t)
    for i in range(NODES):
        if index[FIRST_NODE + i] != NONE:
            pressure = pressure + n[FIRST_FACTOR + i] * circuit.pressure[index[FIRST_NODE + i]]
    return pressure


@called(Phase.POSITIONS, 0)
@element
def lift(machine, index, n, t):
    """Poppets: the opening S((Σ factor p + setting + offset)/range), or a state that follows it, τ ẋ = S - x."""
    record = record_at(machine)
    elements = record.elements
    opening = step(opening_pressure(machine, index, n, t) * (1.0 / n[RANGE]))
    if index[STATE] != NONE:
        own = index[STATE]
        elements.state_rate[own] += (opening - elements.state[own]) * (1.0 / n[LAG])
        opening = elements.state[own]
    record.outputs.value[index[OUTPUT]] = opening


@leaf
def slope_of_poppet(machine, index, n, t):
    """Slope of the opening S with Σ factor p + … [1/Pa]."""
    return slope_of_step(opening_pressure(machine, index, n, t) / n[RANGE]) / n[RANGE]


@slopes_of(lift)
@element
def add_slopes_of_poppets(machine, index, n, t):
    """Slopes of the positions of poppets that are states."""
    record = record_at(machine)
    circuit = record.circuit
    tangent = circuit.tangent
    if index[STATE] == NONE:
        return
    own = tangent.unknown[index[STATE]]
    tangent.slopes[own, own] -= 1.0 / n[LAG]
    slope = slope_of_poppet(machine, index, n, t) / n[LAG]
    for i in range(NODES):
        if slope != 0.0 and index[FIRST_NODE + i] != NONE:
            add_by_pressure(circuit, tangent.slopes[own], index[FIRST_NODE + i], slope * n[FIRST_FACTOR + i])
