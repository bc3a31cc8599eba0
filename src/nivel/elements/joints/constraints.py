"""Joints that are constraints in all coordinates."""

from collections.abc import Callable, Collection
from typing import Any, Final

from nivel.elements.joints.in_trees import ARMS, ARMS_OF_CROSS, CROSS, RAIL, SQUARES
from nivel.elements.joints.kind import (
    ALONG_Z,
    ANGLE,
    DISPLACEMENT,
    NO_SPIN,
    ON_AXIS,
    PARALLEL,
    POINT,
    THIN,
    WITH_AXIS,
    Basic,
    Combination,
    Composition,
    JointCoordinate,
    JointKind,
    Looks,
    Measured,
    PerpendicularAxes,
    PerpendicularDistance,
    X,
    Y,
    sign,
)
from nivel.kernels.bodies.coordinate import COSINE, DISTANCE, MOMENT, POLAR, RADIUS, TRANSLATION
from nivel.kernels.bodies.rolling import CONTACT, SLIP

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
    "distance", Measured(DISTANCE), "m", "between the points of the markers, which drivers and forces may act on"
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
NOT_PARALLEL: dict[str, Any] = {"axes": "not parallel"}
BETWEEN: dict[str, Any] = {
    "place": ("points",),
    "may_size": ("distance",),
    "held": ("distance",),
    "point_mass": "either",
}
BALLS, ON_LEVEL = Looks(ends=("spherical", "spherical")), (0.0, -1.0)


PLANE_GAP: Final = 5.0  # from a point on a plane to the plane in the sign
BALL: Final = '<circle r="4.6"/><circle r="2.4" class="dot"/>'
HINGE: Final = '<circle r="4.6"/><circle r="1.3" class="dot"/>'
SLEEVE: Final = '<rect x="-3.5" y="-6" width="7" height="12" rx="2"/><path d="M0 -9.5V9.5" class="axis"/>'


def _rod(first: str, second: str) -> Callable[[bool], str]:
    """A massless link, small, between the signs of its ends."""
    bar = '<path d="M-11 0H11" class="axis"/>'
    return sign(f'{bar}<g transform="translate(-11 0)">{first}</g><g transform="translate(11 0)">{second}</g>')


BARREL = '<rect x="-9" y="-4" width="11" height="8" rx="1"/><path d="M-4 -4V4M-4 0H11" class="axis"/>'
ENDS = f'<g transform="translate(-12 0)">{BALL}</g><g transform="translate(12 0)">{BALL}</g>'
WHEEL = '<circle r="9"/><circle r="1.6" class="dot"/>'
SLIDING_CROSS = '<path d="M0 -4V4M-4 0H4" class="axis"/>'
AT_POINT = '<rect x="-9" y="-9" width="18" height="18" class="thin"/><circle r="4.2" class="solid"/>'

KINDS = (
    JointKind("distance", ROD, None, _rod(BALL, BALL), BALLS, **BETWEEN),
    JointKind("spherical-spherical", ROD, None, _rod(BALL, BALL), BALLS, **BETWEEN),
    JointKind("variable-distance", Composition((), (VARIED,)), None, sign(BARREL + ENDS), BALLS, place=("points",)),
    # a link that turns about the first marker's z axis and holds the second point
    JointKind(
        "revolute-spherical",
        Composition(
            (Combination("distance", ((Measured(DISTANCE), 1.0),)), Combination("axial", ((ALONG_Z, 1.0),))), (OF_LINK,)
        ),
        None,
        _rod(HINGE, BALL),
        Looks(ends=("revolute", "spherical"), turns=("first",)),
        place=("points", "axis"),
        may=("x_axis",),
        point_mass="second",
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
        _rod(HINGE, SLEEVE),
        Looks(ends=("revolute", "cylindrical"), turns=("first", "second")),
        place=("points", "axes"),
    ),
    # arms of the cross at any angle to each other, which stays as placed: also a cone that rolls on its tip
    JointKind(
        "skew-universal",
        Composition((POINT, SAME_ANGLE), ARMS),
        None,
        sign(f'{ARMS_OF_CROSS}<path d="M-2 8L2 4" class="axis"/>'),
        **(CROSS | NOT_PARALLEL),
    ),
    # a universal joint whose cross slides along z of the first marker, with its arms along x of the first and z of the second
    JointKind(
        "translational-universal",
        Composition((*ON_AXIS, PerpendicularAxes("x", "z")), (DISPLACEMENT,)),
        None,
        sign(RAIL + SLIDING_CROSS, SQUARES + SLIDING_CROSS),
        place=("point", "axis", "axes"),
        axes="perpendicular",
        mirror="sliding",
    ),
    JointKind(
        "point-on-line",
        Composition(ON_AXIS, (DISPLACEMENT,)),
        None,
        sign(
            '<path d="M-17 0H17" class="axis"/><circle r="4.6" class="solid"/>',
            '<circle r="5"/><path d="M-2.6 0H2.6M0 -2.6V2.6" class="axis"/>',
        ),
        Looks("second", ground="line", slides="first"),
        mirror="sliding",
        point_mass="second",
        **WITH_AXIS,
    ),
    JointKind(
        "point-on-plane",
        Composition((PerpendicularDistance("z"),), (X, Y)),
        None,
        sign(f'<path d="M{-PLANE_GAP} -15V15" class="axis"/><circle r="4.2" class="solid"/>', AT_POINT),
        Looks("second", ground="plane", icon=ON_LEVEL),
        point_mass="second",
        **WITH_AXIS,
    ),
    # a pin about z in a slot along z of a third marker
    JointKind(
        "revolute-translational",
        Composition(
            (*PARALLEL, PerpendicularDistance("x", "slot"), PerpendicularDistance("y", "slot")), (ANGLE, IN_SLOT)
        ),
        None,
        sign(
            '<rect x="-15" y="-5.5" width="30" height="11" rx="5.5"/><circle r="3.8" class="solid"/>',
            '<rect x="-6" y="-6" width="12" height="12" rx="3"/><circle r="2.6" class="solid"/>',
        ),
        Looks(turns=("first",), slides="slot"),
        place=("point", "axes"),
        axes="not parallel",
    ),
    JointKind(
        "rolling",
        Composition((ON_PLANE, _slip(0), _slip(1)), OF_WHEEL),
        None,
        sign(f'<path d="M-9 -15V15" class="axis"/>{WHEEL}', WHEEL),
        Looks("second", icon=ON_LEVEL),
        place=("points", "axes"),
        may=("x_axis",),
        size=("radius",),
        may_size=("rim_radius",),
        mirror="sliding",
        opposite="y",
    ),
    # locks nothing by itself
    JointKind(
        "generic",
        generic(()),
        None,
        sign(f'{THIN}<circle r="2.4" class="dot"/>'),
        composed=lambda joint: generic(joint.locked or ()),
        size=("locked",),
        opposite="displacement",
        **WITH_AXIS,
    ),
)
