"""A driver in words: a motion that is prescribed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Final, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.coefficient import CoordinateRate, Truth
from nivel.machine.core.record import GROUND, Name
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.joints.driven_orientation import DrivenOrientation
from nivel.machine.laws.coordinate_function import CoordinateAcceleration, CoordinateMotion, CoordinateSpeed
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.time_function import OneFunction, ThreeFunctions, signals_of, varying
from nivel.machine.units.quantity import listed
from nivel.machine.uses.coordinate_reference import CoordinateReference, Kind, kind_of

LengthMotion = Annotated[OneFunction, varying("length", smooth=True)]
# keys of a driver of one motion, which a whole pose has no use for
RATES: Final = ("speed", "acceleration")
MOTIONS: Final = ("value", *RATES)
OF_ONE_MOTION: Final = ("coordinate", "along", "about", "value", "speed", "acceleration")


class Driver(Checked):
    """A joint coordinate, the place or angle of a marker, or a marker's whole pose, that follows functions of time."""

    collection: ClassVar[str] = "drivers"

    name: Name
    coordinate: CoordinateReference | None = Field(default=None, description="joint coordinate that is driven")
    marker: Name | None = Field(default=None, description="marker that is driven, in place of `coordinate`")
    along: Literal["x", "y", "z"] | None = Field(
        default=None, description="axis of `relative_to` along which the marker's point is driven"
    )
    about: Literal["x", "y", "z"] | None = Field(
        default=None,
        description="axis of `relative_to` about which the marker is turned, measured between the axes that follow it",
    )
    relative_to: Name | None = Field(default=None, description="marker from which it is measured; default `ground`")
    value: Maybe[CoordinateMotion] = Field(default=None, description="length or angle, a function of time")
    speed: Maybe[CoordinateSpeed] = Field(
        default=None,
        description="in place of `value`: rate, a function of time; the coordinate begins where it is placed",
    )
    acceleration: Maybe[CoordinateAcceleration] = Field(
        default=None, description="in place of `value`: a function of time; the coordinate begins where it is placed"
    )
    start_speed: CoordinateRate = Field(default=0.0, description="with `acceleration`: rate at t = 0")
    position: Annotated[Maybe[ThreeFunctions[LengthMotion]], BeforeValidator(listed)] = Field(
        default=None,
        description="of the marker's point from that of `relative_to`, along its axes: three functions of time",
    )
    orientation: Maybe[OneRecord[DrivenOrientation]] = Field(
        default=None, description="of the marker's axes in those of `relative_to`, functions of time"
    )
    from_start: Truth = Field(
        default=False,
        description="the coordinate moves from where it is placed by what `value` changes from its value at t = 0",
    )

    @property
    def kind(self) -> Kind | None:
        """Whether a length or an angle is driven, where that is known without the machine."""
        if self.marker is not None:
            return "length" if self.along is not None else "angle"
        return kind_of(self.coordinate)

    @property
    def is_pose(self) -> bool:
        """Whether a position or an orientation is driven as a whole."""
        return self.position is not None or self.orientation is not None

    @property
    def row_count(self) -> int:
        """Motions that it prescribes."""
        return 3 * (self.position is not None) + 3 * (self.orientation is not None) if self.is_pose else 1

    @property
    def reference(self) -> str | None:
        """The marker from which a marker is measured; None for the ground."""
        return None if self.relative_to == GROUND else self.relative_to

    def problems(self) -> Iterator[Problem]:
        if self.is_pose:
            yield from self._problems_of_pose()
            return
        given = [name for name in MOTIONS if getattr(self, name) is not None]
        if not given and (self.coordinate, self.along, self.about) != (None, None, None):
            yield Problem(
                (),
                "`value` is missing: the driven length or angle, a function of time; or a `speed`, or an `acceleration`",
            )
        for name in given[1:]:
            yield superfluous(name, f"stands in place of `{given[0]}`; give one of them")
        yield from self._problems_of_rates()
        if self.coordinate is not None:
            for name in ("marker", "along", "about", "relative_to"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "must not be given with `coordinate`")
            return
        if self.marker is None:
            yield Problem((), "a driver needs a `coordinate`, or a `marker` and `along` or `about`")
            return
        if self.along is None and self.about is None:
            yield Problem(
                (),
                "`along` or `about` is missing: the axis of the driven motion; or a whole `position` or `orientation`",
            )
        if self.along is not None and self.about is not None:
            yield superfluous("about", "stands in place of `along`; give one of them")
        if self.marker is not None and self.relative_to == self.marker:
            yield Problem(("relative_to",), "a marker does not move relative to itself")

    def _problems_of_rates(self) -> Iterator[Problem]:
        for name in RATES:
            function = getattr(self, name)
            if function is not None and signals_of(function):
                symbol = signals_of(function)[0]
                message = f"`{symbol}` is only known while the machine moves; a driver depends on `time` alone"
                yield Problem((name,), message)
            if isinstance(function, PythonLaw):
                yield Problem((name,), "a function in Python drives by its `value`, rate and acceleration")
            if function is not None and self.from_start:
                yield superfluous(
                    "from_start", f"goes with `value`; with `{name}` the coordinate begins where it is placed"
                )
        if self.start_speed and self.acceleration is None:
            yield superfluous("start_speed", "belongs to an `acceleration`, and none is given")

    def _problems_of_pose(self) -> Iterator[Problem]:
        for name in OF_ONE_MOTION:
            if getattr(self, name) is not None:
                yield superfluous(name, "must not be given with `position` or `orientation`, which drive a marker")
        if self.from_start:
            yield superfluous(
                "from_start", "goes with `value`; a `position` and an `orientation` are those of the marker"
            )
        if self.marker is None:
            yield Problem((), "`marker` is missing: the marker whose pose is driven")
        if self.marker is not None and self.relative_to == self.marker:
            yield Problem(("relative_to",), "a marker does not move relative to itself")
