"""Coolers in words."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from nivel.machine.given import Field
from nivel.machine.hydraulics.component import Rated
from nivel.machine.hydraulics.nodes import ROOM, VaryingTemperature
from nivel.machine.hydraulics.usual import TEMPERATURE
from nivel.machine.laws.time_function import OneFunction, varying

VaryingConductance = Annotated[OneFunction, varying("thermal conductance")]


class Cooler(Rated):
    """A restriction that gives heat of a liquid to air or water of a given temperature."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    functions: ClassVar[tuple[str, ...]] = ("heat_conductance", "coolant_temperature")
    late: ClassVar[tuple[str, ...]] = ("flow", "heat")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))

    type: Literal["cooler"] = "cooler"
    heat_conductance: VaryingConductance = Field(
        description="heat over the difference of temperature, of coolant and liquid at the same place"
    )
    coolant_temperature: VaryingTemperature = Field(default=ROOM, usual=TEMPERATURE)
