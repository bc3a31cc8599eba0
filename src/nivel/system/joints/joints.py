"""Joints: each a list of basic constraints, its joint coordinates, and what its zero and its positive direction are.

A new joint is one entry of JOINTS. Axes are those of the two markers: x, y, z of the first, then of the second.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from math import pi
from typing import Final, Literal

from nivel.kernels.bodies.coordinate import (
    ACROSS_Y,
    ACROSS_Z,
    ALONG,
    COSINE,
    CROSS_FIRST,
    CROSS_SECOND,
    DISTANCE,
    LEAN_X,
    LEAN_Y,
    MOMENT,
    POLAR,
    RADIUS,
    ROTATION,
    TRANSLATION,
    TWIST,
)
from nivel.kernels.bodies.rolling import CONTACT, SLIP
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
    """One joint coordinate: its name after the joint's, what it is, its unit."""

    name: str
    measured: Measured
    units: str


@dataclass(frozen=True)
class Composition:
    """A joint: constraints, coordinates, free motions between two bodies, and its convention in words.

    parallel : the z axes of the markers must point the same way. when_parallel : what it is where the axes as placed are parallel.
    """

    constraints: tuple[Basic, ...]
    coordinates: tuple[JointCoordinate, ...]
    free: int
    parallel: bool
    convention: str
    when_parallel: Composition | None = None

    @property
    def rows(self) -> tuple[str, ...]:
        return tuple(name for basic in self.constraints for name in basic.rows)


POINT = Coincident()
PARALLEL = (PerpendicularAxes("x", "z"), PerpendicularAxes("y", "z"))
ON_AXIS = (PerpendicularDistance("x"), PerpendicularDistance("y"))
NO_SPIN = PerpendicularAxes("x", "y")
ALONG_X, ALONG_Y, ALONG_Z = (Measured(TRANSLATION, axis) for axis in range(3))
ANGLE = JointCoordinate("angle", Measured(ROTATION), "rad")
DISPLACEMENT = JointCoordinate("displacement", ALONG_Z, "m")
X, Y = JointCoordinate("x", ALONG_X, "m"), JointCoordinate("y", ALONG_Y, "m")
TURN = "angle: right-handed turn of the second body about the first marker's z axis, zero where the x axes of the markers agree"
SLIDE = "displacement: of the second marker's point from the first's along the first marker's z axis"
PLACE = "x: of the second marker's point from the first's along the first marker's x axis; y: along its y axis"
NOTHING = "no joint coordinate"

RAIL = (
    "displacement: of the point along the beam, in unstressed length from its start; the joint's z axis is that of the beam, its x axis "
    "the sections' y"
)


def on_rail(name: str, kind: int, units: str = "m") -> Combination:
    """A row that holds a coordinate of a slider on a beam at zero."""
    return Combination(name, ((Measured(kind, seen_from="rail"), 1.0),), units=units, zero=True)


ON_LINE = (on_rail("across.y", ACROSS_Y), on_rail("across.z", ACROSS_Z))
WITH_LINE = (on_rail("lean.x", LEAN_X, "1"), on_rail("lean.y", LEAN_Y, "1"))
KEY = on_rail("twist", TWIST, "1")
PLACE_ON_BEAM = JointCoordinate("displacement", Measured(ALONG, seen_from="rail"), "m")


def slip(axis: int) -> Combination:
    """The row that lets a wheel not slip along an axis of the plane's marker."""
    name = "xy"[axis]
    effort = f"friction_{name}", f"force of the plane on the wheel along {name} of the plane's marker"
    measured = Measured(SLIP, axis, seen_from="wheel")
    return Combination(f"slip.{name}", ((measured, 1.0),), zero=True, velocity=True, effort=effort)


ON_PLANE = Combination(
    "contact",
    ((Measured(CONTACT, seen_from="wheel"), 1.0),),
    zero=True,
    effort=("normal_force", "force of the plane on the wheel along its normal"),
)
ROLLING = "x: of the wheel's centre along the x axis of the plane's marker; y: along its y axis; normal force and friction act on the wheel"

ROD = Composition(
    (Combination("distance", ((Measured(DISTANCE), 1.0),), given="distance"),),
    (JointCoordinate("distance", Measured(DISTANCE), "m"),),
    5,
    False,
    "distance: between the points of the markers, held by the joint",
)

UNIVERSAL = (
    "angle_1: right-handed turn of the cross about its arm on the first body (z of the first marker), zero where the "
    "first x axis lies along the other arm; angle_2: of the second body about its arm (z of the second marker), zero "
    "where the second x axis lies along the first body's arm"
)
ARMS = (
    JointCoordinate("angle_1", Measured(CROSS_FIRST), "rad"),
    JointCoordinate("angle_2", Measured(CROSS_SECOND), "rad"),
)
ALL_TURNS: Final = {"rx", "ry", "rz"}
# perpendicular axes of the first and the second marker: one pair locks one turn, or both pairs of an axis the turns of that axis
LOCKS: Final = {
    frozenset({"rx"}): (PerpendicularAxes("y", "z"),),
    frozenset({"ry"}): (PerpendicularAxes("z", "x"),),
    frozenset({"rz"}): (NO_SPIN,),
    frozenset({"rx", "ry"}): PARALLEL,
    frozenset({"rx", "rz"}): (PerpendicularAxes("x", "y"), PerpendicularAxes("z", "y")),
    frozenset({"ry", "rz"}): (PerpendicularAxes("y", "x"), PerpendicularAxes("z", "x")),
    frozenset(ALL_TURNS): (*PARALLEL, NO_SPIN),
    frozenset(): (),
}


