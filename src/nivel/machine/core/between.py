"""Forces between two bodies: at two markers, or at two points that are global as placed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar

from pydantic import BeforeValidator

from nivel.lazy import dataclass
from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.element import ForceElement
from nivel.machine.core.marker import ManyMarkers, Marker, TwoMarkers
from nivel.machine.core.record import BodyName
from nivel.machine.given import Field, ManyNames, ManyPlaces, Maybe, TwoNames, TwoPlaces
from nivel.machine.units.quantity import Position, listed


@dataclass(frozen=True)
class GlobalPoint:
    """The point of `body` that lies at `point` (global, [m]) as the body is placed; its axes are global there."""

    body: str
    point: tuple[float, float, float]


End = str | Marker | GlobalPoint  # the name of a marker, a marker, or a point


class BetweenMarkers(ForceElement):
    """Acts between two `markers`: on the first body and on the second."""

    markers: TwoMarkers = Field(description="on the first and second body: names or markers")

    @property
    def ends(self) -> tuple[End, End]:
        """Where it acts."""
        return self.markers


class Ends(Checked):
    """Two `markers`, or two `points` (global, as placed) of two `bodies`."""

    markers: Maybe[TwoMarkers] = Field(default=None, description="on the first and second body: names or markers")
    bodies: Maybe[TwoNames[BodyName]] = Field(default=None, description="first and second body, in place of `markers`")
    points: Maybe[TwoPlaces[Position]] = Field(
        default=None, description="where it acts on the first body and on the second, global, as placed"
    )

    @property
    def ends(self) -> tuple[End, End]:
        """Where it acts."""
        if self.markers is not None:
            return self.markers
        assert self.bodies is not None  # the record was checked
        assert self.points is not None
        return GlobalPoint(self.bodies[0], self.points[0]), GlobalPoint(self.bodies[1], self.points[1])

    def problems(self) -> Iterator[Problem]:
        if self.markers is not None:
            for name in ("bodies", "points"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "must not be given with `markers`, which say where it acts")
            return
        if self.bodies is None or self.points is None:
            yield Problem((), "two `markers`, or two `bodies` and two `points`, are needed to say where it acts")
        if self.bodies is not None and self.bodies[0] == self.bodies[1]:
            yield Problem(("bodies",), f"two different bodies are needed, got `{self.bodies[0]}` twice")

    def problems_of_line(self) -> Iterator[Problem]:
        """Whether the points as placed have a line between them."""
        if self.markers is None and self.points is not None and self.points[0] == self.points[1]:
            yield Problem(("points",), "the two `points` are the same; the line between them has no direction")


class Between(Ends, ForceElement):
    """Acts between two `markers`, or between two `points` (global, as placed) of two `bodies`."""


class BetweenMany(ForceElement):
    """Acts at many `markers`, or at a point (global, as placed) of each of many `bodies`. where : what these say, in messages."""

    where: ClassVar[str]

    markers: Annotated[Maybe[ManyMarkers], BeforeValidator(listed)] = Field(
        default=None, description="where it acts, in order: names or markers; a marker may stand there again"
    )
    bodies: Annotated[Maybe[ManyNames[BodyName]], BeforeValidator(listed)] = Field(
        default=None, description="one for each point, in place of `markers`; a body may stand there again"
    )
    points: Annotated[Maybe[ManyPlaces[Position]], BeforeValidator(listed)] = Field(
        default=None, description="where it acts, in order: global, as placed"
    )

    @property
    def ends(self) -> tuple[End, ...]:
        """Where it acts, in order."""
        if self.markers is not None:
            return self.markers
        assert self.bodies is not None  # the record was checked
        assert self.points is not None
        return tuple(GlobalPoint(body, point) for body, point in zip(self.bodies, self.points, strict=True))

    def problems(self) -> Iterator[Problem]:
        if self.markers is not None:
            for name in ("bodies", "points"):
                if getattr(self, name) is not None:
                    yield superfluous(name, f"must not be given with `markers`, which say where {self.where}")
        elif self.bodies is None or self.points is None:
            need = "`markers`, or `bodies` and one of `points` for each, are needed to say where"
            yield Problem((), f"{need} {self.where}")
