"""Coolers: heat that a liquid gives to a coolant of a given temperature on its way through.

    heat = ṁ c (T_in - T_c) (1 - exp(-H/(ṁ c)))

which is the law of a heat exchanger whose other side keeps its temperature; H is its conductance. The liquid behind it is colder by
heat/(ṁ c): T_out - T_c = (T_in - T_c) exp(-H/(ṁ c)).
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.fluid import HEAT_CAPACITY
from nivel.kernels.hydraulics.phase import Phase, called
from nivel.kernels.hydraulics.smooth import magnitude_within
from nivel.kernels.hydraulics.transfer import WARMTH
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at

# columns of `columns`; FLOW: output of the flow through it; functions of H [W/K] and T_c [K]. Output: heat [W]
OUTPUT, FROM, TO, FLOW, CONDUCTANCE, COOLANT = 0, 1, 2, 3, 4, 5
# mass flow [kg/s] within which its magnitude is rounded
STILL = 1e-6


@called(Phase.FLOWS, slow=True)
@family
def apply(machine, number, t):
    """Heat of all coolers, taken from the liquid behind them."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        a, b, flow = index[FROM], index[TO], value[index[FLOW]]
        up, down = (a, b) if real(flow) >= 0.0 else (b, a)
        capacity = circuit.fluid[circuit.node[a, 0], HEAT_CAPACITY]
        mass_flow = 0.5 * (circuit.density[a] + circuit.density[b]) * flow
        rate = capacity * magnitude_within(mass_flow, STILL)
        units = evaluate_function(machine, index[CONDUCTANCE], t) / rate
        heat = rate * (1.0 - np.exp(-units)) * (circuit.temperature[up] - evaluate_function(machine, index[COOLANT], t))
        if circuit.node[down, WARMTH] != NONE:
            circuit.inflow[down] -= heat
        value[index[OUTPUT]] = heat
    return OK
