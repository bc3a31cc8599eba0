"""Forces and torques on bodies in words."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field, model_validator

from nivel.machine.quantity import Position, fault, listed
from nivel.machine.record import GROUND, Name, Record
from nivel.machine.time_function import ForceComponent, TorqueComponent

Axes = Annotated[Literal["global", "body"], Field(description="axes of the vector: global, or turning with the body")]


class PointForce(Record):
    """A force on a point of a body: `body` and `position`, or a `marker`."""

    collection: ClassVar[str] = "forces"

    name: Name
    type: Literal["force"] = "force"
    body: Name | None = None
    position: Position | None = Field(default=None, description="of the point, in the body frame; default the origin")
    marker: Name | None = Field(default=None, description="the point, in place of `body` and `position`")
    vector: Annotated[tuple[ForceComponent, ForceComponent, ForceComponent], BeforeValidator(listed)]
    axes: Axes = "global"

    @model_validator(mode="after")
    def _one_point(self) -> PointForce:
        if self.marker is None and self.body is None:
            raise fault("a force needs a `body` (and `position`) or a `marker`")
        if self.marker is not None and (self.body is not None or self.position is not None):
            word = "body" if self.body is not None else "position"
            raise fault(f"`{word}` must not be given with `marker`, which says where the force acts")
        if self.body == GROUND:
            raise fault(f"a force on `{GROUND}` moves nothing")
        return self


class Torque(Record):
    """A pure torque on a body."""

    collection: ClassVar[str] = "forces"

    name: Name
    type: Literal["torque"] = "torque"
    body: Name
    vector: Annotated[tuple[TorqueComponent, TorqueComponent, TorqueComponent], BeforeValidator(listed)]
    axes: Axes = "global"

    @model_validator(mode="after")
    def _on_a_body(self) -> Torque:
        if self.body == GROUND:
            raise fault(f"a torque on `{GROUND}` moves nothing")
        return self


Force = Annotated[PointForce | Torque, Field(discriminator="type")]
