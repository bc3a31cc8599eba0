"""Viscosity of a liquid over that of its constants: by its temperature, where that is a state, and by its pressure.

ν + 0.7 mm²/s = 10^(10^(A - B lg T)) (Walther 1931)        ν ~ exp(α (p - pa)) (Barus 1893)
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.hydraulics.fluid import ATMOSPHERE, BARUS, HEAT_CAPACITY, THINNESS, WALTHER_A, WALTHER_B
from nivel.native.function import leaf

TEN = np.log(10.0)


@leaf
def thickness(circuit, a, b):
    """ν(T)/ν(T₀) at the mean temperature of two nodes; one where it is no state."""
    f = circuit.fluid[circuit.node[a, 0]]
    mean = 0.5 * (circuit.temperature[a] + circuit.temperature[b])
    if f[HEAT_CAPACITY] == 0.0:
        return 0.0 * mean + 1.0
    return (np.exp(TEN * np.exp(TEN * f[WALTHER_A] - f[WALTHER_B] * np.log(mean))) - 0.7) * f[THINNESS]


@leaf
def thickening(circuit, a, b):
    """The same with the growth by the mean pressure."""
    alpha = circuit.fluid[circuit.node[a, 0], BARUS]
    over = 0.5 * (circuit.pressure[a] + circuit.pressure[b]) - ATMOSPHERE
    return np.exp(alpha * over) * thickness(circuit, a, b)
