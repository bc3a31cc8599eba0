"""End stops of a joint coordinate."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import CoordinateValue, Exponent, Restitution
from nivel.machine.forces.element import OUTPUTS, Acts, ForceElement, Inequalities
from nivel.machine.given import Field, Maybe
from nivel.machine.power_stiffness import PowerStiffness
from nivel.machine.uses.coordinate_reference import CoordinateReference


class Stop(ForceElement):
    """A coordinate is pushed back where it passes `lower` or `upper`: effort stiffness · depth ** exponent, damped."""

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "depth")

    inequalities: ClassVar[Inequalities] = (
        Acts(
            ("is free of its lower end", "touches its lower end"),
            "coordinate",
            lambda own, of: own.lower - of.value(own.coordinate),
            lambda own, of: of.part("magnitude", 1.0),
            lambda own, of: -of.rate(own.coordinate),
            applies=lambda own: own.lower is not None,
        ),
        Acts(
            ("is free of its upper end", "touches its upper end"),
            "coordinate",
            lambda own, of: of.value(own.coordinate) - own.upper,
            lambda own, of: of.part("magnitude", -1.0),
            lambda own, of: of.rate(own.coordinate),
            applies=lambda own: own.upper is not None,
        ),
    )

    type: Literal["stop"] = "stop"
    coordinate: CoordinateReference
    lower: Maybe[CoordinateValue] = Field(default=None, description="end of the way on the negative side")
    upper: Maybe[CoordinateValue] = Field(default=None, description="end of the way on the positive side")
    exponent: Exponent = Field(default=1.0, description="of the depth")
    stiffness: PowerStiffness
    restitution: Restitution = Field(description="speed after the impact by the speed before it; 1 loses no energy")

    def problems(self) -> Iterator[Problem]:
        if self.lower is None and self.upper is None:
            yield Problem((), "`lower` or `upper` is missing: a stop needs one end of the way, or both")
        if self.lower is not None and self.upper is not None and self.lower >= self.upper:
            yield Problem(("upper",), f"`upper` {self.upper:g} must be greater than `lower` {self.lower:g}")
