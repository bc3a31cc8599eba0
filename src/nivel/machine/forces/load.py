"""Forces and torques on one body, with no counter-force."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.element import ForceElement
from nivel.machine.core.record import GROUND, BodyName, Name
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.time_function import ForceComponent, ThreeFunctions, TorqueComponent
from nivel.machine.units.quantity import Position, listed

Axes = Annotated[Literal["global", "body"], Field(description="axes of the vector: global, or turning with the body")]


class PointForce(ForceElement):
    """A force on a point of a body: `body` and `position`, or a `marker`."""

    stiff: ClassVar[bool] = False

    type: Literal["force"] = "force"
    body: BodyName | None = None
    position: Maybe[Position] = Field(default=None, description="of the point, in the body frame; default the origin")
    marker: Name | None = Field(default=None, description="the point, in place of `body` and `position`")
    vector: Annotated[ThreeFunctions[ForceComponent], BeforeValidator(listed)]
    axes: Axes = "global"

    def problems(self) -> Iterator[Problem]:
        if self.marker is None and self.body is None:
            yield Problem((), "a force needs a `body` (and `position`) or a `marker`")
        for name in ("body", "position"):
            if self.marker is not None and getattr(self, name) is not None:
                yield superfluous(name, "must not be given with `marker`, which says where the force acts")
        if self.body == GROUND:
            yield Problem(("body",), f"a force on `{GROUND}` moves nothing")


class Torque(ForceElement):
    """A pure torque on a body."""

    turns: ClassVar[bool] = True
    stiff: ClassVar[bool] = False

    type: Literal["torque"] = "torque"
    body: BodyName
    vector: Annotated[ThreeFunctions[TorqueComponent], BeforeValidator(listed)]
    axes: Axes = "global"

    def problems(self) -> Iterator[Problem]:
        if self.body == GROUND:
            yield Problem(("body",), f"a torque on `{GROUND}` moves nothing")
