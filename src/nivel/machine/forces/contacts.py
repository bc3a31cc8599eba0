"""Contacts of many spheres, each with each other and with planes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Final, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Exponent, NotNegativeNumber, PositiveNumber, PositiveSpeed, Restitution
from nivel.machine.core.element import OUTPUTS, Acts, ForceElement, Inequalities
from nivel.machine.core.marker import ManyMarkers
from nivel.machine.core.record import GROUND, BodyName
from nivel.machine.forces.contact import FRICTION_MODELS, HERTZ, FrictionModel, friction_model_of
from nivel.machine.given import Field, ManyNames, Maybe
from nivel.machine.power_stiffness import PowerStiffness
from nivel.machine.units.quantity import listed

ALL = "all"
# of friction that sticks: efforts of all pairs are found together
MOST_PAIRS: Final = 120


def _all_or_names(value: Any) -> Any:
    return () if isinstance(value, str) and value == ALL else listed(value)


class Contacts(ForceElement):
    """Spheres that push each other and planes apart: force stiffness · depth ** exponent, damped; with Coulomb friction that creeps."""

    outputs: ClassVar[tuple[str, ...]] = (
        *OUTPUTS,
        "depth",
        "normal_force",
        "friction_force",
        "friction_power",
        "count",
        "friction_work",
    )

    inequalities: ClassVar[Inequalities] = (
        Acts(
            ("is apart", "touches"),
            "depth",
            lambda own, of: of["depth"],
            lambda own, of: of["normal_force"],
        ),
    )

    type: Literal["contacts"] = "contacts"
    between: Annotated[ManyNames[BodyName], BeforeValidator(_all_or_names)] = Field(
        description="`all` bodies whose shape is a sphere, or the names of some: each touches each other"
    )
    planes: Annotated[ManyMarkers, BeforeValidator(listed)] = Field(
        default=(), description="markers: all bodies touch them too, on the side of the z axis"
    )
    exponent: Exponent = Field(default=HERTZ, description="of the depth")
    stiffness: PowerStiffness = Field(description="force by depth ** exponent")
    restitution: Restitution = Field(description="speed after the impact by the speed before it; 1 loses no energy")
    friction: NotNegativeNumber = Field(default=0.0, description="coefficient of kinetic friction")
    static_friction: Maybe[PositiveNumber] = Field(
        default=None, description="of stiction: coefficient, default `friction`"
    )
    friction_model: Maybe[FrictionModel] = Field(
        default=None,
        description=f"{FRICTION_MODELS}; stiction is for at most {MOST_PAIRS} pairs, which become single contacts",
    )
    friction_transition_speed: Maybe[PositiveSpeed] = Field(
        default=None, description="friction goes as tanh(sliding speed / this), so bodies creep"
    )

    friction_work: bool = Field(
        default=False, description="the heat of friction since the start is an output too, and a state of the run"
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
