"""Fluids: a liquid with some air in it, an ideal gas; and liquids by name.

Viscosity: the law of Walther (1931) and ASTM D341, lg lg(ν + 0.7) = A - B lg T with ν in mm²/s, through its values at 40 °C, which is the
class of ISO 3448, and at 100 °C. It grows with the pressure as exp(α p) (Barus 1893). Density: ρ = ρ₁₅ (1 - γ (T - 15 °C)). Bulk modulus
of mineral oils, isentropic (Hayward 1970): (1.57 + 0.15 lg ν₂₀) 10^(0.0024 (20 °C - T)) GPa, growing with 5.6 p as a secant, so with
11.2 p as a tangent. Of other fluids it has that dependence on the temperature and its own value at 20 °C.

Thermal expansion at a temperature is γ ρ₁₅/ρ.

The numbers of each grade are those of usual data sheets: HLP and HVLP of DIN 51524, HEES of ISO 15380, HFC of ISO 12922.
"""

from collections.abc import Iterator
from math import log10
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Literal

from pydantic import Discriminator, GetCoreSchemaHandler, Tag
from pydantic_core import CoreSchema

from nivel.elements.circuits import ranges
from nivel.lazy import Struct, fields, replace
from nivel.machine.core import coefficient
from nivel.machine.core.record import Checked, Name, Problem, entry, superfluous
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.units.quantity import Density, Quantity

CELSIUS: Final = 273.15
AT_CLASS, AT_HOT, AT_DENSITY, AT_MODULUS = CELSIUS + 40.0, CELSIUS + 100.0, CELSIUS + 15.0, CELSIUS + 20.0  # [K]


class Liquid(Struct):
    """Constants of a liquid: density [kg/m³], bulk modulus [Pa] at atmospheric pressure, what it grows by with the pressure, kinematic
    viscosity [m²/s], its growth with the pressure [1/Pa], thermal expansion [1/K] and heat capacity [J/(kg K)]."""

    density: float
    bulk_modulus: float
    bulk_modulus_slope: float
    viscosity: float
    pressure_viscosity: float
    expansion: float = 0.0
    heat_capacity: float = 1900.0


class Grade(Struct):
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

ATMOSPHERE = 101325.0  # Pa
LOW_VAPOUR = 100.0  # Pa, of liquids without air that do not say
AIR_DENSITY = 1.2  # kg/m³ at atmospheric pressure
LEAST_AIR, MOST_AIR = 1e-4, 0.2
REFERENCE_PRESSURE, REFERENCE_TEMPERATURE = 1e5, 293.15  # Pa, K: of ISO 8778, to which sonic conductances refer
MINERAL = Liquid(870.0, 1.5e9, 10.0, 46e-6, 0.0)  # without a grade
GradeName = Literal["HLP 32", "HLP 46", "HLP 68", "HVLP 32", "HVLP 46", "HVLP 68", "HEES 46", "HFC 46"]
# [K] at which the defaults hold; between which the law of viscosity holds
OF_CONSTANTS, COLDEST, HOTTEST = 313.15, 223.15, 423.15
MOST_RATIO = 5.0 / 3.0  # of c_p over c_v, of gases of one atom


