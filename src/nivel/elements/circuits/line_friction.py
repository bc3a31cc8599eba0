"""Friction of lines: that of a steady flow and of bends, and what depends on the frequency.

    Δp = g R ρ Q (1 + (Q/(g Q_c))⁶)^(1/8) + ζ ρ/(2 A²) Q |Q| + g U ρ Σ y_i

g is the growth of the viscosity with pressure and temperature (`nivel.elements.circuits.density`).
The first part is the loss of a round pipe, Hagen and Poiseuille's for Q ≪ Q_c and Blasius's, Δp ~ Q^(7/4), for Q ≫ Q_c; both meet at
Reynolds' number 1187, Q_c. The second one is that of bends. The third one is the difference of laminar
friction to that of a steady flow (Zielke 1968), with his weight as a sum of exponentials (Trikha 1975), those of Kagawa, Lee, Kitagawa
and Takenaka 1983:

    y_i = z_i + m_i Q        ż_i = -n_i g κ (z_i + m_i Q)        κ = 4 ν/d²        U = 16 ν l/(d² A)
"""

import numpy as np

from nivel.elements.circuits.smooth import magnitude_within
from nivel.native.function import leaf

MOST_ITERATIONS = 50
CRITICAL_REYNOLDS = (0.3164 / 64.0) ** (-4.0 / 3.0)  # where 64/Re is 0.3164 Re^(-1/4)
# columns of `number`: R over ρ, Q_c [m³/s], A/l [m], density of the kinetic energy [kg/m³], ζ/(2 A²) [1/m⁴], U, κ [1/s], flow within which
# |Q| is rounded [m³/s]
RESISTANCE, CRITICAL, SLENDER, KINETIC_DENSITY, BENDS, UNSTEADY, DECAY, SMALL = range(8)
# n_i and m_i
RATES = np.array((26.3744, 72.8033, 187.424, 536.626, 1570.60, 4618.13, 13601.1, 40082.5, 118153.0, 348316.0))
WEIGHTS = np.array((1.0, 1.16725, 2.20064, 3.92861, 6.78788, 11.6761, 20.0612, 34.4541, 59.1642, 101.590))


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
    for _ in range(MOST_ITERATIONS):
        sixth = x**6
        root = (1.0 + sixth) ** 0.125
        change = (x * root - size) / (root * (1.0 + 0.75 * sixth / (1.0 + sixth)))
        x -= change
        if np.abs(change) <= 1e-12 * x + 1e-300:
            break
    return x if y > 0.0 else -x


@leaf
def steady_loss(n, g, density, flow):
    """Δp [Pa] of a steady flow."""
    return loss(n, g, density, flow) + n[BENDS] * density * flow * magnitude_within(flow, n[SMALL])
