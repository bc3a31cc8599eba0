"""Joints that are constraints in all coordinates."""

from __future__ import annotations

from collections.abc import Collection
from typing import Final

from nivel.kernels.bodies.coordinate import COSINE, DISTANCE, MOMENT, POLAR, RADIUS, TRANSLATION
from nivel.kernels.bodies.rolling import CONTACT, SLIP
from nivel.system.joints import symbols
from nivel.system.joints.composition import (
    ALONG_Z,
    ANGLE,
    DISPLACEMENT,
    NO_SPIN,
    ON_AXIS,
    PARALLEL,
    POINT,
    Basic,
    Combination,
    Composition,
    JointCoordinate,
    Measured,
    PerpendicularAxes,
    PerpendicularDistance,
    X,
    Y,
)
from nivel.system.joints.kind import JointKind, Looks
from nivel.system.joints.kinds.in_trees import ARMS

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
    note = f"locked: {', '.join(locked)}" if locked else ""
    return Composition((*at, *LOCKS[turns]), (X, Y, DISPLACEMENT, ANGLE), note=note)


def _slip(axis: int) -> Combination:
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
OF_WHEEL = (
    JointCoordinate("x", X.measured, "m", "of the wheel's centre along the x axis of the plane's marker"),
    JointCoordinate("y", Y.measured, "m", "along its y axis; normal force and friction act on the wheel"),
)
HELD = JointCoordinate("distance", Measured(DISTANCE), "m", "between the points of the markers, held by the joint")
VARIED = JointCoordinate(
    "distance",
    Measured(DISTANCE),
    "m",
    "between the points of the markers, which drivers and forces may act on",
)
OF_LINK = JointCoordinate(
    "angle",
    Measured(POLAR),
    "rad",
    "right-handed turn of the link about the first marker's z axis, zero where the second point is on its x side",
)
IN_SLOT = JointCoordinate(
    "displacement",
    Measured(TRANSLATION, 2, "slot"),
    "m",
    "of the first marker's point from the second's along the slot in the second body",
)
ROD = Composition((Combination("distance", ((Measured(DISTANCE), 1.0),), given="distance"),), (HELD,))
SAME_ANGLE = Combination("axes", ((Measured(COSINE, 8), 1.0),), units="1")
BALLS, ON_LEVEL = Looks(ends=("spherical", "spherical")), (0.0, -1.0)

KINDS = (
    JointKind("distance", ROD, None, symbols.rod(symbols.BALL, symbols.BALL), BALLS),
    JointKind("spherical-spherical", ROD, None, symbols.rod(symbols.BALL, symbols.BALL), BALLS),
    JointKind("variable-distance", Composition((), (VARIED,)), None, symbols.cylinder, BALLS),
    # a link that turns about the first marker's z axis and holds the second point
    JointKind(
        "revolute-spherical",
        Composition(
            (Combination("distance", ((Measured(DISTANCE), 1.0),)), Combination("axial", ((ALONG_Z, 1.0),))), (OF_LINK,)
        ),
        None,
        symbols.rod(symbols.HINGE, symbols.BALL),
        Looks(ends=("revolute", "spherical"), turns=("first",)),
    ),
    # a link that turns about the axis a = z_1 and holds the line b = z_2: angle, common normal (times the sine of the angle),
    # and foot of the common normal on the first axis, s (1 - (aᵀb)²) = aᵀd - (aᵀb) bᵀd, keep their values
    JointKind(
        "revolute-cylindrical",
        Composition(
            (
                SAME_ANGLE,
                Combination("normal", ((Measured(MOMENT), 1.0),)),
                Combination("axial", ((ALONG_Z, 1.0), (Measured(TRANSLATION, 2, "second"), lambda _, cosine: cosine))),
            ),
            when_parallel=Composition((*PARALLEL, Combination("normal", ((Measured(RADIUS), 1.0),)))),
        ),
        None,
        symbols.rod(symbols.HINGE, symbols.SLEEVE),
        Looks(ends=("revolute", "cylindrical"), turns=("first", "second")),
    ),
    # arms of the cross at any angle to each other, which stays as placed: also a cone that rolls on its tip
    JointKind("skew-universal", Composition((POINT, SAME_ANGLE), ARMS), None, symbols.skew_universal),
    # a universal joint whose cross slides along z of the first marker, with its arms along x of the first and z of the second
    JointKind(
        "translational-universal",
        Composition((*ON_AXIS, PerpendicularAxes("x", "z")), (DISPLACEMENT,)),
        None,
        symbols.translational_universal,
    ),
    JointKind(
        "point-on-line",
        Composition(ON_AXIS, (DISPLACEMENT,)),
        None,
        symbols.point_on_line,
        Looks("second", ground="line", slides="first"),
    ),
    JointKind(
        "point-on-plane",
        Composition((PerpendicularDistance("z"),), (X, Y)),
        None,
        symbols.point_on_plane,
        Looks("second", ground="plane", icon=ON_LEVEL),
    ),
    # a pin about z in a slot along z of a third marker
    JointKind(
        "revolute-translational",
        Composition(
            (*PARALLEL, PerpendicularDistance("x", "slot"), PerpendicularDistance("y", "slot")), (ANGLE, IN_SLOT)
        ),
        None,
        symbols.pin_in_slot,
        Looks(turns=("first",), slides="slot"),
    ),
    JointKind(
        "rolling",
        Composition((ON_PLANE, _slip(0), _slip(1)), OF_WHEEL),
        None,
        symbols.rolling,
        Looks("second", icon=ON_LEVEL),
    ),
    # locks nothing by itself
    JointKind("generic", generic(()), None, symbols.generic, composed=lambda joint: generic(joint.locked or ())),
)