class Fluid(Checked):
    """Constants of the law of density in `docs/hydraulics.md`, or a grade at a temperature.

    The defaults are those of a mineral oil at 40 °C.
    """

    collection: ClassVar[str] = "fluids"

    name: Name
    type: Literal["liquid"] = Field("need not be given", default="liquid", optional=True)
    grade: GradeName | None = Field("a fluid by name; values that are given override its own", default=None)
    temperature: ranges.Warmth = Field(
        "at which a `grade` has its constants, and that of the start", default=OF_CONSTANTS
    )
    density: Maybe[Density] = Field(
        "of the liquid at atmospheric pressure; default 870 kg/m³", default=None, usual=ranges.LIQUID_DENSITY
    )
    bulk_modulus: Maybe[coefficient.Pressure] = Field(
        "of the liquid at atmospheric pressure; default 1.5 GPa", default=None, usual=ranges.BULK_MODULUS
    )
    bulk_modulus_slope: Maybe[coefficient.NotNegativeNumber] = Field(
        "what it grows by with the pressure; default 10", default=None
    )
    air: Annotated[OneNumber, Quantity("number"), coefficient.NotNegative] = Field(
        "undissolved air: its share of the volume at atmospheric pressure", default=0.005
    )
    gas_exponent: coefficient.Exponent = Field("polytropic exponent of the air: 1.4 fast, 1 slow", default=1.4)
    dissolved_air: Annotated[OneNumber, Quantity("number"), coefficient.NotNegative] = Field(
        "volume at atmospheric pressure of the air that comes out below `saturation_pressure`", default=0.0
    )
    saturation_pressure: ranges.Level = Field("absolute, from which on that air is dissolved", default=101325.0)
    vapour_pressure: Maybe[coefficient.Pressure] = Field(
        "absolute, at which the liquid boils; default: only the air cavitates", default=None, usual=ranges.VAPOUR
    )
    viscosity: Maybe[coefficient.Viscosity] = Field("kinematic; default 46 mm²/s", default=None, usual=ranges.VISCOSITY)
    pressure_viscosity: Maybe[coefficient.NotNegativeNumber] = Field(
        "of lines: Barus's α in 1/Pa, with which the viscosity grows as exp(α p); default 0", default=None
    )

    isothermal: coefficient.Truth = Field(
        "whether it keeps its `temperature`; false: that of every volume is a state, of a `grade`", default=True
    )
    heat_capacity: Maybe[coefficient.HeatCapacity] = Field(
        "of a liquid that is not isothermal; default: that of its grade", default=None, usual=ranges.HEAT_CAPACITY
    )
    expansion: Maybe[coefficient.ThermalExpansion] = Field(
        "thermal one, of a liquid that is not isothermal; default: that of its grade",
        default=None,
        usual=ranges.EXPANSION,
    )
    surroundings: Maybe[ranges.Warmth] = Field(
        "temperature around walls of a liquid that is not isothermal; default 293.15 K", default=None
    )

    @property
    def liquid(self) -> Liquid:
        """What is given, then what the grade says, then the defaults."""
        base = MINERAL if self.grade is None else GRADES[self.grade].at(self.temperature)
        keys = [each.name for each in fields(Liquid)]
        return replace(base, **{key: getattr(self, key) for key in keys if getattr(self, key) is not None})

    @property
    def mixed_density(self) -> float:
        """[kg/m³] of liquid and air at atmospheric pressure."""
        return (1.0 - self.air) * self.liquid.density + self.air * AIR_DENSITY

    @property
    def least_pressure(self) -> float:
        """[Pa] at which it turns to vapour; of a liquid without air in any case, so that it bears no tension. 0: not at all."""
        return self.vapour_pressure or (LOW_VAPOUR if self.air < LEAST_AIR else 0.0)

    def problems(self) -> Iterator[Problem]:
        if self.grade is None and self.temperature != OF_CONSTANTS:
            yield superfluous(
                "temperature", "belongs to a `grade`, and none is given; the constants are those of this liquid"
            )
        if self.grade is not None and not COLDEST <= self.temperature <= HOTTEST:
            asked = f"a temperature from {COLDEST:g} to {HOTTEST:g} K was expected, got {self.temperature:g} K"
            yield Problem(("temperature",), f"{asked}; 20 °C are 293.15 K")
        if not self.isothermal and self.grade is None:
            told = "a liquid whose temperature changes needs a `grade`, which has its viscosity over the temperature"
            yield Problem(("isothermal",), f"{told}; write for example `grade: HLP 46`")
        if self.isothermal:
            for name in ("heat_capacity", "expansion", "surroundings"):
                if getattr(self, name) is not None:
                    yield superfluous(
                        name, "belongs to a liquid whose temperature changes; write `isothermal: false` too"
                    )
        if not (self.air == 0.0 or LEAST_AIR <= self.air <= MOST_AIR):
            asked = f"air from {LEAST_AIR:g} to {MOST_AIR:g} of the volume, or 0, was expected, got {self.air:g}"
            yield Problem(("air",), asked)
        if self.dissolved_air > MOST_AIR:
            yield Problem(
                ("dissolved_air",), f"up to {MOST_AIR:g} of the volume was expected, got {self.dissolved_air:g}"
            )
        if self.vapour_pressure is not None and self.vapour_pressure >= 0.5 * ATMOSPHERE:
            told = f"a pressure below 0.5 bar was expected, got {self.vapour_pressure:g} Pa"
            yield Problem(("vapour_pressure",), f"{told}; what boils at the air is no liquid")
        if self.bulk_modulus is not None and self.bulk_modulus < 1e7:
            yield Problem(
                ("bulk_modulus",), f"a liquid has a bulk modulus of about 1.5 GPa, got {self.bulk_modulus:g} Pa"
            )


class Gas(Checked):
    """An ideal gas. The defaults are those of air at the reference of ISO 8778: 1.185 kg/m³ at 20 °C and 1 bar."""

    collection: ClassVar[str] = "fluids"

    name: Name
    type: Literal["ideal-gas"] = "ideal-gas"
    density: Density = Field("at 20 °C and 1 bar", default=1.185, usual=ranges.GAS_DENSITY)
    heat_capacity_ratio: Annotated[OneNumber, Quantity("number")] = Field(
        "c_p over c_v, of gas whose temperature is a state", default=1.4
    )
    temperature: ranges.Warmth = Field("of tanks, of walls, and of all gas at the start", default=293.15)
    isothermal: coefficient.Truth = Field("whether the gas keeps that temperature", default=False)

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

ROOM = 293.15  # K
