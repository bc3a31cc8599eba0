"""Kinds of joints: what they are placed by, what they are made of, how they carry a body in a tree, and their looks.

Composition of joints: basic constraints, joint coordinates, and what their zero and positive direction are.

Axes are those of the two markers: x, y, z of the first, then of the second.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple

from nivel.kernels.bodies.coordinate import ROTATION, TRANSLATION
from nivel.lazy import Struct, field
from nivel.machine.core.vectors import Array

if TYPE_CHECKING:
    from nivel.elements.joints.joint import Joint
    from nivel.kernels.record.hook import Family

    # of the joint and the cosine of the angle between its z axes as placed
    Factor = float | Callable[[Joint, float], float]

AXES: Final = {"x": 0, "y": 1, "z": 2}
# From which marker to which: first to second, second to first, from the slot, a third marker, on the second body, to the first, from
# the first to the nodes of a beam, or from the plane to the wheel.
View = Literal["first", "second", "slot", "rail", "wheel"]


class Coincident(Struct):
    """s: the marker points coincide; rows along the global axes [m]."""

    @property
    def rows(self) -> tuple[str, ...]:
        return ("s.x", "s.y", "s.z")


class PerpendicularAxes(Struct):
    """d1: axis `a` of the first marker is perpendicular to axis `b` of the second [-]."""

    a: str
    b: str

    @property
    def rows(self) -> tuple[str, ...]:
        return (f"d1.{self.a}{self.b}",)


class PerpendicularDistance(Struct):
    """d2: axis `a` of the marker `seen_from` is perpendicular to the vector from it to the other one [m]."""

    a: str
    seen_from: View = "first"

    @property
    def rows(self) -> tuple[str, ...]:
        return (f"{'d2' if self.seen_from == 'first' else self.seen_from}.{self.a}",)


class Measured(Struct):
    """A coordinate between the joint's markers, see `nivel.kernels.bodies.coordinate`."""

    kind: int
    axis: int = 0
    seen_from: View = "first"


class Combination(Struct):
    """Σ factor coordinate is constant: what it is as placed, the number that the joint's field `given` holds, or, with `zero`, nothing.

    velocity : the coordinate has a rate alone, which is held at zero. effort : name of the force on it in results, and its long name.
    """

    name: str
    terms: tuple[tuple[Measured, Factor], ...]
    units: str = "m"
    given: str = ""
    zero: bool = False
    velocity: bool = False
    effort: tuple[str, str] | None = None

    @property
    def rows(self) -> tuple[str, ...]:
        return (self.name,)


Basic = Coincident | PerpendicularAxes | PerpendicularDistance | Combination


class JointCoordinate(Struct):
    """One joint coordinate: its name after the joint's, what it is, its unit, and where it is zero and positive."""

    name: str
    measured: Measured
    units: str
    meaning: str


class Composition(Struct):
    """A joint: constraints and coordinates. when_parallel : what it is where the axes as placed are parallel. note : said before the
    convention."""

    constraints: tuple[Basic, ...]
    coordinates: tuple[JointCoordinate, ...] = ()
    when_parallel: Composition | None = None
    note: str = ""

    @property
    def rows(self) -> tuple[str, ...]:
        return tuple(name for basic in self.constraints for name in basic.rows)

    @property
    def free(self) -> int:
        """Motions between two bodies that stay free."""
        return 6 - len(self.rows)

    @property
    def parallel(self) -> bool:
        """Whether the z axes of the markers must point the same way."""
        return {*PARALLEL} <= {*self.constraints}

    @property
    def convention(self) -> str:
        """Its coordinates in words."""
        meanings = [f"{each.name}: {each.meaning}" for each in self.coordinates] or ["no joint coordinate"]
        return "; ".join([*([self.note] if self.note else []), *meanings])


POINT = Coincident()
PARALLEL = (PerpendicularAxes("x", "z"), PerpendicularAxes("y", "z"))
ON_AXIS = (PerpendicularDistance("x"), PerpendicularDistance("y"))
NO_SPIN = PerpendicularAxes("x", "y")
ALONG_X, ALONG_Y, ALONG_Z = (Measured(TRANSLATION, axis) for axis in range(3))
SLIDE = "of the second marker's point from the first's along the first marker's z axis"
ANGLE = JointCoordinate(
    "angle",
    Measured(ROTATION),
    "rad",
    "right-handed turn of the second body about the first marker's z axis, zero where the x axes of the markers agree",
)
DISPLACEMENT = JointCoordinate("displacement", ALONG_Z, "m", SLIDE)
X = JointCoordinate("x", ALONG_X, "m", "of the second marker's point from the first's along the first marker's x axis")
Y = JointCoordinate("y", ALONG_Y, "m", "along its y axis")

TURNS: Final = ("turn_x", "turn_y", "turn_z")


class Seen(NamedTuple):
    """Motion of a child seen from the parent's marker, in the marker's axes: turn Q (3, 3), displacement d (3,) [m], angular velocity and
    velocity against the parent (3,)."""

    Q: Array
    d: Array
    omega: Array
    velocity: Array


class Start(NamedTuple):
    """Positions and velocities of a joint of the tree, and its four numbers. The last two are the cosine and sine of a constant turn."""

    positions: list[float]
    velocities: list[float]
    numbers: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 0.0)


