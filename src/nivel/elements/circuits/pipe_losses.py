"""Losses of round pipes, laminar and turbulent in one formula.

    Δp = g R Q (1 + (Q/(g Q_c))⁶)^(1/8)        R = 128 ν ρ L/(π d⁴)

g is the growth of the viscosity with pressure and temperature (`nivel.elements.circuits.density`). The law is Hagen and Poiseuille's for
Q ≪ Q_c and Blasius's, Δp ~ Q^(7/4), for Q ≫ Q_c; both meet at Reynolds' number 1187, Q_c. Pipes with inertia are lines
(`nivel.elements.circuits.lines`).
"""

from __future__ import annotations

import numpy as np

from nivel.native.function import leaf

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


CRITICAL_REYNOLDS = (0.3164 / 64.0) ** (-4.0 / 3.0)  # where 64/Re is 0.3164 Re^(-1/4)
