"""A torsional shaft, or any spring and damper between two joint coordinates, with play."""

from __future__ import annotations

from typing import ClassVar, Literal

from nivel.machine.core.coefficient import (
    CoordinateDamping,
    CoordinateValue,
    NotNegativeValue,
    PositiveCoordinateStiffness,
)
from nivel.machine.core.element import OUTPUTS, Acts, Inequalities
from nivel.machine.forces.drive_line import DriveLine
from nivel.machine.given import Field


class Shaft(DriveLine):
    """Effort stiffness · twist + damping · rate, with twist = coordinate - ratio · against - free_value; none within the play."""

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "twist", "rate")

    inequalities: ClassVar[Inequalities] = tuple(
        Acts(
            ("is within its play", "is on a flank"),
            "twist",
            lambda own, of, way=way: way * of["twist"] - 0.5 * own.backlash,
            lambda own, of, way=way: of.part("magnitude", way),
            lambda own, of, way=way: way * of["rate"],
            applies=lambda own: own.backlash > 0.0,
        )
        for way in (1.0, -1.0)
    )

    type: Literal["shaft"] = "shaft"
    stiffness: PositiveCoordinateStiffness
    damping: CoordinateDamping = Field(default=0.0)
    free_value: CoordinateValue = Field(default=0.0, description="of the difference, where the effort is zero")
    backlash: NotNegativeValue = Field(default=0.0, description="play, from flank to flank")
