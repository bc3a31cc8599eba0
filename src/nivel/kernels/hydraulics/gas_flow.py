"""Flows of gas through restrictions, by ISO 6358-1:2013: choked below the critical ratio b of pressures, an ellipse above it.

    ṁ = C p₁ ρ_N √(T_N/T₁) ψ        ψ = √(x (2 - x)), x = (1 - p₂/p₁)/(1 - b), and 1 for x > 1

C is the sonic conductance, ρ_N and T_N belong to its reference. The slope of ψ is infinite at x = 0; there √x is rounded, as
x (x² + ε²)^(-1/4) (1 + ε²)^(1/4). Gas that leaves a node takes its temperature along.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.gas import REFERENCE, SURROUNDINGS, heat_capacity
from nivel.kernels.hydraulics.phase import Phase, called
from nivel.kernels.hydraulics.restriction import FROM, OUTPUT, TO, opening_of
from nivel.kernels.hydraulics.transfer import lose, transfer
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

# The columns are those of `nivel.kernels.hydraulics.restriction`; in `number` C [m³/s/Pa] and b stand first. Output: flow at the reference
# of ISO 8778, 1 bar and 20 °C [m³/s]
SONIC, CRITICAL, LEAK = 0, 1, 2
ROUNDED = 1e-3
WHOLE = np.sqrt(np.sqrt(1.0 + ROUNDED * ROUNDED))
REFERENCE_ROOT = np.sqrt(293.15)  # √T_N [√K]


@leaf
def reduced_flow(n, high, low, secant):
    """p₁ ψ [Pa] for the pressures upstream and downstream.

    secant : on dual numbers, the derivative below choking is that of a line through the origin: see `root_flow`.
    """
    x = (high - low) / (high * (1.0 - n[CRITICAL]))
    if real(x) >= 1.0:
        return high + 0.0 * x
    if secant == 1:
        shown = real(x)
        slope = WHOLE * np.sqrt((2.0 - shown) / np.sqrt(shown * shown + ROUNDED * ROUNDED))
        return (high - low) / (1.0 - n[CRITICAL]) * slope
    return high * x * WHOLE * np.sqrt(2.0 - x) / np.sqrt(np.sqrt(x * x + ROUNDED * ROUNDED))


@stage
def carry_heat(machine, a, b, flow):
    """Energies that a mass flow [kg/s] from a to b takes along. Returns the available energy [W] of its heat in the gas that it meets."""
    record = record_at(machine)
    circuit, rate = record.circuit, record.elements.state_rate
    up, down = (a, b) if real(flow) >= 0.0 else (b, a)
    f = circuit.fluid[circuit.node[up, 0]]
    warm, own = circuit.temperature[up], circuit.temperature[down]
    carried = flow * heat_capacity(f) * warm
    if circuit.node[a, 2] != NONE:
        rate[circuit.node[a, 2]] -= carried
    if circuit.node[b, 2] != NONE:
        rate[circuit.node[b, 2]] += carried
    size = flow if up == a else -flow
    return size * (1.0 - f[SURROUNDINGS] / own) * heat_capacity(f) * (warm - own)


@called(Phase.FLOWS)
@family
def apply(machine, number, t):
    """Flows of gas through all restrictions."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        f = circuit.fluid[circuit.node[a, 0]]
        backward = real(circuit.pressure[b]) > real(circuit.pressure[a])
        up, down = (b, a) if backward else (a, b)
        reduced = reduced_flow(n, circuit.pressure[up], circuit.pressure[down], circuit.secant[0])
        flow = n[SONIC] * opening_of(machine, index, n, t) * f[REFERENCE] * reduced
        flow = flow / np.sqrt(circuit.temperature[up])
        flow += n[LEAK] * circuit.density[up] * (circuit.pressure[up] - circuit.pressure[down])
        if backward:
            flow = -flow
        lose(machine, transfer(machine, a, b, flow) - carry_heat(machine, a, b, flow))
        record.outputs.value[index[OUTPUT]] = flow * REFERENCE_ROOT / f[REFERENCE]
    return OK
