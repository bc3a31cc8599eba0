"""Friction in a joint coordinate, loaded by the joint's reaction."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import (
    CoordinateDamping,
    DampingPerLoad,
    NotNegativeForce,
    NotNegativeLength,
    NotNegativeSpeed,
    PositiveForce,
    PositiveNumber,
    PositiveSpeed,
    StiffnessPerLoad,
)
from nivel.machine.core.element import OUTPUTS, ForceElement, Holds, Inequalities
from nivel.machine.given import Field, Maybe
from nivel.machine.units.quantity import PositiveLength
from nivel.machine.uses.coordinate_reference import CoordinateReference, kind_of


class Friction(ForceElement):
    """Dry friction of a joint coordinate: Coulomb's, with true sticking, or of bristles (LuGre); and viscous friction.

    Speeds are those of the rubbing surfaces: of an angle `radius` · rate.
    """

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "normal_load", "bristle")  # bristle: of the lugre model

    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = (
        Holds(
            "coordinate",
            lambda own, of: of["magnitude"] + own.viscous * of.rate(own.coordinate),
            lambda own, of: own.static * own.arm * of["normal_load"],
            lambda own, of: own.coefficient * own.arm * of["normal_load"],
            lambda own, of: of.rate(own.coordinate),
            applies=lambda own: own.model == "stiction",
        ),
    )

    type: Literal["friction"] = "friction"
    coordinate: CoordinateReference
    model: Literal["coulomb", "stiction", "lugre"]
    coefficient: PositiveNumber = Field(description="of kinetic friction")
    static_coefficient: Maybe[PositiveNumber] = Field(default=None, description="default `coefficient`")
    stribeck_speed: Maybe[NotNegativeSpeed] = Field(
        default=None,
        description="at which static friction has mostly become kinetic; 0, with stiction: as soon as it slides",
    )
    transition_speed: Maybe[PositiveSpeed] = Field(
        default=None, description="of the coulomb model: friction goes as tanh(speed / transition_speed)"
    )
    viscous: CoordinateDamping = Field(default=0.0, description="effort per rate of the coordinate")
    bristle_stiffness: Maybe[StiffnessPerLoad] = Field(default=None, description="of the lugre model, per normal load")
    bristle_damping: DampingPerLoad = Field(default=0.0, description="of the lugre model, per normal load")
    normal_load: Maybe[PositiveForce] = Field(default=None, description="in place of the joint's own reaction")
    preload: NotNegativeForce = Field(default=0.0, description="added to the load by the reaction")
    radius: Maybe[PositiveLength] = Field(
        default=None, description="of the pin; of a displacement, arm on which a torque about the axis loads it"
    )
    collar_radius: NotNegativeLength = Field(default=0.0, description="at which the axial reaction rubs, of an angle")
    bearing_length: Maybe[PositiveLength] = Field(
        default=None, description="over which a bending moment M loads the bearing by 2 M / bearing_length"
    )

    @property
    def arm(self) -> float:
        """Speed of the surfaces by the rate of the coordinate [m], 1 of a length."""
        return self.radius or 1.0 if kind_of(self.coordinate) != "length" else 1.0

    @property
    def static(self) -> float:
        """Coefficient of static friction."""
        return self.coefficient if self.static_coefficient is None else self.static_coefficient

    def problems(self) -> Iterator[Problem]:
        yield from self._problems_of_model()
        yield from self._problems_of_load()

    def _problems_of_model(self) -> Iterator[Problem]:
        if self.static < self.coefficient:
            message = f"`static_coefficient` {self.static:g} is smaller than `coefficient` {self.coefficient:g}"
            yield Problem(("static_coefficient",), f"{message}; static friction is at least as strong as kinetic")
        if self.static > self.coefficient and self.stribeck_speed is None:
            message = "`stribeck_speed` is missing: at about this speed static friction has become kinetic"
            yield Problem((), message)
        if self.static > self.coefficient and self.stribeck_speed == 0.0 and self.model != "stiction":
            message = (
                f"`stribeck_speed` must be greater than zero: `model: {self.model}` would never have static friction"
            )
            yield Problem(("stribeck_speed",), f"{message}; `model: stiction` allows zero")
        if self.model == "coulomb" and self.transition_speed is None:
            message = "`transition_speed` is missing: below it the coulomb model lets the joint creep"
            yield Problem((), message)
        if self.model != "coulomb" and self.transition_speed is not None:
            yield superfluous("transition_speed", f"belongs to `model: coulomb`; this one is `{self.model}`")
        if self.model == "lugre" and self.bristle_stiffness is None:
            yield Problem((), "`bristle_stiffness` is missing: the lugre model needs one, e.g. 1e5/m")
        for name in ("bristle_stiffness", "bristle_damping"):
            if self.model != "lugre" and getattr(self, name):
                yield superfluous(name, f"belongs to `model: lugre`; this one is `{self.model}`")

    def _problems_of_load(self) -> Iterator[Problem]:
        kind = kind_of(self.coordinate)
        if kind == "angle" and self.radius is None:
            yield Problem((), "`radius` is missing: of the surface that rubs as the angle changes")
        if kind == "length" and self.collar_radius:
            yield superfluous("collar_radius", f"belongs to an angle; `{self.coordinate}` is a length")
        if self.normal_load is None:
            if self.coordinate.endswith((".x", ".y")):
                yield Problem((), f"`normal_load` is missing: no reaction loads `{self.coordinate}` alone")
            return
        by_reaction = ("preload", "collar_radius", "bearing_length", *(("radius",) if kind == "length" else ()))
        for name in by_reaction:
            if getattr(self, name):
                yield superfluous(name, "must not be given with `normal_load`, which is the whole load")