def generic(locked: Collection[str]) -> Composition:
    """The joint that locks some of x, y, z, rx, ry, rz, seen from the first marker. All three places together are points that coincide."""
    turns, places = frozenset(ALL_TURNS & set(locked)), [axis for axis in "xyz" if axis in locked]
    at: tuple[Basic, ...] = (POINT,) if len(places) == 3 else tuple(PerpendicularDistance(axis) for axis in places)
    return Composition(
        (*at, *LOCKS[turns]),
        (X, Y, DISPLACEMENT, ANGLE),
        6 - len(locked),
        {"rx", "ry"} <= turns,
        f"locked: {', '.join(locked)}; {PLACE}; {SLIDE}; {TURN}",
    )


def composition_of(joint: Joint) -> Composition:
    """What a joint is made of, where the directions of its axes are as they should be."""
    return generic(joint.locked or ()) if joint.type == "generic" else JOINTS[joint.type]


JOINTS: Final[dict[str, Composition]] = {
    "spherical": Composition((POINT,), (), 3, False, NOTHING),
    "universal": Composition(
        (POINT, PerpendicularAxes("z", "z")),
        ARMS,
        2,
        False,
        UNIVERSAL,
    ),
    # arms of the cross at any angle to each other, which stays as placed: also a cone that rolls on its tip
    "skew-universal": Composition(
        (POINT, Combination("axes", ((Measured(COSINE, 8), 1.0),), units="1")), ARMS, 2, False, UNIVERSAL
    ),
    # a universal joint whose cross slides along z of the first marker, with its arms along x of the first and z of the second
    "translational-universal": Composition((*ON_AXIS, PerpendicularAxes("x", "z")), (DISPLACEMENT,), 3, False, SLIDE),
    # locks nothing by itself: see `generic`
    "generic": Composition((), (X, Y, DISPLACEMENT, ANGLE), 6, False, f"{PLACE}; {SLIDE}; {TURN}"),
    "variable-distance": Composition(
        (),
        (JointCoordinate("distance", Measured(DISTANCE), "m"),),
        6,
        False,
        "distance: between the points of the markers, which drivers and forces may act on",
    ),
    "revolute": Composition((POINT, *PARALLEL), (ANGLE,), 1, True, TURN),
    "cylindrical": Composition((*PARALLEL, *ON_AXIS), (ANGLE, DISPLACEMENT), 2, True, f"{TURN}; {SLIDE}"),
    "translational": Composition((*PARALLEL, *ON_AXIS, NO_SPIN), (DISPLACEMENT,), 1, True, SLIDE),
    "fixed": Composition((POINT, *PARALLEL, NO_SPIN), (), 0, True, NOTHING),
    "planar": Composition((*PARALLEL, PerpendicularDistance("z")), (X, Y, ANGLE), 3, True, f"{PLACE}; {TURN}"),
    "point-on-line": Composition(ON_AXIS, (DISPLACEMENT,), 4, False, SLIDE),
    "point-on-plane": Composition((PerpendicularDistance("z"),), (X, Y), 5, False, PLACE),
    "screw": Composition(
        (
            *PARALLEL,
            *ON_AXIS,
            Combination(
                "screw", ((ALONG_Z, 1.0), (Measured(ROTATION), lambda joint, _: -(joint.pitch or 0.0) / (2 * pi)))
            ),
        ),
        (ANGLE, DISPLACEMENT),
        1,
        True,
        f"{TURN}; {SLIDE}: pitch times the turns, from where it is placed",
    ),
    "distance": ROD,
    "spherical-spherical": ROD,
    # a link that turns about the first marker's z axis and holds the second point
    "revolute-spherical": Composition(
        (Combination("distance", ((Measured(DISTANCE), 1.0),)), Combination("axial", ((ALONG_Z, 1.0),))),
        (JointCoordinate("angle", Measured(POLAR), "rad"),),
        4,
        False,
        "angle: right-handed turn of the link about the first marker's z axis, zero where the second point is on its x side",
    ),
    # a link that turns about the axis a = z_1 and holds the line b = z_2: angle, common normal (times the sine of the angle),
    # and foot of the common normal on the first axis, s (1 - (aᵀb)²) = aᵀd - (aᵀb) bᵀd, keep their values
    "revolute-cylindrical": Composition(
        (
            Combination("axes", ((Measured(COSINE, 8), 1.0),), units="1"),
            Combination("normal", ((Measured(MOMENT), 1.0),)),
            Combination("axial", ((ALONG_Z, 1.0), (Measured(TRANSLATION, 2, "second"), lambda _, cosine: cosine))),
        ),
        (),
        3,
        False,
        NOTHING,
        when_parallel=Composition(
            (*PARALLEL, Combination("normal", ((Measured(RADIUS), 1.0),))), (), 3, False, NOTHING
        ),
    ),
    # a pin about z in a slot along z of a third marker
    "revolute-translational": Composition(
        (*PARALLEL, PerpendicularDistance("x", "slot"), PerpendicularDistance("y", "slot")),
        (ANGLE, JointCoordinate("displacement", Measured(TRANSLATION, 2, "slot"), "m")),
        2,
        True,
        f"{TURN}; displacement: of the first marker's point from the second's along the slot in the second body",
    ),
    "rolling": Composition((ON_PLANE, slip(0), slip(1)), (X, Y), 3, False, ROLLING),
    "point-on-beam": Composition(ON_LINE, (PLACE_ON_BEAM,), 4, False, RAIL),
    "keyed-on-beam": Composition((*ON_LINE, KEY), (PLACE_ON_BEAM,), 3, False, RAIL),
    "cylindrical-on-beam": Composition((*ON_LINE, *WITH_LINE), (PLACE_ON_BEAM,), 2, False, RAIL),
    "translational-on-beam": Composition((*ON_LINE, *WITH_LINE, KEY), (PLACE_ON_BEAM,), 1, False, RAIL),
}
