"""Nodes of a circuit in words: volumes, tanks, accumulators, signals of load sensing."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import (
    Area,
    Exponent,
    HeatTransfer,
    NotNegativePressure,
    Pressure,
    Share,
    Temperature,
    ThermalConductance,
    Truth,
    VolumeFlow,
)
from nivel.machine.core.coefficient import Volume as VolumeSize
from nivel.machine.core.record import Name, entry
from nivel.machine.given import Field, ManyNames, Maybe, OneRecord
from nivel.machine.hydraulics.component import Component
from nivel.machine.hydraulics.maps import VolumeExpansion
from nivel.machine.hydraulics.usual import (
    DIFFERENCE,
    FLOW,
    HEAT_TRANSFER,
    LAG,
    PRESSURE,
    SURFACE,
    TANK_HEIGHT,
    TEMPERATURE,
    VOLUME,
    WALL_MODULUS,
)
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Duration, PositiveLength, listed

ATMOSPHERE = 101325.0  # Pa
ROOM = 293.15  # K
LEAST_NITROGEN, MOST_NITROGEN, COLD, HOT = 1e5, 4e7, 233.0, 423.0  # Pa, K: of the precharge of nitrogen
VaryingPressure = Annotated[OneFunction, varying("pressure")]
VaryingTemperature = Annotated[OneFunction, varying("temperature")]


class Volume(Component):
    """A volume of fluid at one pressure: a line, a hose, a block. What is connected to it meets there."""

    nodes: ClassVar[tuple[str, ...]] = ("",)
    early: ClassVar[tuple[str, ...]] = ("pressure",)
    gases: ClassVar[bool] = True

    type: Literal["volume"] = "volume"
    volume: VolumeSize = Field(usual=VOLUME)
    wall_modulus: Maybe[Pressure] = Field(
        default=None,
        description="pressure over the relative growth of the volume; default: rigid walls",
        usual=WALL_MODULUS,
    )
    expansion: Maybe[OneRecord[VolumeExpansion]] = Field(
        default=None, description="growth of the volume over the pressure, of a hose, in place of `wall_modulus`"
    )
    heat_conductance: Maybe[ThermalConductance] = Field(
        default=None,
        description="of gases, and of liquids that are not isothermal: heat through walls over the difference of temperature",
    )
    heat_transfer: Maybe[HeatTransfer] = Field(
        default=None,
        description="of gases: heat over a `surface` and the difference of temperature; not with `heat_conductance`",
        usual=HEAT_TRANSFER,
    )
    surface: Maybe[Area] = Field(default=None, description="of its walls, with `heat_transfer`", usual=SURFACE)
    start: Maybe[Pressure] = Field(
        default=None, description="pressure at the start; default: that of a steady circuit", usual=PRESSURE
    )
    fluid: Name | None = Field(default=None, description="default: the only one")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.surface is None and self.heat_transfer is not None:
            yield Problem((), "`surface` is missing: the area of the walls that `heat_transfer` is of")
        if self.surface is not None and self.heat_transfer is None:
            yield superfluous("surface", "belongs to a `heat_transfer`, and none is given")
        if self.heat_transfer is not None and self.heat_conductance is not None:
            yield superfluous("heat_conductance", "is `heat_transfer` times `surface`; give one of them")
        if self.expansion is not None and self.wall_modulus is not None:
            yield superfluous("wall_modulus", "is of walls that grow evenly; `expansion` is a curve; give one of them")


class Tank(Component):
    """A node of given pressure: a tank, or a supply that holds its pressure whatever flows, and its temperature."""

    nodes: ClassVar[tuple[str, ...]] = ("",)
    functions: ClassVar[tuple[str, ...]] = ("pressure", "temperature")
    early: ClassVar[tuple[str, ...]] = ("pressure",)
    gases: ClassVar[bool] = True

    type: Literal["tank"] = "tank"
    pressure: VaryingPressure = Field(default=ATMOSPHERE, description="absolute", usual=PRESSURE)
    temperature: Maybe[VaryingTemperature] = Field(
        default=None, description="of a liquid that is not isothermal; default: that of the fluid", usual=TEMPERATURE
    )
    fluid: Name | None = Field(default=None, description="default: the only one")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if isinstance(self.pressure, float | int) and self.pressure <= 0.0:
            told = f"pressures are absolute: one greater than zero was expected, got {self.pressure:g} Pa"
            yield Problem(("pressure",), f"{told}; the air has 1.01325 bar")


class Reservoir(Component):
    """A tank of liquid with a level, below air that is open to the atmosphere or closed in."""

    nodes: ClassVar[tuple[str, ...]] = ("",)
    early: ClassVar[tuple[str, ...]] = ("pressure", "level", "oil", "temperature")

    type: Literal["reservoir"] = "reservoir"
    volume: VolumeSize = Field(description="of liquid and air", usual=VOLUME)
    oil: VolumeSize = Field(description="volume of the liquid at the start", usual=VOLUME)
    height: Maybe[PositiveLength] = Field(
        default=None, description="of the tank, whose walls are upright; default: that of a cube", usual=TANK_HEIGHT
    )
    closed: Truth = Field(default=False, description="whether its air is closed in; else it comes and goes")
    start: Maybe[Pressure] = Field(
        default=None,
        description="pressure of the air at the start, absolute; default: that of the atmosphere",
        usual=PRESSURE,
    )
    gas_exponent: Maybe[Exponent] = Field(
        default=None, description="polytropic exponent of air that is closed in; default 1"
    )
    heat_conductance: Maybe[ThermalConductance] = Field(default=None, description="as of a volume")
    fluid: Name | None = Field(default=None, description="default: the only one")

    @property
    def pressure(self) -> float:
        """[Pa] of the air at the start."""
        return self.start or ATMOSPHERE

    @property
    def area(self) -> float:
        """[m²] of the surface of the liquid."""
        return self.volume / (self.height or self.volume ** (1.0 / 3.0))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not self.oil < self.volume:
            told = f"less than the `volume` of {self.volume:g} m^3 was expected, got {self.oil:g} m^3"
            yield Problem(("oil",), f"{told}; above the liquid is air")
        if not self.closed:
            for name in ("start", "gas_exponent"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "belongs to air that is closed in; write `closed: true` too")


class Accumulator(Component):
    """A volume with gas in it, behind an inlet."""

    needs: ClassVar[tuple[str, ...]] = ("A",)
    nodes: ClassVar[tuple[str, ...]] = ("",)
    early: ClassVar[tuple[str, ...]] = ("pressure",)
    late: ClassVar[tuple[str, ...]] = ("flow", "temperature")

    type: Literal["accumulator"] = "accumulator"
    volume: VolumeSize = Field(description="of the gas at its precharge", usual=VOLUME)
    precharge: Pressure = Field(description="pressure of the gas without oil, absolute", usual=PRESSURE)
    gas_exponent: Maybe[Exponent] = Field(
        default=None,
        description="polytropic exponent of the gas, default 1.3; with a `thermal_time` the adiabatic one, default 1.4",
    )
    thermal_time: Maybe[Duration] = Field(
        default=None, description="time constant with which the gas takes the temperature of its surroundings"
    )
    temperature: Temperature = Field(
        default=ROOM, description="of the surroundings, with a `thermal_time`", usual=TEMPERATURE
    )
    gas: Literal["ideal", "nitrogen"] = Field(
        default="ideal", description="with a `thermal_time` also `nitrogen` by its own equation of state"
    )
    piston_friction: NotNegativePressure = Field(
        default=0.0, description="difference of pressure that moves the piston between oil and gas", usual=DIFFERENCE
    )
    dead_volume: Maybe[VolumeSize] = Field(
        default=None, description="of oil when it is empty; default 2 % of the volume"
    )
    flow: VolumeFlow = Field(description="through the inlet at `pressure_drop`", usual=FLOW)
    pressure_drop: Pressure = Field(description="at which `flow` is measured", usual=DIFFERENCE)
    start: Maybe[Pressure] = Field(
        default=None, description="pressure at the start; default: that of a steady circuit", usual=PRESSURE
    )
    fluid: Name | None = Field(default=None, description="default: the only one")

    @property
    def exponent(self) -> float:
        """Of the law p Vⁿ of the gas."""
        return self.gas_exponent or (1.3 if self.thermal_time is None else 1.4)

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        warm = entry(data, "thermal_time") is not None
        return (*cls.early, *cls.late[: None if warm else 1])

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.gas == "nitrogen":
            if self.thermal_time is None:
                yield Problem(
                    ("gas",),
                    "nitrogen with its own equation of state needs a `thermal_time`, such as `thermal_time: 20 s`",
                )
            if self.gas_exponent is not None:
                yield superfluous("gas_exponent", "belongs to an ideal gas; nitrogen has its own equation of state")
            if not LEAST_NITROGEN <= self.precharge <= MOST_NITROGEN or not COLD <= self.temperature <= HOT:
                told = "the equation of nitrogen holds from 1 to 400 bar of precharge and from 233 to 423 K"
                yield Problem(("gas",), f"{told}, got {self.precharge:g} Pa at {self.temperature:g} K")
        if self.thermal_time is None and self.temperature != ROOM:
            yield superfluous("temperature", "belongs to a `thermal_time`, and none is given")
        if self.thermal_time is not None and self.exponent == 1.0:
            yield Problem(("gas_exponent",), "with a `thermal_time` an adiabatic exponent above 1 was expected, got 1")


class LoadSensing(Component):
    """A pressure signal: the highest load of several directional valves, of those that are open, with a lag."""

    nodes: ClassVar[tuple[str, ...]] = ("",)
    early: ClassVar[tuple[str, ...]] = ("pressure",)

    type: Literal["load-sensing"] = "load-sensing"
    valves: Annotated[ManyNames[Name], BeforeValidator(listed)] = Field(description="directional valves of 4/3 ways")
    lag: Duration = Field(default=0.01, description="time constant", usual=LAG)
    opens_within: Share = Field(default=0.05, description="opening of a valve at which its load is wholly sensed")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not self.valves:
            yield Problem(("valves",), "names of directional valves are needed, got none")
