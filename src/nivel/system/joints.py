"""Joints: each a list of basic constraints, its joint coordinates, and what its zero and its positive direction are.

A new joint is one entry of JOINTS. Axes are those of the two markers: x, y, z of the first, then of the second.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from nivel.kernels.observe import CROSS_FIRST, CROSS_SECOND, ROTATION, TRANSLATION

AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True)
class Coincident:
    """s: the marker points coincide; rows along the global axes [m]."""

    table: ClassVar[str] = "s"
    rows: ClassVar[tuple[str, ...]] = ("s.x", "s.y", "s.z")

    def entries(self, first: int, second: int, row: int) -> tuple[int, ...]:
        return (first, second, row)


@dataclass(frozen=True)
class PerpendicularAxes:
    """d1: axis `a` of the first marker is perpendicular to axis `b` of the second [-]."""

    a: str
    b: str
    table: ClassVar[str] = "d1"

    @property
    def rows(self) -> tuple[str, ...]:
        return (f"d1.{self.a}{self.b}",)

    def entries(self, first: int, second: int, row: int) -> tuple[int, ...]:
        return (first, AXES[self.a], second, AXES[self.b], row)


@dataclass(frozen=True)
class PerpendicularDistance:
    """d2: axis `a` of the first marker is perpendicular to the vector from the first point to the second [m]."""

    a: str
    table: ClassVar[str] = "d2"

    @property
    def rows(self) -> tuple[str, ...]:
        return (f"d2.{self.a}",)

    def entries(self, first: int, second: int, row: int) -> tuple[int, ...]:
        return (first, AXES[self.a], second, row)


Basic = Coincident | PerpendicularAxes | PerpendicularDistance


@dataclass(frozen=True)
class JointCoordinate:
    """One joint coordinate: its name after the joint's, the kind of `nivel.kernels.observe`, its unit."""

    name: str
    kind: int
    units: str


@dataclass(frozen=True)
class JointKind:
    """A joint: constraints, coordinates, free motions between two bodies, and its convention in words."""

    constraints: tuple[Basic, ...]
    coordinates: tuple[JointCoordinate, ...]
    free: int
    parallel: bool  # the z axes of the markers must point the same way
    convention: str

    @property
    def rows(self) -> tuple[str, ...]:
        return tuple(name for basic in self.constraints for name in basic.rows)


POINT = Coincident()
PARALLEL = (PerpendicularAxes("x", "z"), PerpendicularAxes("y", "z"))
ON_AXIS = (PerpendicularDistance("x"), PerpendicularDistance("y"))
NO_SPIN = PerpendicularAxes("x", "y")
ANGLE = JointCoordinate("angle", ROTATION, "rad")
DISPLACEMENT = JointCoordinate("displacement", TRANSLATION, "m")
TURN = "angle: right-handed turn of the second body about the first marker's z axis, zero where the x axes of the markers agree"
SLIDE = "displacement: of the second marker's point from the first's along the first marker's z axis"

JOINTS: dict[str, JointKind] = {
    "spherical": JointKind((POINT,), (), 3, False, "no joint coordinate"),
    "universal": JointKind(
        (POINT, PerpendicularAxes("z", "z")),
        (JointCoordinate("angle_1", CROSS_FIRST, "rad"), JointCoordinate("angle_2", CROSS_SECOND, "rad")),
        2,
        False,
        "angle_1: right-handed turn of the cross about its arm on the first body (z of the first marker), zero where the "
        "first x axis lies along the other arm; angle_2: of the second body about its arm (z of the second marker), zero "
        "where the second x axis lies along the first body's arm",
    ),
    "revolute": JointKind((POINT, *PARALLEL), (ANGLE,), 1, True, TURN),
    "cylindrical": JointKind((*PARALLEL, *ON_AXIS), (ANGLE, DISPLACEMENT), 2, True, f"{TURN}; {SLIDE}"),
    "translational": JointKind((*PARALLEL, *ON_AXIS, NO_SPIN), (DISPLACEMENT,), 1, True, SLIDE),
    "fixed": JointKind((POINT, *PARALLEL, NO_SPIN), (), 0, True, "no joint coordinate"),
}
