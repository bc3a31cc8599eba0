"""Description of a kind of joint."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final, Literal, NamedTuple

from nivel.kernels.record.hook import Family
from nivel.lazy import dataclass, field
from nivel.machine.joints.joint import Joint
from nivel.system.joints.composition import POINT, Composition
from nivel.system.tables import Array

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


@dataclass(frozen=True)
class TreeJoint:
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


@dataclass(frozen=True)
class Looks:
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


@dataclass(frozen=True)
class JointKind:
    """All that the package knows of a kind of joint besides its keys (`nivel.machine.joints.joint.JOINT_WORDS`).

    composition : constraints and coordinates. composed(joint) : the same, where it depends on the joint. tree : how it carries a body;
    None: it is a constraint in all coordinates. symbol(seen) : its sign in SVG about its point, with the joint axis to the right, or end-on
    where it is not `seen`; None: a thin circle. freer : kinds that give up some of its rows, and the rows that these keep, by what stands
    behind the joint's name; "s.axis" is what is left of a point that slides along the axis. without_turn : the kind that holds the turn
    which may mean nothing.
    """

    type: str
    composition: Composition
    tree: TreeJoint | None = None
    symbol: Callable[[bool], str] | None = None
    looks: Looks = Looks()
    freer: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    without_turn: str = ""
    composed: Callable[[Joint], Composition] | None = None

    @property
    def is_ball(self) -> bool:
        """Whether it holds a point and nothing else."""
        return self.composition.constraints == (POINT,)
