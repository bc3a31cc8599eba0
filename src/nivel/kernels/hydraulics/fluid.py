"""The law of density of a liquid with undissolved air: one function v(p) = ρ₀/ρ; bulk modulus and energy follow from it.

    v(p) = (1 - α) L^(-1/β') + α (pa/p)^(1/n)        L = 1 + β' (p - pa)/β₀        β = ρ dp/dρ = -v/v'

α is the volume fraction of the air at atmospheric pressure pa, which is carried along and polytropic; β₀ + β' (p - pa) is the bulk modulus
of the liquid. As the pressure goes to zero the air takes any volume, so that a volume that is emptied cavitates by the same law, and keeps
its mass. Enthalpy h = ∫ dp/ρ from pa.
"""

from __future__ import annotations

import numpy as np

from nivel.native.function import leaf

ATMOSPHERE = 101325.0  # [Pa]
# columns of `Circuit.fluid`: fraction of air, bulk modulus [Pa] of the liquid at pa, its slope, polytropic exponent, ρ₀ [kg/m³],
# kinematic viscosity [m²/s]
AIR, MODULUS, SLOPE, EXPONENT, DENSITY, VISCOSITY = 0, 1, 2, 3, 4, 5
# Newton's iteration of the pressure ends at a change of this share: the error is then its square, and one more step follows.
EXACT, MOST = 1e-5, 100


@leaf
def specific_volume(f, p):
    """(v, dv/dp, ρ₀ h) of the fluid with the constants f at the real pressure p > 0."""
    alpha, modulus, slope, n = f[AIR], f[MODULUS], f[SLOPE], f[EXPONENT]
    over = p - ATMOSPHERE
    L = 1.0 + slope * over / modulus
    if slope > 0.0:
        liquid = L ** (-1.0 / slope)
        energy = modulus / (slope - 1.0) * (L * liquid - 1.0) if slope != 1.0 else modulus * np.log(L)
    else:
        liquid = np.exp(-over / modulus)
        energy = modulus * (1.0 - liquid)
    air = (ATMOSPHERE / p) ** (1.0 / n)
    air_energy = ATMOSPHERE * np.log(p / ATMOSPHERE)
    if n != 1.0:
        air_energy = ATMOSPHERE * n / (n - 1.0) * (p / ATMOSPHERE * air - 1.0)
    value = (1.0 - alpha) * liquid + alpha * air
    derivative = -(1.0 - alpha) * liquid / (modulus * L) - alpha * air / (n * p)
    return value, derivative, (1.0 - alpha) * energy + alpha * air_energy
