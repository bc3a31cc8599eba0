"""Bases of forces, also of those between two bodies or many, and the inequalities of elements that have a state."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, NamedTuple

from pydantic import BeforeValidator

from nivel.known import MachineRecord
from nivel.lazy import Struct
from nivel.machine.bodies.shape import Shape, Standing
from nivel.machine.core.orientation import Orientation
from nivel.machine.core.placement import bad_axis_pair
from nivel.machine.core.record import GROUND, BodyName, Checked, Name, Problem, superfluous
from nivel.machine.given import POWER, Field, Given, ManyNames, ManyPlaces, Maybe, OneRecord, TwoNames, TwoPlaces, Usual
from nivel.machine.units.quantity import Direction, Position, fault, listed, shown

# A frame on a body in words.


class Marker(Checked):
    """A point and axes fixed in a body. Joints act along the marker's z axis.

    Its axes are turned by `orientation`, or have z along `axis` and x along `x_axis` made perpendicular; default the
    body's axes.
    """

    collection: ClassVar[str] = "markers"
    tagged = {"shape": 1}  # noqa: RUF012

    name: Name | None = Field("not needed where the marker stands inside an element", default=None)
    body: BodyName = Field("a body, a station of a beam `BEAM.STATION`, or `ground`")
    position: Position = Field("in the body frame", default=(0.0, 0.0, 0.0))
    interface: Name | None = Field("of a flexible body, by name, instead of `position`", default=None)
    orientation: Maybe[OneRecord[Orientation]] = Field("of the marker in the body frame", default=None)
    axis: Maybe[Direction] = Field("z axis of the marker in the body frame, of any length", default=None)
    x_axis: Maybe[Direction] = Field("x axis, made perpendicular to `axis`", default=None)
    shape: Maybe[OneRecord[Shape]] = Field(
        "a solid in the frame of the marker, which contacts that name the marker touch with; not drawn", default=None
    )

    def problems(self) -> Iterator[Problem]:
        if self.name == GROUND:
            yield Problem(("name",), f"`{GROUND}` is the fixed world and cannot be a marker")
        if self.interface is not None and any(self.position):
            yield Problem(("position",), "give `position` or `interface`, not both", at_key=True)
        if self.shape is not None and self.interface is not None:
            yield Problem(
                ("shape",), "of a flexible body its own `shape` touches, about a `centre` that is at an interface"
            )
        if self.shape is not None and not isinstance(self.shape, Standing) and self.shape.from_ is not None:
            yield Problem(
                ("shape",), "the shape stands in the frame of the marker, at its `centre`: `from` and `to` are global"
            )
        if self.orientation is not None and (self.axis is not None or self.x_axis is not None):
            yield Problem(("orientation",), "give `orientation` or `axis`, not both")
            return
        yield from bad_axis_pair(self.axis, self.x_axis)


def _name_or_marker(value: Any) -> Any:
    if isinstance(value, str | Marker | dict):
        return value
    raise fault(f"the name of a marker, or a marker {{body: …, position: …}}, was expected, got {shown(value)}")


MarkerPlace = Annotated[
    Given[Name | Marker, str | Marker, str | Marker | Mapping[str, Any]], BeforeValidator(_name_or_marker)
]
ManyMarkers = Given[tuple[MarkerPlace, ...], tuple[str | Marker, ...], Sequence[str | Marker | Mapping[str, Any]]]
TwoMarkers = Given[
    tuple[MarkerPlace, MarkerPlace], tuple[str | Marker, str | Marker], Sequence[str | Marker | Mapping[str, Any]]
]


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


class GlobalPoint(Struct):
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
