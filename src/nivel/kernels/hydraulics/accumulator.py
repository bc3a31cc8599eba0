"""Accumulators whose gas exchanges heat with its surroundings, within a time τ.

The gas is compressed without heat, p V^γ = P V₀^γ; heat changes P, which is a state (Pourmovahed and Otis 1990, for an ideal gas):

    dP/dt = P (T₀/T - 1)/τ        T/T₀ = p V/(p₀ V₀) = P/p₀ (V/V₀)^(1 - γ)

At rest T = T₀ and p V = p₀ V₀. P stands in place of the precharge among the constants of the volume
(`nivel.kernels.hydraulics.volume`); how its pressure depends on P on dual numbers is a room that is zero in its real part.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called
from nivel.kernels.hydraulics.transfer import lose
from nivel.kernels.hydraulics.volume import EXPONENT, GAS, OPEN, PRECHARGE, PRESSURE
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

# columns of `columns`; output: temperature of the gas
OUTPUT, NODE, STATE = 0, 1, 2
# columns of `number`: p₀ [Pa], τ [s], T₀ [K]
FILLED, TIME, SURROUNDINGS = 0, 1, 2
CHANGED = 1e-12


@leaf
def share_of_gas(room, pressure):
    """V/V₀ at the real pressure [Pa]; one below P."""
    return min(1.0, (room[PRECHARGE] / pressure) ** (1.0 / room[EXPONENT]))


@called(Phase.VOLUMES)
@family
def charge(machine, number, t):
    """Put P among the constants of each volume."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        node = index[NODE]
        room, known, own = circuit.room[node], circuit.known[node], elements.state[index[STATE]]
        if room[PRECHARGE] != real(own):
            room[PRECHARGE] = real(own)
            known[OPEN] += CHANGED * (known[OPEN] + room[GAS])  # what is known holds for another P
        by_state = 0.0
        if known[PRESSURE] > room[PRECHARGE]:
            by_state = -room[GAS] * share_of_gas(room, known[PRESSURE]) / (room[EXPONENT] * room[PRECHARGE])
        circuit.volume[node] = by_state * (own - real(own))
    return OK


@called(Phase.FLOWS)
@family
def exchange_heat(machine, number, t):
    """Rates of P, and the heat that leaves the gas."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        room, own = circuit.room[index[NODE]], elements.state[index[STATE]]
        pressure = circuit.pressure[index[NODE]]
        left = (own / pressure) ** (1.0 / room[EXPONENT])
        if real(left) > 1.0:
            left = 0.0 * left + 1.0
        over = room[EXPONENT] - 1.0
        warmth = own / n[FILLED] * np.exp(-over * np.log(left))
        rate = own * (1.0 / warmth - 1.0) / n[TIME]
        elements.state_rate[index[STATE]] += rate
        work = (np.exp(-over * np.log(left)) - 1.0) / over if over > 0.0 else -np.log(left)
        lose(machine, -room[GAS] * work * rate)
        record.outputs.value[index[OUTPUT]] = n[SURROUNDINGS] * warmth
    return OK
