"""Joints that can stand in the tree of relative coordinates."""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from nivel.elements.joints.kind import (
    ALONG_Z,
    ANGLE,
    DISPLACEMENT,
    NO_SPIN,
    ON_AXIS,
    PARALLEL,
    POINT,
    SIGN,
    SLIDE,
    WITH_AXIS,
    Array,
    Combination,
    Composition,
    JointCoordinate,
    JointKind,
    Looks,
    Measured,
    PerpendicularAxes,
    PerpendicularDistance,
    Seen,
    Start,
    TreeJoint,
    X,
    Y,
    sign,
)
from nivel.kernels.bodies.coordinate import CROSS_FIRST, CROSS_SECOND, ROTATION
from nivel.kernels.record import record as kernels
from nivel.machine.core.orientation import euler_parameters_from_matrix, product

if TYPE_CHECKING:
    from nivel.elements.joints.joint import Joint

    Numbers = Callable[[Joint, float, float], tuple[float, float]]


def _by_coordinates(
    motion: int, *names: str, numbers: Numbers | None = None, backwards: tuple[str, ...] = ()
) -> TreeJoint:
    """Of a joint that turns by an `angle` about z and moves by x, y and a displacement along z, in this order of its positions.

    numbers(joint, its angle, its displacement) : the first two of it. backwards : as of `TreeJoint`.
    """
    at = [("x", "y", "displacement", "angle").index(name) for name in names]
    turned = "angle" in names

    def start(seen: Seen, joint: Joint | None) -> Start:
        angle = float(np.arctan2(seen.Q[1, 0], seen.Q[0, 0]))
        own = (0.0, 0.0) if numbers is None or joint is None else numbers(joint, angle, seen.d[2])
        # markers that are given may be half a turn apart where nothing turns
        cosine = 1.0 if turned else float(np.cos(float(np.round(angle / np.pi)) * np.pi))
        places, rates = (*seen.d, angle), (*seen.velocity, seen.omega[2])
        return Start([places[k] for k in at], [rates[k] for k in at], (*own, cosine, 0.0))

    def turn(q: list[float], number: Array) -> Array:
        return _about_z(q[names.index("angle")]) if turned else HALF if number[2] < 0.0 else NONE

    units = tuple("1" if name == "angle" else "m" for name in names)
    angles = {ROTATION: names.index("angle")} if turned else {}
    return TreeJoint(motion, units, start, turn, angles, coordinates=names, backwards=backwards)


def _start_universal(seen: Seen, joint: Joint | None) -> Start:
    Q, w = seen.Q, seen.omega
    arm = Q[:, 2]
    first, second = float(np.arctan2(arm[1], arm[0])), -float(np.arctan2(Q[2, 1], Q[2, 0]))
    return Start([first, second], [w[2], float(arm @ w)])  # the second marker's rate about its own z axis


def _start_spherical(seen: Seen, joint: Joint | None) -> Start:
    return Start([*euler_parameters_from_matrix(seen.Q)], [*(seen.Q.T @ seen.omega)])


def _start_free(seen: Seen, joint: Joint | None) -> Start:
    turning = _start_spherical(seen, joint)
    return Start([*seen.d, *turning.positions], [*seen.velocity, *turning.velocities])


def _about_z(angle: float) -> Array:
    return np.array([np.cos(0.5 * angle), 0.0, 0.0, np.sin(0.5 * angle)])


def _turn_of_cross(q: list[float], number: Array) -> Array:
    return product(product(_about_z(q[0]), np.array([0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5)])), _about_z(q[1]))


NONE, HALF = np.array([1.0, 0.0, 0.0, 0.0]), np.array([0.0, 0.0, 0.0, 1.0])  # turns about z
FREE_BODY = TreeJoint(
    kernels.FREE,
    ("m",) * 3 + ("1",) * 4,
    _start_free,
    lambda q, _: np.array(q[3:]),
    turning=True,
    coordinates=("x", "y", "z"),
)
OF_POINT = ("s.x", "s.y", "s.z")


def _lead(joint: Joint) -> float:
    """Of a screw [m/rad]."""
    return (joint.pitch or 0.0) / (2 * pi)


SCREW = Combination("screw", ((ALONG_Z, 1.0), (Measured(ROTATION), lambda joint, _: -_lead(joint))))
ADVANCE = JointCoordinate("displacement", ALONG_Z, "m", f"{SLIDE}: pitch times the turns, from where it is placed")
ARMS = (
    JointCoordinate(
        "angle_1",
        Measured(CROSS_FIRST),
        "rad",
        "right-handed turn of the cross about its arm on the first body (z of the first marker), zero where the first x axis lies "
        "along the other arm",
    ),
    JointCoordinate(
        "angle_2",
        Measured(CROSS_SECOND),
        "rad",
        "of the second body about its arm (z of the second marker), zero where the second x axis lies along the first body's arm",
    ),
)
CROSS: dict[str, Any] = {"place": ("point", "axes"), "axes": "perpendicular", "mirror": "arms"}
END_ON = (0.0, 0.0)


