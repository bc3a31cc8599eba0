"""Hydraulic fluids by name: density, bulk modulus and viscosity over the temperature.

Viscosity: the law of Walther (1931) and ASTM D341, lg lg(ν + 0.7) = A - B lg T with ν in mm²/s, through its values at 40 °C, which is the
class of ISO 3448, and at 100 °C. It grows with the pressure as exp(α p) (Barus 1893). Density: ρ = ρ₁₅ (1 - γ (T - 15 °C)). Bulk modulus
of mineral oils, isentropic (Hayward 1970): (1.57 + 0.15 lg ν₂₀) 10^(0.0024 (20 °C - T)) GPa, growing with 5.6 p as a secant, so with
11.2 p as a tangent. Of other fluids it has that dependence on the temperature and its own value at 20 °C.

Thermal expansion at a temperature is γ ρ₁₅/ρ.

The numbers of each grade are those of usual data sheets: HLP and HVLP of DIN 51524, HEES of ISO 15380, HFC of ISO 12922.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log10
from typing import Final

CELSIUS: Final = 273.15
AT_CLASS, AT_HOT, AT_DENSITY, AT_MODULUS = CELSIUS + 40.0, CELSIUS + 100.0, CELSIUS + 15.0, CELSIUS + 20.0  # [K]


@dataclass(frozen=True)
class Liquid:
    """Constants of a liquid: density [kg/m³], bulk modulus [Pa] at atmospheric pressure, what it grows by with the pressure, kinematic
    viscosity [m²/s], its growth with the pressure [1/Pa], thermal expansion [1/K] and heat capacity [J/(kg K)]."""

    density: float
    bulk_modulus: float
    bulk_modulus_slope: float
    viscosity: float
    pressure_viscosity: float
    expansion: float = 0.0
    heat_capacity: float = 1900.0


@dataclass(frozen=True)
class Grade:
    """Numbers of a data sheet: ν [mm²/s] at 40 and 100 °C, density [kg/m³] at 15 °C, its fall [1/K], Barus's α [1/Pa], and the bulk
    modulus [Pa] at 20 °C with its slope; None: by Hayward. Heat capacity [J/(kg K)]."""

    at_40: float
    at_100: float
    density: float
    expansion: float
    barus: float
    bulk_modulus: float | None = None
    slope: float = 11.2
    heat_capacity: float = 1900.0

    @property
    def walther(self) -> tuple[float, float]:
        """A and B of lg lg(ν + 0.7) = A - B lg T, with ν in mm²/s."""
        low, high = (log10(log10(each + 0.7)) for each in (self.at_40, self.at_100))
        slope = (low - high) / log10(AT_HOT / AT_CLASS)
        return low + slope * log10(AT_CLASS), slope

    def viscosity(self, temperature: float) -> float:
        """Kinematic viscosity [m²/s] at atmospheric pressure and a temperature [K]."""
        constant, slope = self.walther
        return 1e-6 * (10.0 ** (10.0 ** (constant - slope * log10(temperature))) - 0.7)

    def at(self, temperature: float) -> Liquid:
        """Its constants at a temperature [K]."""
        cold = self.bulk_modulus or 1e9 * (1.57 + 0.15 * log10(1e6 * self.viscosity(AT_MODULUS)))
        return Liquid(
            self.density * (1.0 - self.expansion * (temperature - AT_DENSITY)),
            cold * 10.0 ** (0.0024 * (AT_MODULUS - temperature)),
            self.slope,
            self.viscosity(temperature),
            self.barus,
            self.expansion / (1.0 - self.expansion * (temperature - AT_DENSITY)),
            self.heat_capacity,
        )


GRADES: Final = {
    "HLP 32": Grade(32.0, 5.4, 872.0, 7.0e-4, 2.0e-8),
    "HLP 46": Grade(46.0, 6.8, 879.0, 7.0e-4, 2.1e-8),
    "HLP 68": Grade(68.0, 8.7, 884.0, 7.0e-4, 2.2e-8),
    "HVLP 32": Grade(32.0, 6.1, 870.0, 7.0e-4, 1.9e-8),
    "HVLP 46": Grade(46.0, 7.9, 872.0, 7.0e-4, 2.0e-8),
    "HVLP 68": Grade(68.0, 10.9, 877.0, 7.0e-4, 2.1e-8),
    "HEES 46": Grade(46.0, 9.2, 921.0, 7.5e-4, 1.3e-8, bulk_modulus=1.95e9, slope=10.0, heat_capacity=2000.0),
    "HFC 46": Grade(46.0, 9.6, 1085.0, 6.0e-4, 0.35e-8, bulk_modulus=3.5e9, slope=6.0, heat_capacity=3200.0),
}