class TreeJoint(Struct):
    """How a joint carries a body in the tree of relative coordinates, by a marker near to the ground and one on the child.

    motion : its number in `nivel.kernels.tree.joints`, or a `joint_motion`. units : of its positions; if it is `turning`, the last four are
    Euler parameters, and its last three velocities are ω̄. start(seen, joint) : positions and velocities of the joint, None of one that
    slides along a beam. turn(positions, numbers) : Euler parameters of the child seen from the parent's marker, as in the kernels; None
    where these find them from the axes. angles : the position that a measured angle is, by its number in `nivel.kernels.bodies.coordinate`.
    coordinates : names of its positions, without those of a turn in space; that of a joint coordinate of the results only where its rate
    is the velocity, or minus that, in every position. backwards : the same where it carries its first body, if they differ.
    """

    motion: int | Family
    units: tuple[str, ...]
    start: Callable[[Seen, Joint | None], Start] | None = None
    turn: Callable[[list[float], Array], Array] | None = None
    angles: Mapping[int, int] = field(default_factory=dict)
    turning: bool = False
    coordinates: tuple[str, ...] = ()
    backwards: tuple[str, ...] = ()

    def names(self, *, backwards: bool) -> tuple[str, ...]:
        """What each of its velocities is the rate of; backwards : it carries its first body."""
        turns = TURNS if self.turning else ()
        numbered = tuple(f"position_{k + 1}" for k in range(self.velocities - len(turns)))
        return (*((backwards and self.backwards) or self.coordinates or numbered), *turns)

    @property
    def velocities(self) -> int:
        """Their number."""
        return len(self.units) - self.turning


class Looks(Struct):
    """What pictures make of a joint.

    at : where its sign stands: at its first point, its second, or that of the body that moves. ends : kinds of joints whose signs stand at
    the ends of a massless link. ground : what is drawn of the ground: under a point, along a rail, or a line or plane where this is on the
    first body. turns : markers whose z axes bodies turn about, where they turn about nothing else. slides : where they slide along nothing
    else, along z of the first marker or of the slot. icon : the joint axis in tables, right and down; (0, 0): end-on.
    """

    at: Literal["first", "second", "moving"] = "first"
    ends: tuple[str, str] | None = None
    ground: Literal["point", "rail", "line", "plane"] = "point"
    turns: tuple[Literal["first", "second"], ...] = ()
    slides: Literal["", "first", "slot"] = ""
    icon: tuple[float, float] = (1.0, 0.0)


SIGN: Final = 6.5  # [pixels] of the signs of joints, which are those of textbooks


def sign(side: str, end_on: str = "") -> Callable[[bool], str]:
    """A sign in SVG, and what it is where its axis is seen end-on, if that is not the same."""
    return lambda seen: side if seen else end_on or side


THIN: Final = f'<circle r="{SIGN}" class="thin"/>'  # of kinds that have no sign
# keys of a joint at a point with an axis
WITH_AXIS: Final[dict[str, Any]] = {"place": ("point", "axis"), "may": ("x_axis",)}


class JointKind(Struct):
    """All that the package knows of a kind of joint.

    composition : constraints and coordinates. composed(joint) : the same, where it depends on the joint. tree : how it carries a body;
    None: it is a constraint in all coordinates. symbol(seen) : its sign in SVG about its point, with the joint axis to the right, or end-on
    where it is not `seen`. freer : kinds that give up some of its rows, and the rows that these keep, by what stands behind the joint's
    name; "s.axis" is what is left of a point that slides along the axis. without_turn : the kind that holds the turn which may mean
    nothing.

    place : keys that it needs beside `bodies` where it is placed by points. may : keys that it may have there.
    size : keys that it needs however it is placed. may_size : keys that it may have however it is placed.
    held : the joint itself holds these coordinates.
    axes : what the two `axes` are to each other. rail : the second of its `bodies` is a beam, along which it slides.
    point_mass : which of its bodies may be a point mass. mirror : what a mirror image keeps of its axes: that they turn, that they slide,
    or both arms. opposite : the coordinate that counts the other way there.
    """

    type: str
    composition: Composition
    tree: TreeJoint | None = None
    symbol: Callable[[bool], str] = sign(THIN)
    looks: Looks = Looks()
    freer: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    without_turn: str = ""
    composed: Callable[[Joint], Composition] | None = None
    place: tuple[str, ...] = ()
    may: tuple[str, ...] = ()
    size: tuple[str, ...] = ()
    may_size: tuple[str, ...] = ()
    held: tuple[str, ...] = ()
    axes: Literal["", "perpendicular", "not parallel"] = ""
    rail: bool = False
    point_mass: Literal["", "either", "second"] = ""
    mirror: Literal["turning", "sliding", "arms"] = "turning"
    opposite: str = ""

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of its joint coordinates."""
        return tuple(coordinate.name for coordinate in self.composition.coordinates)

    @property
    def is_ball(self) -> bool:
        """Whether it holds a point and nothing else."""
        return self.composition.constraints == (POINT,)

    def of(self, joint: Joint) -> Composition:
        """What a joint is made of, where the directions of its axes are as they should be."""
        return self.composition if self.composed is None else self.composed(joint)
