"""Transfer of flows to the nodes of a circuit."""

from __future__ import annotations

from nivel.kernels.algebra.analytic import real
from nivel.kernels.hydraulics.fluid import EXPANSION, HEAT_CAPACITY
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

# entries of `Circuit.power`
SUPPLIED, DELIVERED, LOST, TAKEN_IN = 0, 1, 2, 3
# column of `Circuit.node`: state of the temperature of a liquid, or NONE; see `nivel.kernels.hydraulics.warmth`
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
