"""Temperature of liquids, a state of their volumes: losses, and what flows in, warm them.

The law of density holds at constant entropy, so that its bulk modulus is the isentropic one. The state is the temperature θ that the
liquid would have at atmospheric pressure, expanded without heat; what fills a volume is m exp(α (θ - θ₀)) at θ₀. With μ = ∫ dp/ρ from pa

    v = φ(p)/ρ₀ exp(α (θ - θ₀))        h = c (θ - θ₀) + μ        T = ∂h/∂s = θ (1 + α μ/c)        ds = c dθ/θ

and the first law, m T ds = Σ ṁ_in (h_in - h) + heat, becomes

    m (c + α μ) dθ/dt = Σ ṁ_in c (θ_up - θ) + losses on the way in - H (T - T₀)

Mechanical energy is m μ - (p - pa) V: of the heat, m α μ dθ/dt becomes mechanical as the liquid expands. c and α are constant.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import NO_VOLUME, OK
from nivel.kernels.hydraulics.fluid import AROUND, EXPANSION, HEAT_CAPACITY, START
from nivel.kernels.hydraulics.phase import Phase, called, slopes_of
from nivel.kernels.hydraulics.transfer import WARMTH, lose
from nivel.kernels.hydraulics.volume import VOLUME, find_pressure, give_pressure
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`: those of `nivel.kernels.hydraulics.volume`, and the function of a given temperature; outputs: pressure, temperature
OUTPUT, NODE, KIND, STATE, FUNCTION, TEMPERATURE = 0, 1, 2, 3, 4, 5
# column of `number`: H, heat through the walls [W/K]
WALLS = 0
# At rest liquids have the temperature of their start: they go there with this rate [1/s].
CALM = 1.0


@called(Phase.PRESSURES)
@family
def apply(machine, number, t):
    """Pressure, density and temperature of every node of such a liquid; no heat flows into it yet."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    count = circuit.node.shape[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        node, out = index[NODE], index[OUTPUT]
        f = circuit.fluid[circuit.node[node, 0]]
        if index[KIND] == VOLUME:
            theta = elements.state[circuit.node[node, WARMTH]]
            growth = np.exp(f[EXPANSION] * (theta - f[START]))
            if not real(theta) > 0.0:
                record.control.failure[0] = node
                return NO_VOLUME
            status = find_pressure(machine, node, elements.state[index[STATE]] * growth)
            if status != OK:
                return status
        else:
            theta = evaluate_function(machine, index[TEMPERATURE], t)
            growth = np.exp(f[EXPANSION] * (theta - f[START]))
            give_pressure(machine, node, evaluate_function(machine, index[FUNCTION], t))
        circuit.density[node] = circuit.density[node] / growth
        circuit.enthalpy[node] = circuit.enthalpy[node] * growth
        circuit.temperature[node] = theta * (1.0 + f[EXPANSION] / f[HEAT_CAPACITY] * circuit.enthalpy[node])
        circuit.inflow[node], circuit.inflow[count + node] = 0.0, 0.0
        record.outputs.value[out], record.outputs.value[out + 1] = circuit.pressure[node], circuit.temperature[node]
    return OK


@called(Phase.BALANCE)
@family
def warm(machine, number, t):
    """Rates of the temperatures of volumes; at rest they go back to that of the start."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        node = index[NODE]
        f, own = circuit.fluid[circuit.node[node, 0]], circuit.node[node, WARMTH]
        mass, expansion = elements.state[index[STATE]], f[EXPANSION] * circuit.enthalpy[node]
        heat = circuit.inflow[node] - n[WALLS] * (circuit.temperature[node] - f[AROUND])
        rate = heat / (mass * (f[HEAT_CAPACITY] + expansion))
        if record.sampled.at_rest[0] == 1:
            rate = CALM * (f[START] - elements.state[own])
        elements.state_rate[own] += rate
        lose(machine, -mass * expansion * rate)
    return OK


@slopes_of(warm)
@family
def add_slopes(machine, number, t):
    """Slopes of the temperatures with themselves; heat is slow beside steps."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    tangent, count = circuit.tangent, circuit.node.shape[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        node = index[NODE]
        capacity = circuit.fluid[circuit.node[node, 0], HEAT_CAPACITY]
        own = tangent.unknown[circuit.node[node, WARMTH]]
        falling = circuit.inflow[count + node] + n[WALLS] / capacity
        tangent.slopes[own, own] -= falling / elements.state[index[STATE]]
    return OK
