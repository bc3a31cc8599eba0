"""A driver in words: a motion that is prescribed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from pydantic import Field

from nivel.machine.checked import Checked, Problem, superfluous
from nivel.machine.coefficient import Truth
from nivel.machine.coordinate_function import CoordinateMotion
from nivel.machine.coordinate_reference import CoordinateReference, Kind, kind_of
from nivel.machine.record import GROUND, Name


class Driver(Checked):
    """A joint coordinate, or the place or angle of a marker, that follows a function of time."""

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
    value: CoordinateMotion = Field(description="length or angle, a function of time")
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
    def reference(self) -> str | None:
        """The marker from which a marker is measured; None for the ground."""
        return None if self.relative_to == GROUND else self.relative_to

    def problems(self) -> Iterator[Problem]:
        if self.coordinate is not None:
            for name in ("marker", "along", "about", "relative_to"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "must not be given with `coordinate`")
            return
        if self.marker is None:
            yield Problem((), "a driver needs a `coordinate`, or a `marker` and `along` or `about`")
            return
        if self.along is None and self.about is None:
            yield Problem((), "`along` or `about` is missing: the axis of the driven motion")
        if self.along is not None and self.about is not None:
            yield superfluous("about", "stands in place of `along`; give one of them")
        if self.relative_to == self.marker:
            yield Problem(("relative_to",), "a marker does not move relative to itself")
