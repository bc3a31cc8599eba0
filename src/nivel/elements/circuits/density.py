"""The law of density of a liquid with air and vapour: one function v(p) = ρ₀/ρ; bulk modulus and energy follow from it.

    v(p) = (1 - α) L^(-1/β') + (α + α_d (1 - p/p_s)) (pa/p)^(1/n) + (p_v/p)^m        L = 1 + β' (p - pa)/β₀        β = ρ dp/dρ = -v/v'

α is the volume fraction of the air at atmospheric pressure pa that is always there, and polytropic. α_d is dissolved from the saturation
pressure p_s on and comes out below it as Henry's law says, at once. Liquid turns to vapour at the pressure p_v: m is large. β₀ and β' are
the bulk modulus of the liquid and its growth with p - pa. A volume that is emptied cavitates by the same law, and keeps its mass.
Enthalpy h = ∫ dp/ρ from pa.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from nivel.elements.circuits.fluids import ATMOSPHERE, GRADES, REFERENCE_PRESSURE, REFERENCE_TEMPERATURE, ROOM
from nivel.known import Fluid, Gas
from nivel.native.function import leaf

# columns of `Circuit.fluid`: fraction of air, bulk modulus [Pa] of the liquid at pa, its slope, polytropic exponent, ρ₀ [kg/m³],
# kinematic viscosity [m²/s]
AIR, MODULUS, SLOPE, EXPONENT, DENSITY, VISCOSITY = 0, 1, 2, 3, 4, 5
# and behind the constants of gases: α_d, p_s [Pa], p_v [Pa], growth of the viscosity with the pressure (Barus) [1/Pa]
DISSOLVED, SATURATION, VAPOUR, BARUS = 10, 11, 12, 13
# and of liquids whose temperature is a state (`nivel.elements.circuits.coolers`): c [J/(kg K)], 0 for others; α [1/K], θ₀ [K], A and B of
# the viscosity, 1/ν(θ₀) [s/mm²], temperature around walls [K]
HEAT_CAPACITY, EXPANSION, START, WALTHER_A, WALTHER_B, THINNESS, AROUND = 14, 15, 16, 17, 18, 19, 20
STEEP = 20.0  # m: within a tenth of p_v the volume grows eightfold
# Newton's iteration of the pressure ends at a change of this share: the error is then its square, and one more step follows.
EXACT, MOST = 1e-5, 100


@leaf
def work_of_air(n, begin, end):
    """∫ (pa/p)^(1/n) dp [Pa]."""
    if n == 1.0:
        return ATMOSPHERE * np.log(end / begin)
    power = 1.0 - 1.0 / n
    return ATMOSPHERE / power * ((end / ATMOSPHERE) ** power - (begin / ATMOSPHERE) ** power)


@leaf
def work_of_share(n, begin, end):
    """∫ p (pa/p)^(1/n) dp [Pa²]."""
    power = 2.0 - 1.0 / n
    return ATMOSPHERE * ATMOSPHERE / power * ((end / ATMOSPHERE) ** power - (begin / ATMOSPHERE) ** power)


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
    energy = (1.0 - alpha) * energy + alpha * air_energy
    if p < f[SATURATION] and f[DISSOLVED] > 0.0:
        free, saturation = 1.0 - p / f[SATURATION], f[SATURATION]
        value += f[DISSOLVED] * free * air
        derivative -= f[DISSOLVED] * air * (free / (n * p) + 1.0 / saturation)
        energy += f[DISSOLVED] * (work_of_air(n, saturation, p) - work_of_share(n, saturation, p) / saturation)
    if f[VAPOUR] > 0.0:
        vapour = (f[VAPOUR] / p) ** STEEP
        value += vapour
        derivative -= STEEP * vapour / p
        energy -= (p * vapour - ATMOSPHERE * (f[VAPOUR] / ATMOSPHERE) ** STEEP) / (STEEP - 1.0)
    return value, derivative, energy


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


FLUID = 21  # columns of `Circuit.fluid`

NO_GAS = (0.0, 0.0, 0.0, 0.0)  # constants of gases, of a liquid


def fluid_constants(fluid: Fluid | Gas) -> tuple[float, ...]:
    """A row of `Circuit.fluid`: constants of liquids, then of gases. A gas at T₀ is as a liquid that is all air."""
    if isinstance(fluid, Gas):
        density = ATMOSPHERE / (fluid.gas_constant * fluid.temperature)
        reference = REFERENCE_PRESSURE / (fluid.gas_constant * math.sqrt(REFERENCE_TEMPERATURE))
        of_gas = (fluid.gas_constant, fluid.heat_capacity_ratio, fluid.temperature, reference)
        return (1.0, ATMOSPHERE, 0.0, 1.0, density, 0.0, *of_gas, *[0.0] * (FLUID - 10))
    liquid = fluid.liquid
    of_liquid = (fluid.air, liquid.bulk_modulus, liquid.bulk_modulus_slope, fluid.gas_exponent)
    released = (fluid.dissolved_air, fluid.saturation_pressure, fluid.least_pressure, liquid.pressure_viscosity)
    return (*of_liquid, fluid.mixed_density, liquid.viscosity, *NO_GAS, *released, *_constants_of_warmth(fluid))


def _constants_of_warmth(fluid: Fluid) -> tuple[float, ...]:
    """HEAT_CAPACITY … AROUND of a liquid. Air that is in it has its temperature, and no heat capacity."""
    start = fluid.temperature
    if fluid.isothermal or fluid.grade is None:
        return (0.0, 0.0, start, 0.0, 0.0, 1.0, start)
    grade, liquid = GRADES[fluid.grade], fluid.liquid
    walther = (*grade.walther, 1e-6 / grade.viscosity(start))
    return (liquid.heat_capacity, liquid.expansion, start, *walther, fluid.surroundings or ROOM)


# as it is written: kernels call it compiled
_LAW: Any = getattr(specific_volume, "py_func", specific_volume)


def density_and_modulus(fluid: Sequence[float], p: float) -> tuple[float, float]:
    """(ρ [kg/m³], β = ρ dp/dρ [Pa]) at the absolute pressure p; `fluid` is a row of `Circuit.fluid`."""
    v, slope, _ = _LAW(fluid, p)
    return float(fluid[DENSITY] / v), float(-v / slope)
