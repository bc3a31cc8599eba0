"""Flows of long lines between their segments, and of pipes with inertia: inertia of the fluid, and friction that depends on the frequency.

    l/A d(ṁ)/dt = p_a - p_b - Δp        Δp = g R ρ Q (1 + (Q/(g Q_c))⁶)^(1/8) + ζ ρ/(2 A²) Q |Q| + g U ρ Σ y_i

g is the growth of the viscosity with pressure and temperature (`nivel.kernels.hydraulics.viscosity`).
The first part is that of `nivel.kernels.hydraulics.pipe`, the second one that of bends. The third one is the difference of laminar friction
to that of a steady flow (Zielke 1968), with his weight as a sum of exponentials (Trikha 1975), those of Kagawa, Lee, Kitagawa and Takenaka
1983:

    y_i = z_i + m_i Q        ż_i = -n_i g κ (z_i + m_i Q)        κ = 4 ν/d²        U = 16 ν l/(d² A)
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called, slopes_of
from nivel.kernels.hydraulics.pipe import loss, slope_of_loss
from nivel.kernels.hydraulics.smooth import magnitude_within
from nivel.kernels.hydraulics.tangent import add_by_pressure, add_flow_by_column
from nivel.kernels.hydraulics.transfer import lose_between, transfer
from nivel.kernels.hydraulics.viscosity import thickening
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

# columns of `columns`; states: mass flow, then the z_i, one behind the other. Output: flow [m³/s]
OUTPUT, FROM, TO, STATE, FIRST_PART, PARTS = 0, 1, 2, 3, 4, 5
# columns of `number`: R over ρ, Q_c [m³/s], A/l [m], density of the kinetic energy [kg/m³], ζ/(2 A²) [1/m⁴], U, κ [1/s], flow within which
# |Q| is rounded [m³/s]
RESISTANCE, CRITICAL, SLENDER, DENSITY, BENDS, UNSTEADY, DECAY, SMALL = range(8)
# n_i and m_i
RATES = np.array(
    (26.3744, 72.8033, 187.424, 536.626, 1570.60, 4618.13, 13601.1, 40082.5, 118153.0, 348316.0),
)
WEIGHTS = np.array((1.0, 1.16725, 2.20064, 3.92861, 6.78788, 11.6761, 20.0612, 34.4541, 59.1642, 101.590))


@leaf
def steady_loss(n, g, density, flow):
    """Δp [Pa] of a steady flow."""
    return loss(n, g, density, flow) + n[BENDS] * density * flow * magnitude_within(flow, n[SMALL])


@called(Phase.FLOWS)
@family
def apply(machine, number, t):
    """Rates of the flows of lines, and of what their friction remembers."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        density, g = 0.5 * (circuit.density[a] + circuit.density[b]), thickening(circuit, a, b)
        mass_flow = elements.state[index[STATE]]
        flow = mass_flow / density
        total = 0.0 * flow
        for i in range(index[PARTS]):
            own = index[FIRST_PART] + i
            part = elements.state[own] + WEIGHTS[i] * flow
            total += part
            elements.state_rate[own] -= RATES[i] * n[DECAY] * g * part
        driving = circuit.pressure[a] - circuit.pressure[b] - steady_loss(n, g, density, flow)
        driving -= n[UNSTEADY] * g * density * total
        elements.state_rate[index[STATE]] += n[SLENDER] * driving
        stored = 0.5 * mass_flow * mass_flow / (n[SLENDER] * n[DENSITY])
        circuit.stored[0] += stored
        record.control.stored[0] += stored
        power = transfer(machine, a, b, mass_flow) - mass_flow * driving / n[DENSITY]
        lose_between(machine, a, b, mass_flow, power)
        record.outputs.value[index[OUTPUT]] = flow
    return OK


@slopes_of(apply)
@family
def add_slopes(machine, number, t):
    """Slopes of flows and of what their friction remembers."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    tangent = circuit.tangent
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        density, g = 0.5 * (circuit.density[a] + circuit.density[b]), thickening(circuit, a, b)
        flow = value[index[OUTPUT]]
        steady = slope_of_loss(n, g, flow)
        steady += 2.0 * n[BENDS] * magnitude_within(flow, n[SMALL])
        own = tangent.unknown[index[STATE]]
        row = tangent.slopes[own]
        add_by_pressure(circuit, row, a, n[SLENDER])
        add_by_pressure(circuit, row, b, -n[SLENDER])
        row[own] -= n[SLENDER] * steady
        for i in range(index[PARTS]):
            part = tangent.unknown[index[FIRST_PART] + i]
            row[part] -= n[SLENDER] * n[UNSTEADY] * g * density
            row[own] -= n[SLENDER] * n[UNSTEADY] * g * WEIGHTS[i]
            decay = RATES[i] * n[DECAY] * g
            tangent.slopes[part, part] -= decay
            tangent.slopes[part, own] -= decay * WEIGHTS[i] / density
        add_flow_by_column(circuit, a, b, own, 1.0)
    return OK
