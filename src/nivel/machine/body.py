"""A rigid body in words."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field, ValidationError, model_validator
from pydantic_core import InitErrorDetails

from nivel.machine.inertia import InertiaTensor, impossible, mass_properties
from nivel.machine.orientation import Orientation
from nivel.machine.quantity import AngularVelocityVector, Density, Mass, Position, VelocityVector, fault
from nivel.machine.record import GROUND, Name, Record
from nivel.machine.shape import Shape, Sphere


class Body(Record):
    """A rigid body. Its frame may be anywhere; the centre of mass is given in it.

    It has mass and inertia, or a shape and a density, or a shape and a mass.
    """

    collection: ClassVar[str] = "bodies"
    tagged = {"shape": 1}  # noqa: RUF012

    name: Name
    mass: Mass | None = None
    centre_of_mass: Position | None = Field(
        default=None, description="in the body frame; default the origin, or the shape's centre"
    )
    inertia: InertiaTensor | None = Field(
        default=None, description="body axes: [xx, yy, zz], {xx, yy, zz, xy, xz, yz} or 3×3 matrix"
    )
    inertia_about: Literal["centre-of-mass", "origin"] = "centre-of-mass"
    position: Position | None = Field(
        default=None, description="of the body frame's origin, global; default the global origin"
    )
    orientation: Orientation | None = Field(default=None, description="of the body frame; default not turned")
    velocity: VelocityVector = Field(default=(0.0, 0.0, 0.0), description="of the body frame's origin, global axes")
    angular_velocity: AngularVelocityVector | None = Field(default=None, description="global axes")
    angular_velocity_body: AngularVelocityVector | None = Field(default=None, description="body axes")
    shape: Shape | None = None
    density: Density | None = None

    @model_validator(mode="after")
    def _makes_sense(self) -> Body:
        if self.name == GROUND:
            raise fault(f"`{GROUND}` is the fixed world and cannot be a body")
        self._check_sources_of_inertia()
        if self.angular_velocity is not None and self.angular_velocity_body is not None:
            raise fault("give `angular_velocity` (global axes) or `angular_velocity_body` (body axes), not both")
        self._check_placement()
        if self.inertia is not None:
            why = impossible(mass_properties(self).inertia)
            if why:
                shifted = " about the centre of mass" if self.inertia_about == "origin" else ""
                raise _at("inertia", f"`inertia`{shifted}: {why}")
        return self

    def _check_sources_of_inertia(self) -> None:
        if self.density is not None:
            if self.shape is None:
                raise fault("`density` needs a `shape`")
            for name in ("mass", "centre_of_mass", "inertia"):
                if getattr(self, name) is not None:
                    raise _at(name, f"`{name}` follows from `shape` and `density` and must not be given")
        elif self.mass is None:
            raise fault("`mass` is missing: give `mass` and `inertia`, or `shape` with `density` or `mass`")
        elif self.inertia is None:
            if self.shape is None:
                raise fault("`inertia` is missing: give `inertia` or a `shape` to compute it from")
            if self.centre_of_mass is not None:
                raise fault("`centre_of_mass` follows from `shape`; give `inertia` as well, or remove it")
        if self.inertia is None and self.inertia_about == "origin":
            raise fault("`inertia_about` belongs to an `inertia`, and none is given")

    def _check_placement(self) -> None:
        if self.shape is None or isinstance(self.shape, Sphere) or self.shape.from_ is None:
            return
        for name in ("position", "orientation"):
            if getattr(self, name) is not None:
                raise fault(f"`{name}` follows from the shape's `from` and `to` and must not be given")


def _at(field: str, message: str) -> ValidationError:
    """A fault of one field that shows only when others are known."""
    return ValidationError.from_exception_data(
        Body.__name__, [InitErrorDetails(type=fault(message), loc=(field,), input=None)]
    )
