"""Bases of forces, also of those between two bodies or many, and the inequalities of elements that have a state."""

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, NamedTuple

from pydantic import BeforeValidator

from nivel.known import MachineRecord
from nivel.lazy import dataclass
from nivel.machine.core.marker import ManyMarkers, Marker, TwoMarkers
from nivel.machine.core.record import BodyName, Checked, Name, Problem, superfluous
from nivel.machine.given import POWER, Field, ManyNames, ManyPlaces, Maybe, TwoNames, TwoPlaces, Usual
from nivel.machine.units.quantity import Position, listed

OUTPUTS: Final = ("magnitude", "power")
# of an element and its numbers over time (`nivel.judge.after.checks.states`): an array over time
History = Callable[[Any, Any], Any]


class Acts(NamedTuple):
    """An effort where an overlap is positive, and none where it is negative.

    sides : words for what the element is without the overlap, and with it. like : output or field of the record whose units the overlap
    has. overlap, its rate where it is known, effort. always : of the element, whether every overlap that grows has an effort. applies : of
    the element, whether it has these sides.
    """

    sides: tuple[str, str]
    like: str
    overlap: History
    effort: History
    rate: History | None = None
    always: Callable[[Any], bool] = lambda _: True
    applies: Callable[[Any], bool] = lambda _: True


class Holds(NamedTuple):
    """Dry friction: an effort below its limit holds, and at the limit it slides.

    like : output or field of the record whose units the slip has. effort, its limit at rest, the limit below which it holds, and the rate
    of slip. one_way : the effort is not negative, and below its limit neither is the slip. applies : of the element, whether it has this
    friction.
    """

    like: str
    effort: History
    limit: History
    sliding: History
    slip: History
    one_way: bool = False
    applies: Callable[[Any], bool] = lambda _: True


Inequalities = tuple[Acts | Holds, ...]


class ForceElement(Checked):
    """A named element that loads bodies.

    outputs : what a sensor can read of it. locks : it holds with what is wanted, up to its capacity. turns : it may turn a body, which a
    point mass cannot be. stiff : it may be stiff, that is, do much work in a short time. usual : what its outputs are between.
    inequalities : that its state obeys at all times.
    """

    collection: ClassVar[str] = "forces"
    outputs: ClassVar[tuple[str, ...]] = OUTPUTS
    locks: ClassVar[bool] = False
    turns: ClassVar[bool] = False
    stiff: ClassVar[bool] = True
    usual: ClassVar[Mapping[str, Usual]] = {"power": POWER}
    inequalities: ClassVar[Inequalities] = ()

    name: Name
    if TYPE_CHECKING:  # the word of every kind
        type: Any

    @property
    def sticks(self) -> bool:
        """Whether friction of it can hold bodies at rest: its efforts are unknowns of the equations of motion."""
        return self.locks

    def remarks(self, machine: MachineRecord) -> Iterator[tuple[str, str]]:
        """Key and text of what is right by itself in it, and may be a slip."""
        return iter(())


@dataclass(frozen=True)
class GlobalPoint:
    """The point of `body` that lies at `point` (global, [m]) as the body is placed; its axes are global there."""

    body: str
    point: tuple[float, float, float]


End = str | Marker | GlobalPoint  # the name of a marker, a marker, or a point


class BetweenMarkers(ForceElement):
    """Acts between two `markers`: on the first body and on the second."""

    markers: TwoMarkers = Field("on the first and second body: names or markers")

    @property
    def ends(self) -> tuple[End, End]:
        """Where it acts."""
        return self.markers


class Ends(Checked):
    """Two `markers`, or two `points` (global, as placed) of two `bodies`."""

    markers: Maybe[TwoMarkers] = Field("on the first and second body: names or markers", default=None)
    bodies: Maybe[TwoNames[BodyName]] = Field("first and second body, in place of `markers`", default=None)
    points: Maybe[TwoPlaces[Position]] = Field(
        "where it acts on the first body and on the second, global, as placed", default=None
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
        "where it acts, in order: names or markers; a marker may stand there again", default=None
    )
    bodies: Annotated[Maybe[ManyNames[BodyName]], BeforeValidator(listed)] = Field(
        "one for each point, in place of `markers`; a body may stand there again", default=None
    )
    points: Annotated[Maybe[ManyPlaces[Position]], BeforeValidator(listed)] = Field(
        "where it acts, in order: global, as placed", default=None
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
