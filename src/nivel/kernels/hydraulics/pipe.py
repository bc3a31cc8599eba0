"""Losses of round pipes, laminar and turbulent in one formula, and the inertia of the fluid in them.

    Δp = R Q (1 + (Q/Q_c)⁶)^(1/8)        R = 128 ν ρ L/(π d⁴)

which is Hagen and Poiseuille's law for Q ≪ Q_c and Blasius's, Δp ~ Q^(7/4), for Q ≫ Q_c; both meet at Reynolds' number 1187, Q_c.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called
from nivel.kernels.hydraulics.slopes import add_by_pressure, add_flow_by_column, add_flow_by_pressure
from nivel.kernels.hydraulics.transfer import lose, transfer
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf

# columns of `columns`; STATE: of the mass flow, or NONE. Output: flow [m³/s]
OUTPUT, FROM, TO, STATE = 0, 1, 2, 3
# columns of `number`: R over ρ [1/(m s²)·m³/s], Q_c [m³/s], area over length [m], density of the kinetic energy [kg/m³]
RESISTANCE, CRITICAL, SLENDER, DENSITY = 0, 1, 2, 3
MOST = 50


@leaf
def loss(n, density, flow):
    """Δp [Pa] of the volume flow."""
    ratio = flow / n[CRITICAL]
    square = ratio * ratio
    return n[RESISTANCE] * density * flow * np.sqrt(np.sqrt(np.sqrt(1.0 + square * square * square)))


@leaf
def flow_ratio(y):
    """The real x with x (1 + x⁶)^(1/8) = y, by Newton's method from above."""
    size = np.abs(y)
    x = size if size < 1.0 else size ** (4.0 / 7.0)
    for _ in range(MOST):
        sixth = x**6
        root = (1.0 + sixth) ** 0.125
        change = (x * root - size) / (root * (1.0 + 0.75 * sixth / (1.0 + sixth)))
        x -= change
        if np.abs(change) <= 1e-12 * x + 1e-300:
            break
    return x if y > 0.0 else -x


@called(Phase.FLOWS)
@family
def apply(machine, number, t):
    """Flows through pipes; with inertia they are states, L/A d(ṁ)/dt = p_a - p_b - Δp."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        density = 0.5 * (circuit.density[a] + circuit.density[b])
        difference = circuit.pressure[a] - circuit.pressure[b]
        if index[STATE] == NONE:
            scale = n[RESISTANCE] * density * n[CRITICAL]
            found = flow_ratio(real(difference) / real(scale)) * real(n[CRITICAL])
            resistance = loss(n, density, found + 0.0 * difference)
            sixth = (found / real(n[CRITICAL])) ** 6
            slope = real(n[RESISTANCE]) * real(density) * (1.0 + sixth) ** 0.125 * (1.0 + 0.75 * sixth / (1.0 + sixth))
            flow = found + (difference - resistance) / slope
            lose(machine, transfer(machine, a, b, density * flow))
        else:
            mass_flow = elements.state[index[STATE]]
            flow = mass_flow / density
            driving = difference - loss(n, density, flow)
            elements.state_rate[index[STATE]] += n[SLENDER] * driving
            stored = 0.5 * mass_flow * mass_flow / (n[SLENDER] * n[DENSITY])
            circuit.stored[0] += stored
            record.control.stored[0] += stored
            lose(machine, transfer(machine, a, b, mass_flow) - mass_flow * driving / n[DENSITY])
        record.outputs.value[index[OUTPUT]] = flow
    return OK


@leaf
def add_slopes(machine, number):
    """Slopes of flows through pipes, those with pressures as secants."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    tangent = circuit.tangent
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        density = 0.5 * (circuit.density[a] + circuit.density[b])
        sixth = (value[index[OUTPUT]] / n[CRITICAL]) ** 6
        secant = n[RESISTANCE] * density * (1.0 + sixth) ** 0.125
        if index[STATE] == NONE:
            add_flow_by_pressure(circuit, a, b, a, density / secant)
            add_flow_by_pressure(circuit, a, b, b, -density / secant)
        else:
            own = tangent.unknown[index[STATE]]
            row = tangent.slopes[own]
            add_by_pressure(circuit, row, a, n[SLENDER])
            add_by_pressure(circuit, row, b, -n[SLENDER])
            row[own] -= n[SLENDER] * secant * (1.0 + 0.75 * sixth / (1.0 + sixth)) / density
            add_flow_by_column(circuit, a, b, own, 1.0)
