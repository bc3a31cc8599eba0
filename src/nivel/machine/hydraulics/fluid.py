"""Fluids in words: a liquid with some air in it, an ideal gas."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import Discriminator, GetCoreSchemaHandler, Tag
from pydantic_core import CoreSchema

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.core.coefficient import Exponent, NotNegativeNumber, Pressure, Temperature, Truth, Viscosity
from nivel.machine.core.record import Name, entry
from nivel.machine.given import Field, OneNumber
from nivel.machine.hydraulics.usual import BULK_MODULUS, GAS_DENSITY, LIQUID_DENSITY, TEMPERATURE, VISCOSITY
from nivel.machine.units.quantity import Density, Quantity

AIR_DENSITY = 1.2  # kg/m³ at atmospheric pressure
LEAST_AIR, MOST_AIR = 1e-4, 0.2
REFERENCE_PRESSURE, REFERENCE_TEMPERATURE = 1e5, 293.15  # Pa, K: of ISO 8778, to which sonic conductances refer
MOST_RATIO = 5.0 / 3.0  # of c_p over c_v, of gases of one atom


class Fluid(Checked):
    """Constants of the law of density in `docs/hydraulics.md`. The defaults are those of a mineral oil at 40 °C."""

    collection: ClassVar[str] = "fluids"

    name: Name
    type: Literal["liquid"] = Field(default="liquid", description="need not be given", optional=True)
    density: Density = Field(default=870.0, description="of the liquid at atmospheric pressure", usual=LIQUID_DENSITY)
    bulk_modulus: Pressure = Field(
        default=1.5e9, description="of the liquid at atmospheric pressure", usual=BULK_MODULUS
    )
    bulk_modulus_slope: NotNegativeNumber = Field(default=10.0, description="what it grows by with the pressure")
    air: Annotated[OneNumber, Quantity("number", positive=True)] = Field(
        default=0.005, description="undissolved air: its share of the volume at atmospheric pressure"
    )
    gas_exponent: Exponent = Field(default=1.4, description="polytropic exponent of the air: 1.4 fast, 1 slow")
    viscosity: Viscosity = Field(default=46e-6, description="kinematic", usual=VISCOSITY)

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


class Gas(Checked):
    """An ideal gas. The defaults are those of air at the reference of ISO 8778: 1.185 kg/m³ at 20 °C and 1 bar."""

    collection: ClassVar[str] = "fluids"

    name: Name
    type: Literal["ideal-gas"] = "ideal-gas"
    density: Density = Field(default=1.185, description="at 20 °C and 1 bar", usual=GAS_DENSITY)
    heat_capacity_ratio: Annotated[OneNumber, Quantity("number")] = Field(
        default=1.4, description="c_p over c_v, of gas whose temperature is a state"
    )
    temperature: Temperature = Field(
        default=293.15, description="of tanks, of walls, and of all gas at the start", usual=TEMPERATURE
    )
    isothermal: Truth = Field(default=False, description="whether the gas keeps that temperature")

    @property
    def gas_constant(self) -> float:
        """R [J/(kg K)]."""
        return REFERENCE_PRESSURE / (self.density * REFERENCE_TEMPERATURE)

    def problems(self) -> Iterator[Problem]:
        if not 1.0 < self.heat_capacity_ratio <= MOST_RATIO:
            yield Problem(
                ("heat_capacity_ratio",),
                f"a ratio above 1 and up to 5/3 was expected, got {self.heat_capacity_ratio:g}; air has 1.4. "
                "What keeps its temperature is `isothermal: true`",
            )


def _kind(fluid: Any) -> str:
    return str(entry(fluid, "type") or "liquid")


class _AnyFluid:
    """A liquid or a gas, told apart by `type`; a liquid without one."""

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        kinds = Annotated[Fluid, Tag("liquid")] | Annotated[Gas, Tag("ideal-gas")]
        return handler.generate_schema(Annotated[kinds, Discriminator(_kind)])


if TYPE_CHECKING:
    AnyFluid = Fluid | Gas
else:
    AnyFluid = _AnyFluid

OIL = Fluid(name="oil")
