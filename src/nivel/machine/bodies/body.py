"""A rigid or flexible body, or a point mass, in words."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, ClassVar, Final, Literal

from pydantic import BeforeValidator

from nivel.machine.bodies.inertia import InertiaTensor, impossible, mass_properties
from nivel.machine.bodies.shape import Mesh, Shape, Sphere, Standing
from nivel.machine.bodies.solids import volume, why_not_solid
from nivel.machine.core.coefficient import PositiveNumber, Truth
from nivel.machine.core.orientation import Orientation
from nivel.machine.core.record import GROUND, Checked, Name, Problem, Record, superfluous
from nivel.machine.given import ANGULAR_SPEED, DENSITY, SPEED, Field, Given, ManyRecords, Maybe, OneRecord, Usual
from nivel.machine.units.quantity import (
    AngularVelocityVector,
    Density,
    Mass,
    Position,
    Real,
    VelocityVector,
    Whole,
    fault,
    listed,
    shown,
)

Invariant = Literal["I5", "I8", "I9"]


def _distinct(values: Any) -> Any:
    """A list without repetition; one name stands for a list of it."""
    values = [values] if isinstance(values, str) else values
    if isinstance(values, list | tuple) and len({str(value) for value in values}) < len(values):
        raise fault(f"each name at most once was expected, got {shown(values)}")
    return values


class Flexibility(Record):
    """A body that bends by the modes in a file of `nivel reduce`."""

    file: str = Field("file of `nivel reduce`, relative to the machine file", min_length=1)
    modes: Annotated[Whole, Field(ge=1)] | None = Field("how many, lowest first; default all", default=None)
    damping_ratio: Annotated[Real, Field(ge=0.0, lt=1.0)] = Field("of each mode", default=0.0)
    neglect: Annotated[
        Given[tuple[Invariant, ...], tuple[Invariant, ...], Invariant | Sequence[Invariant]], BeforeValidator(_distinct)
    ] = Field("inertia invariants that the moving body does without: I5, I8, I9", default=())


def _file_or_mapping(value: Any) -> Any:
    if isinstance(value, str):
        return {"file": value}
    if isinstance(value, Mapping | Flexibility):
        return value
    raise fault(f"a file of `nivel reduce`, or a mapping with `file`, was expected, got {shown(value)}")


FlexibleBody = Annotated[
    Given[Flexibility, Flexibility, str | Mapping[str, Any] | Flexibility], BeforeValidator(_file_or_mapping)
]


LIGHTEST: Final = 1e-2  # [kg/m³] mean density below which a unit must have slipped: a hundredth of that of air
DENSEST: Final = 1e5  # [kg/m³] and above which: four times that of the densest metal
LIGHTEST_BODY: Final = 1e-40  # [kg] squares of inertias of lighter bodies leave the range of numbers

_OF_A_RIGID_BODY: Final = (
    "centre_of_mass",
    "inertia",
    "orientation",
    "angular_velocity",
    "angular_velocity_body",
    "density",
    "flexible",
)


class Body(Checked):
    """A rigid body. Its frame may be anywhere; the centre of mass is given in it.

    It has mass and inertia, or a shape and a density, or a shape and a mass. A point mass has a mass alone, a flexible body the file of
    its modes.
    """

    collection: ClassVar[str] = "bodies"
    tagged = {"shape": 1, "looks": 2}  # noqa: RUF012
    usual: ClassVar[Mapping[str, Usual]] = {"velocity": SPEED, "angular_velocity": ANGULAR_SPEED}  # of its results

    name: Name
    mass: Maybe[Mass] = Field(default=None)
    centre_of_mass: Maybe[Position] = Field(
        "in the body frame; default the origin, or the shape's centre", default=None
    )
    inertia: Maybe[InertiaTensor] = Field(
        "body axes: [xx, yy, zz], {xx, yy, zz, xy, xz, yz} or 3×3 matrix", default=None
    )
    inertia_about: Literal["centre-of-mass", "origin"] = "centre-of-mass"
    position: Maybe[Position] = Field("of the body frame's origin, global; default the global origin", default=None)
    orientation: Maybe[OneRecord[Orientation]] = Field("of the body frame; default not turned", default=None)
    velocity: VelocityVector = Field("of the body frame's origin, global axes", default=(0.0, 0.0, 0.0), usual=SPEED)
    angular_velocity: Maybe[AngularVelocityVector] = Field("global axes", default=None, usual=ANGULAR_SPEED)
    angular_velocity_body: Maybe[AngularVelocityVector] = Field("body axes", default=None, usual=ANGULAR_SPEED)
    shape: Maybe[OneRecord[Shape]] = Field(default=None)
    looks: Annotated[ManyRecords[Shape], BeforeValidator(listed)] = Field(
        "further solids that are drawn, in the body frame; they have no mass and touch nothing", default=()
    )
    density: Maybe[Density] = Field(default=None, usual=DENSITY)
    flexible: Maybe[FlexibleBody] = Field("modes by which it bends; its mass is in their file", default=None)
    point_mass: Truth = Field("a mass at a point, which does not turn", default=False)
    hold: Truth = Field("the assembly does not move it", default=False)
    assembly_weight: PositiveNumber = Field(
        "weight of its displacement in the assembly; a larger weight is moved less", default=1.0
    )

    def problems(self) -> Iterator[Problem]:
        if self.name == GROUND:
            yield Problem((), f"`{GROUND}` is the fixed world and cannot be a body")
        if self.mass is not None and self.mass < LIGHTEST_BODY:
            yield Problem(("mass",), f"a mass of {self.mass:.3g} kg: a slip of a unit?")
        yield from self._problems_of_looks()
        if self.point_mass:
            yield from self._problems_of_point_mass()
            return
        if self.flexible is not None:
            yield from self._problems_of_flexible()
        else:
            yield from self._problems_of_inertia()
        if self.angular_velocity is not None and self.angular_velocity_body is not None:
            yield Problem((), "give `angular_velocity` (global axes) or `angular_velocity_body` (body axes), not both")
        if self.shape is not None and not isinstance(self.shape, Standing) and self.shape.from_ is not None:
            for name in ("position", "orientation"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "follows from the shape's `from` and `to` and must not be given")
        yield from self._problems_of_density()

    def _problems_of_looks(self) -> Iterator[Problem]:
        for k, each in enumerate(self.looks):
            if not isinstance(each, Standing) and each.from_ is not None:
                yield Problem(
                    ("looks", k), "`looks` stand in the body frame, at their `centre`: `from` and `to` are global"
                )

    def _problems_of_point_mass(self) -> Iterator[Problem]:
        if self.mass is None:
            yield Problem((), "`mass` is missing: a point mass is given by its `mass`")
        for name in _OF_A_RIGID_BODY:
            if getattr(self, name) is not None:
                yield superfluous(name, "does not belong to a point mass, which has a `mass` at its origin and no turn")
        if self.inertia_about == "origin":
            yield superfluous("inertia_about", "does not belong to a point mass, which has no inertia")
        if self.shape is not None and not isinstance(self.shape, Sphere):
            yield Problem(("shape",), f"a point mass is drawn as a sphere, not as a {self.shape.type}")
        elif self.shape is not None and self.shape.centre is not None and any(self.shape.centre):
            yield Problem(("shape", "centre"), "the sphere of a point mass has its centre at the mass")

    def _problems_of_flexible(self) -> Iterator[Problem]:
        for name in ("mass", "centre_of_mass", "inertia", "density"):
            if getattr(self, name) is not None:
                yield superfluous(name, "is known from the file of the flexible body and must not be given")
        if self.inertia_about == "origin":
            yield superfluous("inertia_about", "does not belong to a flexible body, whose inertia is in its file")
        shape = self.shape
        if isinstance(shape, Mesh) or (
            shape is not None and not isinstance(shape, Standing) and shape.from_ is not None
        ):
            message = (
                "a flexible body is drawn from its file; its `shape` is what touches in a contact, a solid about a `centre` that is at an "
                "interface"
            )
            yield Problem(("shape",), message)

    def _problems_of_inertia(self) -> Iterator[Problem]:
        if self.density is not None:
            if self.shape is None:
                yield Problem(("density",), "`density` needs a `shape`")
            else:
                for name in ("mass", "centre_of_mass", "inertia"):
                    if getattr(self, name) is not None:
                        yield superfluous(name, "follows from `shape` and `density` and must not be given")
        elif self.mass is None:
            yield Problem((), "`mass` is missing: give `mass` and `inertia`, or `shape` with `density` or `mass`")
        elif self.inertia is None and self.shape is None:
            yield Problem((), "`inertia` is missing: give `inertia` or a `shape` to compute it from")
        elif self.inertia is None and self.centre_of_mass is not None:
            message = "`centre_of_mass` follows from `shape`; give `inertia` as well, or remove it"
            yield Problem(("centre_of_mass",), message, at_key=True)
        if self.inertia is None and self.inertia_about == "origin":
            yield superfluous("inertia_about", "belongs to an `inertia`, and none is given")
        if self.inertia is not None and self.mass is not None:
            why = impossible(mass_properties(self).inertia)
            shifted = " about the centre of mass" if self.inertia_about == "origin" else ""
            if why:
                yield Problem(("inertia",), f"`inertia`{shifted}: {why}")

    def _problems_of_density(self) -> Iterator[Problem]:
        if self.density is not None and not LIGHTEST <= self.density <= DENSEST:
            yield Problem(("density",), f"a density of {self.density:.3g} kg/m^3: a slip of a unit?")
        if isinstance(self.shape, Mesh):
            why = why_not_solid(self.shape)
            if why and self.inertia is None:
                yield Problem(("shape",), f"{why}; close it, or give `mass` and `inertia`")
            if why:
                return
        if self.shape is not None and self.density is not None and self.density * volume(self.shape) < LIGHTEST_BODY:
            mass = self.density * volume(self.shape)
            yield Problem(("shape",), f"with this density its mass is {mass:.3g} kg: a slip of a unit?")
        if self.shape is None or self.mass is None or self.density is not None:
            return
        if self.inertia is not None:  # the shape is for looks only
            return
        mean = self.mass / volume(self.shape)
        if not LIGHTEST <= mean <= DENSEST:
            message = f"a mass of {self.mass:.6g} kg with this shape gives a density of {mean:.3g} kg/m^3"
            yield Problem(("mass",), f"{message}: a slip of a unit?")