SQUARES = '<rect x="-6" y="-6" width="12" height="12"/><rect x="-2.5" y="-2.5" width="5" height="5" class="thin"/>'
RAIL = '<path d="M-17 -6.5H17M-17 6.5H17" class="axis"/><rect x="-9" y="-4.5" width="18" height="9"/>'
SCREW_AXIS = '<path d="M-15 0H15" class="axis"/><rect x="-8" y="-5" width="16" height="10" rx="1"/>'
THREAD = '<path d="M-8 5l4 -10M-4 5l4 -10M0 5l4 -10M4 5l4 -10" class="thin"/>'
SLEEVE_AXIS = '<path d="M-15 0H15" class="axis"/><rect x="-8" y="-5" width="16" height="10" rx="2.5"/>'
ARMS_OF_CROSS = f'<circle r="{SIGN}"/><path d="M-4.4 -4.4L4.4 4.4M-4.4 4.4L4.4 -4.4" class="axis"/>'
FOUR_ARROWS = "M0 -10l-2.6 4h5.2zM0 10l-2.6 -4h5.2zM-10 0l4 -2.6v5.2zM10 0l-4 -2.6v5.2z"


KINDS = (
    JointKind(
        "revolute",
        Composition((POINT, *PARALLEL), (ANGLE,)),
        _by_coordinates(kernels.REVOLUTE, "angle"),
        sign(
            '<rect x="-9" y="-5" width="18" height="10" rx="2.5"/><path d="M-14 0H14" class="axis"/>',
            f'<circle r="{SIGN}"/><circle r="1.6" class="dot"/>',
        ),
        Looks(turns=("first",), icon=END_ON),
        {"spherical": OF_POINT, "cylindrical": ("s.axis", "d1.xz", "d1.yz"), "point-on-line": ("s.axis",)},
        **WITH_AXIS,
    ),
    JointKind(
        "translational",
        Composition((*PARALLEL, *ON_AXIS, NO_SPIN), (DISPLACEMENT,)),
        _by_coordinates(kernels.TRANSLATIONAL, "displacement"),
        sign(RAIL, SQUARES),
        Looks("moving", ground="rail", slides="first"),
        {"cylindrical": ("d1.xz", "d1.yz", "d2.x", "d2.y"), "point-on-line": ("d2.x", "d2.y")},
        mirror="sliding",
        **WITH_AXIS,
    ),
    JointKind(
        "cylindrical",
        Composition((*PARALLEL, *ON_AXIS), (ANGLE, DISPLACEMENT)),
        _by_coordinates(kernels.CYLINDRICAL, "angle", "displacement"),
        sign(
            f'{SLEEVE_AXIS}<path d="M-15.5 0l4-2.6v5.2zM15.5 0l-4-2.6v5.2z" class="dot"/>',
            f'<circle r="{SIGN}"/><circle r="3" class="thin"/>',
        ),
        Looks("moving", ground="rail", turns=("first",)),
        {"point-on-line": ("d2.x", "d2.y")},
        without_turn="translational",
        opposite="displacement",
        **WITH_AXIS,
    ),
    JointKind(
        "screw",
        Composition((*PARALLEL, *ON_AXIS, SCREW), (ANGLE, ADVANCE)),
        _by_coordinates(
            kernels.SCREW, "angle", numbers=lambda joint, angle, d: (_lead(joint), d - _lead(joint) * angle)
        ),
        sign(SCREW_AXIS + THREAD, f'<circle r="{SIGN}"/><path d="M3.4 0A3.4 3.4 0 1 1 0 -3.4" class="axis"/>'),
        Looks("moving", ground="rail", slides="first"),
        size=("pitch",),
        opposite="displacement",
        **WITH_AXIS,
    ),
    JointKind(
        "universal",
        Composition((POINT, PerpendicularAxes("z", "z")), ARMS),
        TreeJoint(
            kernels.UNIVERSAL,
            ("1", "1"),
            _start_universal,
            _turn_of_cross,
            {CROSS_FIRST: 0, CROSS_SECOND: 1},
            coordinates=("angle_1", "angle_2"),
            backwards=("angle_2", "angle_1"),
        ),
        sign(ARMS_OF_CROSS),
        Looks(icon=END_ON),
        {"spherical": OF_POINT},
        **CROSS,
    ),
    JointKind(
        "spherical",
        Composition((POINT,)),
        TreeJoint(kernels.SPHERICAL, ("1",) * 4, _start_spherical, lambda q, _: np.array(q), turning=True),
        sign(f'<circle r="{SIGN}"/><circle r="3.6" class="dot"/>'),
        Looks(icon=END_ON),
        without_turn="universal",
        place=("point",),
        point_mass="either",
    ),
    JointKind(
        "planar",
        Composition((*PARALLEL, PerpendicularDistance("z")), (X, Y, ANGLE)),
        # along the axes of the second marker, which turn against those of the first
        _by_coordinates(kernels.PLANAR, "x", "y", "angle", backwards=("x_from_second", "y_from_second", "angle")),
        sign(
            '<rect x="-2.5" y="-8" width="7" height="16"/><path d="M-5 -15V15" class="axis"/>',
            f'<rect x="-10.5" y="-10.5" width="21" height="21" rx="2"/><path d="{FOUR_ARROWS}" class="dot"/>',
        ),
        Looks("second", ground="plane", turns=("first",), icon=(0.0, -1.0)),
        {"point-on-plane": ("d2.z",)},
        **WITH_AXIS,
    ),
    JointKind(
        "fixed",
        Composition((POINT, *PARALLEL, NO_SPIN)),
        _by_coordinates(kernels.FIXED),
        sign('<rect x="-5.5" y="-5.5" width="11" height="11" class="solid"/>'),
        Looks(icon=END_ON),
        {"spherical": OF_POINT, "revolute": (*OF_POINT, "d1.xz", "d1.yz")},
        place=("point",),
    ),
)
