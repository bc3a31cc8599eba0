"""A fluid in words: a liquid with some air in it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar

from pydantic import Field

from nivel.machine.checked import Checked, Problem
from nivel.machine.coefficient import Exponent, NotNegativeNumber, Pressure, Viscosity
from nivel.machine.quantity import Density, Quantity
from nivel.machine.record import Name

AIR_DENSITY = 1.2  # kg/m³ at atmospheric pressure
LEAST_AIR, MOST_AIR = 1e-4, 0.2


class Fluid(Checked):
    """Constants of the law of density in `docs/hydraulics.md`. The defaults are those of a mineral oil at 40 °C."""

    collection: ClassVar[str] = "fluids"

    name: Name
    density: Density = Field(default=870.0, description="of the liquid at atmospheric pressure")
    bulk_modulus: Pressure = Field(default=1.5e9, description="of the liquid at atmospheric pressure")
    bulk_modulus_slope: NotNegativeNumber = Field(default=10.0, description="what it grows by with the pressure")
    air: Annotated[float, Quantity("number", positive=True)] = Field(
        default=0.005, description="undissolved air: its share of the volume at atmospheric pressure"
    )
    gas_exponent: Exponent = Field(default=1.4, description="polytropic exponent of the air: 1.4 fast, 1 slow")
    viscosity: Viscosity = Field(default=46e-6, description="kinematic")

    @property
    def mixed_density(self) -> float:
        """[kg/m³] of liquid and air at atmospheric pressure."""
        return (1.0 - self.air) * self.density + self.air * AIR_DENSITY

    def problems(self) -> Iterator[Problem]:
        if not LEAST_AIR <= self.air <= MOST_AIR:
            asked = f"air from {LEAST_AIR:g} to {MOST_AIR:g} of the volume was expected, got {self.air:g}"
            yield Problem(("air",), f"{asked}; without any, a liquid would bear tension")
        if self.bulk_modulus < 1e7:
            yield Problem(
                ("bulk_modulus",), f"a liquid has a bulk modulus of about 1.5 GPa, got {self.bulk_modulus:g} Pa"
            )


OIL = Fluid(name="oil")
