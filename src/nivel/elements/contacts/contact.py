"""Records of contacts: of a body with a plane, of two bodies, and of many spheres."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Final, Literal

from pydantic import BeforeValidator

from nivel.elements.contacts.height_field import HeightField
from nivel.elements.facts import Output, of_force
from nivel.machine.core import coefficient
from nivel.machine.core.element import Acts, ForceElement, Holds, Inequalities, ManyMarkers, MarkerPlace
from nivel.machine.core.record import GROUND, BodyName, Problem, Record, superfluous
from nivel.machine.given import Field, Given, ManyNames, Maybe, OneRecord, TwoNames, TwoNumbers, TwoRecords
from nivel.machine.laws.time_function import ContactForce, SurfaceSpin, SurfaceVelocity, ThreeFunctions
from nivel.machine.power_stiffness import PowerStiffness
from nivel.machine.units.quantity import PositiveLength, Whole, listed

HERTZ: Final = 1.5  # exponent of two elastic spheres
FrictionWord = Literal["stiction", "coulomb"]
FrictionModel = Given[FrictionWord, FrictionWord, FrictionWord]
FRICTION_MODELS: Final = (
    "stiction sticks; with coulomb friction goes as tanh(sliding speed / friction_transition_speed), so bodies creep; "
    "default coulomb where a friction_transition_speed is given, else stiction"
)
HEAT: Final = Output("friction_power", "W", "power that friction turns to heat")
WORK: Final = Output("friction_work", "J", "work of friction that became heat since the start")  # where it is asked for


def friction_model_of(contact: Any) -> FrictionWord:
    """The `friction_model` of a `contact` or of `contacts`: as given; else coulomb where its transition speed is given, as in files that
    were written before contacts could stick, and stiction where none is.
    """
    return contact.friction_model or ("stiction" if contact.friction_transition_speed is None else "coulomb")


class Material(Record):
    """An elastic material."""

    _spellings: ClassVar[Mapping[str, str]] = {"young_modulus": "youngs_modulus"}

    youngs_modulus: coefficient.Pressure
    poisson_ratio: coefficient.PoissonRatio


class Contact(ForceElement):
    """Bodies that touch are pushed apart: force stiffness · depth ** exponent, damped, or by a `law`; with Coulomb friction.

    A `body` with the shape sphere, capsule, ellipsoid, box, cylinder, extrusion or mesh on a `plane`; two `bodies`, of which one is a
    sphere, a capsule or an ellipsoid, at the nearest points; or two `bodies` of the shapes box, cylinder, extrusion and mesh, which touch
    with their convex hulls and press by `foundation_modulus` · depth on every point of the area where they touch.
    """

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force(),
        Output("depth", "m", "deepest overlap"),
        Output("normal_force", "N", "normal force"),
        Output("rate", "m/s", "rate of the deepest overlap"),
        Output("friction_force", "N", "friction force"),
        Output("slip_speed", "m/s", "sliding speed"),
        HEAT,
        Output("surface_power", "W", "power of the moving surface"),
        Output("sticks", "1", "1 where friction holds, else 0"),
        *(Output(axis, "m", f"{axis} of the middle of the normal forces; 0 without contact") for axis in "xyz"),
        *(Output(f"normal_{axis}", "1", f"{axis} of the normal towards the first body") for axis in "xyz"),
        *(Output(f"friction_{axis}", "N", f"friction on the first body along {axis}") for axis in "xyz"),
        WORK,
    )

    inequalities: ClassVar[Inequalities] = (
        Acts(
            ("is apart", "touches"),
            "depth",
            lambda own, of: of["depth"],
            lambda own, of: of["normal_force"],
            lambda own, of: of["rate"],
            # a law may be zero
            always=lambda own: own.law is None,
        ),
        Holds(
            "slip_speed",
            lambda own, of: of["friction_force"],
            lambda own, of: own.static * of["normal_force"],
            # where it spins it slides with less
            lambda own, of: own.static * of["normal_force"] * of["sticks"],
            lambda own, of: of["slip_speed"],
            applies=lambda own: own.friction > 0.0,
        ),
    )

    type: Literal["contact"] = "contact"
    body: BodyName | None = Field(
        "that touches the `plane`; its shape is sphere, capsule, ellipsoid, box, cylinder, extrusion or mesh",
        default=None,
    )
    plane: Maybe[MarkerPlace] = Field(
        "a marker: its point lies in the plane, its z axis points out of it", default=None
    )
    heights: Maybe[OneRecord[HeightField]] = Field(
        "of ground that is not flat, along the z axis of the `plane` over its x and y axes", default=None
    )
    bodies: Maybe[TwoNames[BodyName]] = Field("two bodies with a shape, in place of `body` and `plane`", default=None)
    parts: Maybe[TwoNumbers[Whole]] = Field(
        "numbers of the convex parts of both `bodies`, from 1; filled where a mesh has `convex_parts`", default=None
    )
    exponent: coefficient.Exponent = Field("of the depth", default=HERTZ)
    stiffness: Maybe[PowerStiffness] = Field("force by depth ** exponent", default=None)
    materials: Maybe[TwoRecords[Material]] = Field(
        "of the first body and the second or the plane; for spheres, in place of `stiffness`", default=None
    )
    foundation_modulus: Maybe[coefficient.FoundationModulus] = Field(
        "pressure by depth where two bodies of the shapes box, cylinder, extrusion and mesh touch, in place of `stiffness`",
        default=None,
    )
    damping: Maybe[coefficient.DampingPerLoad] = Field(
        "the force, or the pressure of a `foundation_modulus`, is times 1 + damping · speed of approach; 0 loses no energy",
        default=None,
    )
    restitution: Maybe[coefficient.Restitution] = Field(
        "speed after the impact by the speed before it; 1 loses no energy", default=None
    )
    law: Maybe[ContactForce] = Field(
        "the normal force at a point that touches, in place of `stiffness` and `restitution`; may use `depth` and `rate`",
        default=None,
    )
    friction: coefficient.NotNegativeNumber = Field("coefficient of kinetic friction", default=0.0)
    static_friction: Maybe[coefficient.PositiveNumber] = Field("coefficient, default `friction`", default=None)
    friction_model: Maybe[FrictionModel] = Field(FRICTION_MODELS, default=None)
    friction_transition_speed: Maybe[coefficient.PositiveSpeed] = Field(
        "of `friction_model: coulomb`; stiction makes no use of it in motion", default=None
    )
    rolling_resistance: coefficient.NotNegativeLength = Field(
        "lever arm b of a moment up to b · normal force that brakes rolling", default=0.0
    )
    patch_radius: Maybe[PositiveLength] = Field(
        "of an evenly pressed disc whose friction brakes spinning, by up to friction · normal force · 2/3 of it",
        default=None,
        absent="by the points that touch; none of a single one",
    )
    friction_work: bool = Field(
        "the heat of friction since the start is an output too, and a state of the run", default=False
    )

    surface_velocity: Maybe[Annotated[ThreeFunctions[SurfaceVelocity], BeforeValidator(listed)]] = Field(
        "of the surface of the plane, along the axes of its marker, or of the second body, along its axes, over this body",
        default=None,
    )
    surface_spin: Maybe[SurfaceSpin] = Field(
        "of the surface of the plane about the z axis through the point of its marker", default=None
    )

    def problems(self) -> Iterator[Problem]:
        yield from self._problems_of_partners()
        yield from self._problems_of_friction()
        if self.foundation_modulus is not None:
            yield from self._problems_of_foundation()
        else:
            yield from self._problems_of_law() if self.law is not None else self._problems_of_stiffness()

    @property
    def static(self) -> float:
        """Coefficient of static friction."""
        return self.friction if self.static_friction is None else self.static_friction

    @property
    def sticks(self) -> bool:
        """Whether friction can hold the bodies at rest."""
        return self.friction > 0 and friction_model_of(self) == "stiction"

    def _problems_of_friction(self) -> Iterator[Problem]:
        if self.static < self.friction:
            message = f"`static_friction` {self.static:g} is smaller than `friction` {self.friction:g}"
            yield Problem(("static_friction",), f"{message}; static friction is at least as strong as kinetic")
        if self.static_friction is not None and not self.friction:
            yield Problem(
                (), "`friction` is missing, the coefficient of kinetic friction: bodies that slide would have none"
            )
        if self.friction > 0 and not self.sticks and self.friction_transition_speed is None:
            yield Problem((), "`friction_transition_speed` is missing: below it friction lets the bodies creep")
        moving = [name for name in ("surface_velocity", "surface_spin") if getattr(self, name) is not None]
        if moving and not self.friction:
            yield Problem((moving[0],), f"`{moving[0]}` acts by `friction`, and none is given")
        if self.surface_spin is not None and self.bodies is not None:
            yield superfluous("surface_spin", "belongs to a `plane`; a body that turns has a joint and a driver")
        if self.friction_work and not self.friction:
            yield superfluous("friction_work", "belongs to `friction`, and none is given")
        for name in ("static_friction", "rolling_resistance", "patch_radius"):
            if getattr(self, name) and not self.sticks and (name != "static_friction" or self.static > self.friction):
                yield superfluous(name, "belongs to `friction` with `friction_model: stiction`")

    def _problems_of_foundation(self) -> Iterator[Problem]:
        if self.bodies is None:
            yield superfluous("foundation_modulus", "is for two `bodies`; on a plane give the `stiffness` of a corner")
        for name in ("stiffness", "materials", "law"):
            if getattr(self, name) is not None:
                yield superfluous(name, "stands in place of `foundation_modulus`; give one of them")
        if self.exponent != HERTZ:
            yield superfluous(
                "exponent", "must not be given with a `foundation_modulus`, whose pressure goes as the depth"
            )
        if self.restitution is not None:
            yield superfluous(
                "restitution", "must not be given with a `foundation_modulus`: give `damping`, as in `damping: 1 s/m`"
            )
        if self.damping is None:
            message = "`damping` is missing: with 1 s/m an impact at 1 m/s leaves with 0.59 m/s; 0 loses no energy"
            yield Problem((), message)

    def _problems_of_law(self) -> Iterator[Problem]:
        for name in ("stiffness", "materials", "restitution", "damping"):
            if getattr(self, name) is not None:
                yield superfluous(name, "must not be given with a `law`, which is the whole normal force")
        if self.exponent != HERTZ:
            yield superfluous("exponent", "must not be given with a `law`, which is the whole normal force")

    def _problems_of_stiffness(self) -> Iterator[Problem]:
        if self.restitution is None and self.damping is None:
            message = "`restitution` is missing: a number above 0 and up to 1, which is 1 where no energy is lost; or `damping: 1 s/m`"
            yield Problem((), message)
        if self.restitution is not None and self.damping is not None:
            yield superfluous("damping", "stands in place of `restitution`; give one of them")
        if self.stiffness is None and self.materials is None:
            message = "`stiffness` is missing: a contact needs a `stiffness`, a `law` or, of spheres, two `materials`"
            hulls = "; two boxes, cylinders, extrusions or meshes need a `foundation_modulus`, as in `foundation_modulus: 1e10 N/m^3`"
            yield Problem((), message + (hulls if self.bodies is not None else ""))
        if self.stiffness is not None and self.materials is not None:
            yield superfluous("materials", "stands in place of `stiffness`; give one of them")
        if self.materials is not None and self.exponent != HERTZ:
            yield superfluous("exponent", f"is {HERTZ:g} with `materials` (Hertz) and must not be given")

    def _problems_of_partners(self) -> Iterator[Problem]:
        if self.bodies is not None:
            for name in ("body", "plane", "heights"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "must not be given with `bodies`, which touch each other")
            if self.bodies[0] == self.bodies[1]:
                yield Problem(("bodies",), f"two different bodies are needed, got `{self.bodies[0]}` twice")
        elif self.parts is not None:
            yield superfluous("parts", "belongs to two `bodies`")
        elif self.body is None or self.plane is None:
            yield Problem((), "a contact needs a `body` and a `plane`, or two `bodies`")
        for place, body in (
            (("body",), self.body),
            *((("bodies", at), each) for at, each in enumerate(self.bodies or ())),
        ):
            if body == GROUND:
                message = f"`{GROUND}` has no shape; the contact with it is a `plane` on a marker, or a body with a `fixed` joint"
                yield Problem(place, message)


ALL = "all"
# of friction that sticks: efforts of all pairs are found together
MOST_PAIRS: Final = 120


def _all_or_names(value: Any) -> Any:
    return () if isinstance(value, str) and value == ALL else listed(value)


class Contacts(ForceElement):
    """Spheres that push each other and planes apart: force stiffness · depth ** exponent, damped; with Coulomb friction that creeps."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force(),
        Output("depth", "m", "deepest overlap"),
        Output("normal_force", "N", "sum of the normal forces"),
        Output("friction_force", "N", "sum of the friction forces"),
        HEAT,
        Output("count", "1", "number of pairs that touch"),
        WORK,
    )

    inequalities: ClassVar[Inequalities] = (
        Acts(("is apart", "touches"), "depth", lambda own, of: of["depth"], lambda own, of: of["normal_force"]),
    )

    type: Literal["contacts"] = "contacts"
    between: Annotated[ManyNames[BodyName], BeforeValidator(_all_or_names)] = Field(
        "`all` bodies whose shape is a sphere, or the names of some: each touches each other"
    )
    planes: Annotated[ManyMarkers, BeforeValidator(listed)] = Field(
        "markers: all bodies touch them too, on the side of the z axis", default=()
    )
    exponent: coefficient.Exponent = Field("of the depth", default=HERTZ)
    stiffness: PowerStiffness = Field("force by depth ** exponent")
    restitution: coefficient.Restitution = Field("speed after the impact by the speed before it; 1 loses no energy")
    friction: coefficient.NotNegativeNumber = Field("coefficient of kinetic friction", default=0.0)
    static_friction: Maybe[coefficient.PositiveNumber] = Field(
        "of stiction: coefficient, default `friction`", default=None
    )
    friction_model: Maybe[FrictionModel] = Field(
        f"{FRICTION_MODELS}; stiction is for at most {MOST_PAIRS} pairs, which become single contacts", default=None
    )
    friction_transition_speed: Maybe[coefficient.PositiveSpeed] = Field(
        "friction goes as tanh(sliding speed / this), so bodies creep", default=None
    )

    friction_work: bool = Field(
        "the heat of friction since the start is an output too, and a state of the run", default=False
    )

    def problems(self) -> Iterator[Problem]:
        if len(self.between) == 1:
            yield Problem(("between",), "at least two bodies are needed: names, or `all`")
        if GROUND in self.between:
            yield Problem(("between",), f"`{GROUND}` has no shape: give `planes`")
        if len(set(self.between)) < len(self.between):
            twice = next(each for each in self.between if self.between.count(each) > 1)
            yield Problem(("between",), f"`{twice}` is there twice")
        if friction_model_of(self) == "stiction" and (self.friction or self.friction_model):
            yield from self._problems_of_sticking()
        elif self.friction > 0 and self.friction_transition_speed is None:
            message = "`friction_transition_speed` is missing: below it friction lets the bodies creep"
            yield Problem((), f"{message}; of few spheres `friction_model: stiction` holds them")
        elif self.static_friction is not None:
            yield superfluous("static_friction", "belongs to `friction_model: stiction`")
        if self.friction_work and not self.friction:
            yield superfluous("friction_work", "belongs to `friction`, and none is given")
        if self.friction_transition_speed is not None and not self.friction:
            yield superfluous("friction_transition_speed", "belongs to `friction`, and none is given")

    def _problems_of_sticking(self) -> Iterator[Problem]:
        if not self.friction:
            yield Problem((), "`friction` is missing, the coefficient of kinetic friction")
        elif self.friction_transition_speed is not None:
            yield superfluous("friction_transition_speed", "belongs to `friction_model: coulomb`")
        elif len(set(self.between)) == len(self.between) != 1:
            message = "`contacts` stick between spheres of the same file, where each pair becomes a `contact`; write these otherwise"
            yield Problem(("friction_model",), message)
