"""Integrals over a circuit since the start, states that nothing depends on: energies supplied to its fluid, given to bodies and lost, and
the mass that tanks gave it."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`; output: energy stored in the circuit
OUTPUT, STATE = 0, 1


@called(Phase.BEGIN)
@family
def begin(machine, number, t):
    """Nothing is stored and no power flows before nodes and components add theirs."""
    circuit = record_at(machine).circuit
    circuit.stored[0] = 0.0
    for i in range(circuit.power.shape[0]):
        circuit.power[i] = 0.0
    return OK


@called(Phase.BALANCE)
@family
def apply(machine, number, t):
    """Rates of these; at rest they are none, since only the state of the machine is asked for."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        record.outputs.value[index[OUTPUT]] = circuit.stored[0]
        if record.sampled.at_rest[0] == 0:
            for i in range(4):
                elements.state_rate[index[STATE] + i] += circuit.power[i]
    return OK
