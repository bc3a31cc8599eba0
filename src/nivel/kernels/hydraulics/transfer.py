"""Transfer of flows to the nodes of a circuit."""

from __future__ import annotations

from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# entries of `Circuit.power`
SUPPLIED, DELIVERED, LOST, TAKEN_IN = 0, 1, 2, 3


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
    return out - into


@stage
def lose(machine, power):
    """Count a power [W] that the fluid loses."""
    record = record_at(machine)
    record.circuit.power[LOST] += power
    record.control.power[1] += power
