"""Nodes of gas: an ideal gas of mass m and inner energy U in a volume V, or at the temperature of its surroundings.

    T = U/(m c_v)        p = m R T/V        U̇ = Σ ṁ c_p T_upstream - p V̇ + H (T₀ - T)

`Circuit.enthalpy` of a gas is its available energy b = c_p (T - T₀) - T₀ s(T, p), s = c_p ln(T/T₀) - R ln(p/pa): the work that a stream can
do until it is as the air around it (Bejan 2016, section 5). At T₀ it is R T₀ ln(p/pa) = ∫ dp/ρ, as that of a liquid. A volume stores
m b - (p - pa) V of it.
"""

import numpy as np

from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import Phase, called
from nivel.elements.circuits.ledger import lose
from nivel.elements.circuits.volumes import FIXED, GIVEN
from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import NO_VOLUME, OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf

# columns of `Circuit.fluid` after those of a liquid: R [J/(kg K)], c_p/c_v, T₀ [K], ρ√T [kg/m³ √K] of the reference of ISO 8778
GAS_CONSTANT, RATIO, SURROUNDINGS, REFERENCE = 6, 7, 8, 9
# columns of `columns`: those of `nivel.elements.circuits.volumes`, the state of the energy, or NONE; outputs: pressure, temperature
OUTPUT, NODE, KIND, STATE, FUNCTION, ENERGY = 0, 1, 2, 3, 4, 5
# columns of `number`: H, heat through the walls [W/K], and what of it grows with the volume [W/(K m³)]
WALLS, BY_VOLUME = 0, 1
# At rest gas has the temperature of its surroundings: it goes there with this rate [1/s].
CALM = 1.0


@leaf
def heat_capacity(f):
    """c_p [J/(kg K)]."""
    return f[GAS_CONSTANT] * f[RATIO] / (f[RATIO] - 1.0)


@leaf
def available_energy(f, temperature, p):
    """b [J/kg]."""
    entropy = heat_capacity(f) * np.log(temperature / f[SURROUNDINGS]) - f[GAS_CONSTANT] * np.log(p / ATMOSPHERE)
    return heat_capacity(f) * (temperature - f[SURROUNDINGS]) - f[SURROUNDINGS] * entropy


@called(Phase.PRESSURES, 2)
@family
def find_gas_pressures(machine, number, t):
    """Pressure, temperature, density and available energy of every node of gas; heat through its walls, and work on its pistons."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        node, own = index[NODE], index[ENERGY]
        f = circuit.fluid[circuit.node[node, 0]]
        temperature = 0.0 * circuit.volume[node] + f[SURROUNDINGS]
        if index[KIND] == GIVEN:
            p = evaluate_function(machine, index[FUNCTION], t)
        else:
            mass, volume = elements.state[index[STATE]], circuit.room[node, FIXED] + circuit.volume[node]
            if own != NONE:
                temperature = elements.state[own] * f[RATIO] / (heat_capacity(f) * mass)
            if not (real(mass) > 0.0 and real(volume) > 0.0 and real(temperature) > 0.0):
                record.control.failure[0] = node
                return NO_VOLUME
            p = mass * f[GAS_CONSTANT] * temperature / volume
            available = available_energy(f, temperature, p)
            stored = mass * available - (p - ATMOSPHERE) * volume
            circuit.stored[0] += stored
            record.control.stored[0] += stored
            if own != NONE:
                warmer = temperature - f[SURROUNDINGS]
                heat = (n[WALLS] + n[BY_VOLUME] * volume) * warmer
                lose(machine, heat * warmer / temperature)
                if record.sampled.at_rest[0] == 1:
                    heat = heat + CALM * mass * heat_capacity(f) * warmer
                elements.state_rate[own] -= p * circuit.volume_rate[node] + heat
        circuit.pressure[node], circuit.temperature[node] = p, temperature
        circuit.density[node] = p / (f[GAS_CONSTANT] * temperature)
        circuit.enthalpy[node] = available_energy(f, temperature, p)
        record.outputs.value[index[OUTPUT]], record.outputs.value[index[OUTPUT] + 1] = p, temperature
    return OK
