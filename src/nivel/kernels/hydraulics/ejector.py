"""Suction of ejectors: a flow of gas that a jet draws from a low pressure to a higher one, by the points of a catalogue.

    ṁ = ρ_N Q(p_R - p_A) S((p_P - p_R)/Δp)        S = 3 t² - 2 t³

Q is linear between its points and zero beyond the last, the greatest vacuum. The jet itself is a restriction from P to R.
"""

from __future__ import annotations

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.gas import REFERENCE
from nivel.kernels.hydraulics.gas_flow import REFERENCE_ROOT, carry_heat
from nivel.kernels.hydraulics.phase import Phase, called
from nivel.kernels.hydraulics.smooth import step
from nivel.kernels.hydraulics.transfer import lose, transfer
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

# columns of `columns`; output: flow at the reference of ISO 8778 [m³/s]
OUTPUT, INLET, SUCTION, EXHAUST = 0, 1, 2, 3
# columns of `number`: Δp [Pa], number of points, then MOST_POINTS pairs: vacuum [Pa], flow [m³/s]
DRIVE, POINTS, FIRST_POINT, MOST_POINTS = 0, 1, 2, 5


@leaf
def suction(n, vacuum):
    """Q [m³/s] at a vacuum [Pa], that at none where the pressure is higher than outside."""
    count = int(n[POINTS])
    if real(vacuum) <= n[FIRST_POINT]:
        return 0.0 * vacuum + n[FIRST_POINT + 1]
    for k in range(count - 1):
        place = FIRST_POINT + 2 * k
        if real(vacuum) < n[place + 2]:
            return n[place + 1] + (vacuum - n[place]) * ((n[place + 3] - n[place + 1]) / (n[place + 2] - n[place]))
    return 0.0 * vacuum


@called(Phase.FLOWS)
@family
def apply(machine, number, t):
    """Suction of all ejectors."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[SUCTION], index[EXHAUST]
        f = circuit.fluid[circuit.node[a, 0]]
        driven = step((circuit.pressure[index[INLET]] - circuit.pressure[b]) * (1.0 / n[DRIVE]))
        flow = suction(n, circuit.pressure[b] - circuit.pressure[a]) * driven
        mass_flow = flow * f[REFERENCE] / REFERENCE_ROOT
        lose(machine, transfer(machine, a, b, mass_flow) - carry_heat(machine, a, b, mass_flow))
        record.outputs.value[index[OUTPUT]] = flow
    return OK
