"""Integrals over a circuit since the start, states that nothing depends on: energies supplied to its fluid, given to bodies and lost, and
the mass that tanks gave it. They are the last states of a machine.

The matrices of implicit methods have no row of these. A linearly implicit step x of (1 - s J) x = r needs none of the mass that tanks gave
either: its rate is the sum of those of the masses of all volumes, and so are its rows of J, hence x less the sum of x of these is r less
the sum of r. Then a step gives tanks what it gives volumes, to round-off.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf

# columns of `columns`; output: energy stored in the circuit
OUTPUT, STATE = 0, 1
# place of the mass that tanks gave, from the end of the state of a machine: behind it are its two energies
TAKEN_IN = 3


@leaf
def mass_apart(machine, r):
    """Of a change r (ny,) of the state the mass that tanks gave less that of all volumes; 0 without circuits."""
    record = record_at(machine)
    node, count = record.circuit.node, r.shape[0]
    first = count - 2 - record.elements.state.shape[0]
    apart = 0.0 * r[count - TAKEN_IN]
    if node.shape[0] > 0:
        apart += r[count - TAKEN_IN]
    for k in range(node.shape[0]):
        if node[k, 1] != NONE:
            apart -= r[first + np.int64(node[k, 1])]
    return apart


@leaf
def balance_mass(machine, x, apart):
    """Let tanks give in x (ny,) what the volumes take, and `apart` besides."""
    if record_at(machine).circuit.node.shape[0] > 0:
        x[x.shape[0] - TAKEN_IN] += apart - mass_apart(machine, x)


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
