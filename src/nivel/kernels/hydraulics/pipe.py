"""Losses of round pipes, laminar and turbulent in one formula.

    Δp = g R Q (1 + (Q/(g Q_c))⁶)^(1/8)        R = 128 ν ρ L/(π d⁴)

g is the growth of the viscosity with pressure and temperature (`nivel.kernels.hydraulics.viscosity`). The law is Hagen and Poiseuille's for
Q ≪ Q_c and Blasius's, Δp ~ Q^(7/4), for Q ≫ Q_c; both meet at Reynolds' number 1187, Q_c. Pipes with inertia are lines
(`nivel.kernels.hydraulics.line`).
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called, slopes_of
from nivel.kernels.hydraulics.tangent import add_flow_by_pressure
from nivel.kernels.hydraulics.transfer import lose_between, transfer
from nivel.kernels.hydraulics.viscosity import thickening
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

# columns of `columns`. Output: flow [m³/s]
OUTPUT, FROM, TO = 0, 1, 2
# columns of `number`: R over ρ [1/(m s²)·m³/s], Q_c [m³/s]
RESISTANCE, CRITICAL = 0, 1
MOST = 50


@leaf
def loss(n, g, density, flow):
    """Δp [Pa] of the volume flow; g is the growth of the viscosity."""
    ratio = flow / (n[CRITICAL] * g)
    square = ratio * ratio
    return n[RESISTANCE] * g * density * flow * np.sqrt(np.sqrt(np.sqrt(1.0 + square * square * square)))


@leaf
def slope_of_loss(n, g, flow):
    """∂Δp/∂Q over the density."""
    sixth = (flow / (n[CRITICAL] * g)) ** 6
    return n[RESISTANCE] * g * (1.0 + sixth) ** 0.125 * (1.0 + 0.75 * sixth / (1.0 + sixth))


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
    """Flows through pipes without inertia."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        density, g = 0.5 * (circuit.density[a] + circuit.density[b]), thickening(circuit, a, b)
        difference = circuit.pressure[a] - circuit.pressure[b]
        critical = real(n[CRITICAL]) * real(g)
        scale = real(n[RESISTANCE]) * real(g) * real(density) * critical
        found = flow_ratio(real(difference) / scale) * critical
        resistance = loss(n, g, density, found + 0.0 * difference)
        flow = found + (difference - resistance) / (real(density) * slope_of_loss(n, real(g), found))
        mass_flow = density * flow
        lose_between(machine, a, b, mass_flow, transfer(machine, a, b, mass_flow))
        record.outputs.value[index[OUTPUT]] = flow
    return OK


@slopes_of(apply)
@family
def add_slopes(machine, number, t):
    """Slopes of flows through pipes, as secants."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        a, b = index[FROM], index[TO]
        g = thickening(circuit, a, b)
        sixth = (value[index[OUTPUT]] / (n[CRITICAL] * g)) ** 6
        secant = n[RESISTANCE] * g * (1.0 + sixth) ** 0.125
        add_flow_by_pressure(circuit, a, b, a, 1.0 / secant)
        add_flow_by_pressure(circuit, a, b, b, -1.0 / secant)
    return OK
