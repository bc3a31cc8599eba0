"""Flows between the segments of tubes of gas: inertia of the gas and the friction of its pipe, steady at every instant.

    l/A d(ṁ)/dt = p_a - p_b - Δp        Δp = 128 μ l/(π d⁴) ṁ/ρ (1 + (ṁ/ṁ_c)⁶)^(1/8) + ζ/(2 A²) ṁ |ṁ|/ρ

laminar below ṁ_c and turbulent above it (Blasius), as `nivel.kernels.hydraulics.pipe`. With the volumes of the segments, in which the gas
is compressed without heat, waves run with √(κ R T).
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.gas import REFERENCE
from nivel.kernels.hydraulics.gas_flow import REFERENCE_ROOT, carry_heat
from nivel.kernels.hydraulics.phase import Phase, called
from nivel.kernels.hydraulics.smooth import magnitude_within
from nivel.kernels.hydraulics.transfer import lose, transfer
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`; output: flow at the reference of ISO 8778 [m³/s]
OUTPUT, FROM, TO, STATE = 0, 1, 2, 3
# columns of `number`: 128 μ l/(π d⁴), ṁ_c [kg/s], A/l [m], density of the kinetic energy [kg/m³], ζ/(2 A²) [1/m⁴]
RESISTANCE, CRITICAL, SLENDER, DENSITY, BENDS = range(5)
ROUNDED = 1e-3  # of ṁ_c, within which |ṁ| is rounded


@called(Phase.FLOWS)
@family
def apply(machine, number, t):
    """Rates of the flows of tubes."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        specific = 2.0 / (circuit.density[a] + circuit.density[b])
        mass_flow = elements.state[index[STATE]]
        ratio = mass_flow * (1.0 / n[CRITICAL])
        square = ratio * ratio
        turbulent = np.sqrt(np.sqrt(np.sqrt(1.0 + square * square * square)))
        loss = n[RESISTANCE] * mass_flow * specific * turbulent
        loss += n[BENDS] * mass_flow * specific * magnitude_within(mass_flow, ROUNDED * n[CRITICAL])
        driving = circuit.pressure[a] - circuit.pressure[b] - loss
        elements.state_rate[index[STATE]] += n[SLENDER] * driving
        stored = 0.5 * mass_flow * mass_flow / (n[SLENDER] * n[DENSITY])
        circuit.stored[0] += stored
        record.control.stored[0] += stored
        given = transfer(machine, a, b, mass_flow) - carry_heat(machine, a, b, mass_flow)
        lose(machine, given - mass_flow * driving / n[DENSITY])
        f = circuit.fluid[circuit.node[a, 0]]
        record.outputs.value[index[OUTPUT]] = mass_flow * REFERENCE_ROOT / f[REFERENCE]
    return OK
