"""Composition of joints: basic constraints, joint coordinates, and what their zero and positive direction are.

Axes are those of the two markers: x, y, z of the first, then of the second.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, Literal

from nivel.kernels.bodies.coordinate import (
    ROTATION,
    TRANSLATION,
)
from nivel.lazy import dataclass
from nivel.machine.joints.joint import Joint

AXES: Final = {"x": 0, "y": 1, "z": 2}
# From which marker to which: first to second, second to first, from the slot, a third marker, on the second body, to the first, from
# the first to the nodes of a beam, or from the plane to the wheel.
View = Literal["first", "second", "slot", "rail", "wheel"]


@dataclass(frozen=True)
class Coincident:
    """s: the marker points coincide; rows along the global axes [m]."""

    @property
    def rows(self) -> tuple[str, ...]:
        return ("s.x", "s.y", "s.z")


@dataclass(frozen=True)
class PerpendicularAxes:
    """d1: axis `a` of the first marker is perpendicular to axis `b` of the second [-]."""

    a: str
    b: str

    @property
    def rows(self) -> tuple[str, ...]:
        return (f"d1.{self.a}{self.b}",)


@dataclass(frozen=True)
class PerpendicularDistance:
    """d2: axis `a` of the marker `seen_from` is perpendicular to the vector from it to the other one [m]."""

    a: str
    seen_from: View = "first"

    @property
    def rows(self) -> tuple[str, ...]:
        return (f"{'d2' if self.seen_from == 'first' else self.seen_from}.{self.a}",)


@dataclass(frozen=True)
class Measured:
    """A coordinate between the joint's markers, see `nivel.kernels.bodies.coordinate`."""

    kind: int
    axis: int = 0
    seen_from: View = "first"


Factor = (
    float | Callable[[Joint, float], float]
)  # of the joint and the cosine of the angle between its z axes as placed


@dataclass(frozen=True)
class Combination:
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


@dataclass(frozen=True)
class JointCoordinate:
    """One joint coordinate: its name after the joint's, what it is, its unit, and where it is zero and positive."""

    name: str
    measured: Measured
    units: str
    meaning: str


@dataclass(frozen=True)
class Composition:
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
