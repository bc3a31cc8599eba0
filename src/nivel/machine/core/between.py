"""Forces between two bodies: at two markers, or at two points that are global as placed."""

from __future__ import annotations

from collections.abc import Iterator

from nivel.lazy import dataclass
from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.element import ForceElement
from nivel.machine.core.marker import Marker, TwoMarkers
from nivel.machine.core.record import BodyName
from nivel.machine.given import Field, Maybe, TwoNames, TwoPlaces
from nivel.machine.units.quantity import Position


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
