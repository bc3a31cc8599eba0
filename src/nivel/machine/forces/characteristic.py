"""Characteristics of springs: effort over deflection, straight lines between points and on beyond the last."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.core.coefficient import Angles, CoordinateEffort, CoordinateValue, Forces, Lengths, Torques
from nivel.machine.given import Field, ManyNumbers
from nivel.machine.units.quantity import listed


class Characteristic(Checked):
    """Points of a spring's characteristic; `deflections` increase, beyond the ends the end slopes go on."""

    column: ClassVar[str]  # the field that holds the efforts

    deflections: ManyNumbers[Any]

    @property
    def points(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Deflections [m or rad] and efforts [N or N m]."""
        return self.deflections, getattr(self, self.column)

    def problems(self) -> Iterator[Problem]:
        deflections, efforts = self.points
        if len(deflections) != len(efforts):
            counts = f"{len(efforts)} and {len(deflections)}"
            yield Problem((self.column,), f"a table needs as many {self.column} as deflections; got {counts}")
        if len(deflections) < 2:
            yield Problem(("deflections",), f"two or more deflections were expected, got {len(deflections)}")
        for at in range(1, len(deflections)):
            if deflections[at] <= deflections[at - 1]:
                before, here = f"{deflections[at - 1]:g}", f"{deflections[at]:g}"
                yield Problem(("deflections", at), f"deflections increase; {here} does not come after {before}")
                return


class ForceTable(Characteristic):
    """Force [N], tension positive, over the deflection `length - free_length` [m]."""

    column = "forces"

    deflections: Lengths = Field(description="length - free_length, increasing")
    forces: Forces = Field(description="of the spring, tension positive")


class TorqueTable(Characteristic):
    """Torque [N m] over the deflection `angle - free_angle` [rad]."""

    column = "torques"

    deflections: Angles = Field(description="angle - free_angle, increasing")
    torques: Torques = Field(description="with which the spring resists")


class EffortTable(Characteristic):
    """Effort [N or N m] over the deflection `coordinate - free_value` [m or rad]."""

    column = "efforts"

    deflections: Annotated[ManyNumbers[CoordinateValue], BeforeValidator(listed)] = Field(
        description="coordinate - free_value, increasing"
    )
    efforts: Annotated[ManyNumbers[CoordinateEffort], BeforeValidator(listed)] = Field(
        description="with which the spring resists"
    )
