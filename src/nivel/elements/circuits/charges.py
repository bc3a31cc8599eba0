"""Accumulators whose gas exchanges heat with its surroundings, within a time τ.

The gas is compressed without heat, p V^γ = P V₀^γ; heat changes P, which is a state (Pourmovahed and Otis 1990, for an ideal gas):

    dP/dt = P (T₀/T - 1)/τ        T/T₀ = p V/(p₀ V₀) = P/p₀ (V/V₀)^(1 - γ)

At rest T = T₀ and p V = p₀ V₀. P stands in place of the precharge among the constants of the volume
(`nivel.elements.circuits.volumes`); how its pressure depends on P on dual numbers is a room that is zero in its real part.

Nitrogen has θ, its temperature at the precharge's density on its adiabat, in place of P, and c_v dθ/θ = ds = c_v(ρ, T) (T₀/T - 1)/τ dt.
"""

from __future__ import annotations

import numpy as np

from nivel.elements.circuits.ledger import lose
from nivel.elements.circuits.nitrogen import gas_state, newton_step, on_adiabat
from nivel.elements.circuits.phase import Phase, called
from nivel.elements.circuits.volumes import (
    EXPONENT,
    GAS,
    LAST_DENSITY,
    LAST_TEMPERATURE,
    NITROGEN,
    OPEN,
    PRECHARGE,
    PRESSURE,
    THETA,
)
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
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


@called(Phase.VOLUMES, 1, slow=True)
@element
def charge(machine, index, n, t):
    """Put P among the constants of each volume."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    node = index[NODE]
    room, known, own = circuit.room[node], circuit.known[node], elements.state[index[STATE]]
    if room[PRECHARGE] != real(own):
        room[PRECHARGE] = real(own)
        known[OPEN] += CHANGED * (known[OPEN] + room[GAS])  # what is known holds for another P
    by_state = 0.0
    if known[PRESSURE] > room[PRECHARGE]:
        by_state = -room[GAS] * share_of_gas(room, known[PRESSURE]) / (room[EXPONENT] * room[PRECHARGE])
    circuit.volume[node] = by_state * (own - real(own))


@called(Phase.FLOWS, 13, slow=True)
@element
def exchange_heat(machine, index, n, t):
    """Rates of P, and the heat that leaves the gas."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
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


@leaf
def gas_at(room, theta, pressure):
    """(ρ, T) of nitrogen at a pressure, not below that of its precharge's density, for θ; exact on dual numbers."""
    least, _, _, entropy, _, _ = gas_state(room[NITROGEN], theta)
    if real(pressure) < real(least):
        pressure = least
    rho, T = on_adiabat(real(pressure), real(entropy), real(room[LAST_DENSITY]), real(room[LAST_TEMPERATURE]))
    return newton_step(pressure, entropy, rho, T)


@leaf
def room_by_theta(room, theta, pressure):
    """∂V_oil/∂θ [m³/K] at a real pressure."""
    _, _, _, _, heat_at_rest, _ = gas_state(room[NITROGEN], theta)
    rho, T = gas_at(room, theta, pressure)
    _, by_density, by_heat, _, heat, _ = gas_state(rho, T)
    falling = -by_heat / (by_density * heat / T + by_heat * by_heat / (rho * rho))  # of ρ with s
    return room[GAS] * room[NITROGEN] / (rho * rho) * falling * heat_at_rest / theta


@called(Phase.VOLUMES, 2, slow=True)
@element
def charge_nitrogen(machine, index, n, t):
    """Put θ among the constants of each volume, and the pressure of its precharge's density."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    node = index[NODE]
    room, known, own = circuit.room[node], circuit.known[node], elements.state[index[STATE]]
    if room[THETA] != real(own):
        room[THETA] = real(own)
        room[PRECHARGE] = gas_state(real(room[NITROGEN]), real(own))[0]
        known[OPEN] += CHANGED * (known[OPEN] + room[GAS])  # what is known holds for another θ
    by_state = 0.0
    if known[PRESSURE] > room[PRECHARGE]:
        by_state = room_by_theta(room, real(own), known[PRESSURE])
    circuit.volume[node] = by_state * (own - real(own))


@called(Phase.FLOWS, 14, slow=True)
@element
def warm_nitrogen(machine, index, n, t):
    """Rates of θ, and the heat that leaves the gas."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    room, own = circuit.room[index[NODE]], elements.state[index[STATE]]
    rho, T = gas_at(room, own, circuit.pressure[index[NODE]])
    _, _, _, _, heat, _ = gas_state(rho, T)
    _, _, _, _, heat_at_rest, _ = gas_state(room[NITROGEN], own)
    rate = heat * (n[SURROUNDINGS] / T - 1.0) / n[TIME]  # of s
    elements.state_rate[index[STATE]] += rate * own / heat_at_rest
    # the energy on the adiabat is counted from θ on
    lose(machine, -room[GAS] * room[NITROGEN] * (T - own) * rate)
    record.outputs.value[index[OUTPUT]] = T
