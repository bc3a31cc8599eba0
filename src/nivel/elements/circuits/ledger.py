"""Transfer of flows to the nodes of a circuit.
Integrals over a circuit since the start, states that nothing depends on: energies supplied to its fluid, given to bodies and lost, and
the mass that tanks gave it. They are the last states of a machine.

The matrices of implicit methods have no row of these. A linearly implicit step x of (1 - s J) x = r needs none of the mass that tanks gave
either: its rate is the sum of those of the masses of all volumes, and so are its rows of J, hence x less the sum of x of these is r less
the sum of r. Then a step gives tanks what it gives volumes, to round-off.
"""

import numpy as np

from nivel.elements.circuits.density import EXPANSION, HEAT_CAPACITY
from nivel.elements.circuits.kind import Phase, called
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rows import clear
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

# entries of `Circuit.power`
SUPPLIED, DELIVERED, LOST, TAKEN_IN = 0, 1, 2, 3
# column of `Circuit.node`: state of the temperature of a liquid, or NONE; see `nivel.elements.circuits.coolers`
WARMTH = 3


@leaf
def warmth(circuit, node):
    """c θ [J/kg] of a liquid whose temperature is a state: what its enthalpy is but for the pressure."""
    f = circuit.fluid[circuit.node[node, 0]]
    return (
        f[HEAT_CAPACITY] * circuit.temperature[node] / (1.0 + f[EXPANSION] / f[HEAT_CAPACITY] * circuit.enthalpy[node])
    )


@leaf
def carry_warmth(circuit, up, down, flow):
    """Let a mass flow [kg/s] take its heat along. `Circuit.inflow` has heat [W] of all nodes, then the flows [kg/s] into them."""
    circuit.inflow[down] += flow * (warmth(circuit, up) - warmth(circuit, down))
    circuit.inflow[circuit.node.shape[0] + down] += flow


@stage
def transfer(machine, a, b, flow):
    """Let a mass `flow` [kg/s] go from node a to node b. Returns flow (h_a - h_b) [W], the power that it gives up on the way.

    Nodes of given pressure deliver flow h: work done on the machine.
    """
    record = record_at(machine)
    circuit, rate = record.circuit, record.elements.state_rate
    out, into = flow * circuit.enthalpy[a], flow * circuit.enthalpy[b]
    if circuit.node[a, 1] != NONE:
        rate[circuit.node[a, 1]] -= flow
    else:
        circuit.power[SUPPLIED] += out
        circuit.power[TAKEN_IN] += flow
        record.control.power[0] += out
    if circuit.node[b, 1] != NONE:
        rate[circuit.node[b, 1]] += flow
    else:
        circuit.power[SUPPLIED] -= into
        circuit.power[TAKEN_IN] -= flow
        record.control.power[0] -= into
    if real(flow) >= 0.0:
        if circuit.node[b, WARMTH] != NONE:
            carry_warmth(circuit, a, b, flow)
    elif circuit.node[a, WARMTH] != NONE:
        carry_warmth(circuit, b, a, -flow)
    return out - into


@stage
def lose(machine, power):
    """Count a power [W] that the fluid loses."""
    record = record_at(machine)
    record.circuit.power[LOST] += power
    record.control.power[1] += power


@stage
def lose_between(machine, a, b, flow, power):
    """Count a power [W] that is lost where a flow goes from node a to node b: it warms the liquid at the end of its way."""
    lose(machine, power)
    circuit = record_at(machine).circuit
    down = b if real(flow) >= 0.0 else a
    if circuit.node[down, WARMTH] != NONE:
        circuit.inflow[down] += power


# columns of `columns`; output: energy stored in the circuit
LEDGER_OUTPUT, FIRST_INTEGRAL = 0, 1
# place of the mass that tanks gave, from the end of the state of a machine: behind it are its two energies
TAKEN_IN_FROM_END = 3


@leaf
def mass_apart(machine, r):
    """Of a change r (ny,) of the state the mass that tanks gave less that of all volumes; 0 without circuits."""
    record = record_at(machine)
    node, count = record.circuit.node, r.shape[0]
    first = count - 2 - record.elements.state.shape[0]
    apart = 0.0 * r[count - TAKEN_IN_FROM_END]
    if node.shape[0] > 0:
        apart += r[count - TAKEN_IN_FROM_END]
    for k in range(node.shape[0]):
        if node[k, 1] != NONE:
            apart -= r[first + np.int64(node[k, 1])]
    return apart


@leaf
def balance_mass(machine, x, apart):
    """Let tanks give in x (ny,) what the volumes take, and `apart` besides."""
    if record_at(machine).circuit.node.shape[0] > 0:
        x[x.shape[0] - TAKEN_IN_FROM_END] += apart - mass_apart(machine, x)


@called(Phase.BEGIN, 0)
@family
def begin_ledger(machine, number, t):
    """Nothing is stored and no power flows before nodes and components add theirs."""
    circuit = record_at(machine).circuit
    circuit.stored[0] = 0.0
    clear(circuit.power)
    return OK


@called(Phase.BALANCE, 1)
@element
def balance_ledger(machine, index, n, t):
    """Rates of these; at rest they are none, since only the state of the machine is asked for."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    record.outputs.value[index[LEDGER_OUTPUT]] = circuit.stored[0]
    if record.sampled.at_rest[0] == 0:
        for i in range(4):
            elements.state_rate[index[FIRST_INTEGRAL] + i] += circuit.power[i]
