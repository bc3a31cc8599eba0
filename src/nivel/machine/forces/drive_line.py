"""Elements of drive trains between two joint coordinates."""

from __future__ import annotations

from collections.abc import Iterator

from nivel.machine.core.checked import Problem
from nivel.machine.core.element import ForceElement
from nivel.machine.given import Field
from nivel.machine.units.quantity import Scalar
from nivel.machine.uses.coordinate_reference import CoordinateReference


class DriveLine(ForceElement):
    """What acts on the difference coordinate - ratio · against: an effort on the coordinate, and -ratio times it on the other one."""

    coordinate: CoordinateReference
    against: CoordinateReference = Field(description="the other joint coordinate")
    ratio: Scalar = Field(
        default=1.0, description="rate of `coordinate` per rate of `against` at which nothing slips or twists"
    )

    def problems(self) -> Iterator[Problem]:
        if self.ratio == 0.0:
            yield Problem(
                ("ratio",), "`ratio` is zero: the other coordinate has no part in it; a `brake` has one coordinate"
            )
