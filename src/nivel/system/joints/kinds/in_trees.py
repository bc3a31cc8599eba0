"""Joints that can stand in the tree of relative coordinates."""

from __future__ import annotations

from collections.abc import Callable
from math import pi

import numpy as np

from nivel.kernels.bodies.coordinate import (
    ACROSS_Y,
    ACROSS_Z,
    ALONG,
    CROSS_FIRST,
    CROSS_SECOND,
    LEAN_X,
    LEAN_Y,
    ROTATION,
    TWIST,
)
from nivel.kernels.record import record as kernels
from nivel.machine.core.orientation import euler_parameters_from_matrix, product
from nivel.machine.joints.joint import Joint
from nivel.system.joints import symbols
from nivel.system.joints.composition import (
    ALONG_Z,
    ANGLE,
    DISPLACEMENT,
    NO_SPIN,
    ON_AXIS,
    PARALLEL,
    POINT,
    SLIDE,
    Combination,
    Composition,
    JointCoordinate,
    Measured,
    PerpendicularAxes,
    PerpendicularDistance,
    X,
    Y,
)
from nivel.system.joints.kind import JointKind, Looks, Seen, Start, TreeJoint
from nivel.system.tables import Array


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


Numbers = Callable[[Joint, float, float], tuple[float, float]]
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
END_ON = (0.0, 0.0)


def _on_rail(name: str, kind: int, units: str = "m") -> Combination:
    """A row that holds a coordinate of a slider on a beam at zero."""
    return Combination(name, ((Measured(kind, seen_from="rail"), 1.0),), units=units, zero=True)


ON_LINE = (_on_rail("across.y", ACROSS_Y), _on_rail("across.z", ACROSS_Z))
WITH_LINE = (_on_rail("lean.x", LEAN_X, "1"), _on_rail("lean.y", LEAN_Y, "1"))
KEY = _on_rail("twist", TWIST, "1")
BLOCK, DOT = '<rect x="-8" y="-5" width="16" height="10"', '<circle r="4.2" class="solid"/>'
LINE = '<path d="M0 -9.5V-4" class="axis"/>'
PLACE_ON_BEAM = JointCoordinate(
    "displacement",
    Measured(ALONG, seen_from="rail"),
    "m",
    "of the point along the beam, in unstressed length from its start; the joint's z axis is that of the beam, its x axis the sections' y",
)


def _slider(motion: int, *turns: str, turning: bool = False) -> TreeJoint:
    """Of a body that a beam carries: its place along the beam, and angles in the axes of the beam there."""
    units = ("m", *("1",) * (4 if turning else len(turns)))
    return TreeJoint(motion, units, turning=turning, coordinates=("displacement", *turns))


def _on_beam(word: str, rows: tuple[Combination, ...], tree: TreeJoint, slider: str) -> JointKind:
    """Of a body that a beam carries; its start is in `nivel.system.states.joint_start`."""
    return JointKind(word, Composition((*ON_LINE, *rows), (PLACE_ON_BEAM,)), tree, symbols.on_beam(slider))


KINDS = (
    JointKind(
        "revolute",
        Composition((POINT, *PARALLEL), (ANGLE,)),
        _by_coordinates(kernels.REVOLUTE, "angle"),
        symbols.revolute,
        Looks(turns=("first",), icon=END_ON),
        {"spherical": OF_POINT, "cylindrical": ("s.axis", "d1.xz", "d1.yz"), "point-on-line": ("s.axis",)},
    ),
    JointKind(
        "translational",
        Composition((*PARALLEL, *ON_AXIS, NO_SPIN), (DISPLACEMENT,)),
        _by_coordinates(kernels.TRANSLATIONAL, "displacement"),
        symbols.translational,
        Looks("moving", ground="rail", slides="first"),
        {"cylindrical": ("d1.xz", "d1.yz", "d2.x", "d2.y"), "point-on-line": ("d2.x", "d2.y")},
    ),
    JointKind(
        "cylindrical",
        Composition((*PARALLEL, *ON_AXIS), (ANGLE, DISPLACEMENT)),
        _by_coordinates(kernels.CYLINDRICAL, "angle", "displacement"),
        symbols.cylindrical,
        Looks("moving", ground="rail", turns=("first",)),
        {"point-on-line": ("d2.x", "d2.y")},
        without_turn="translational",
    ),
    JointKind(
        "screw",
        Composition((*PARALLEL, *ON_AXIS, SCREW), (ANGLE, ADVANCE)),
        _by_coordinates(
            kernels.SCREW, "angle", numbers=lambda joint, angle, d: (_lead(joint), d - _lead(joint) * angle)
        ),
        symbols.screw,
        Looks("moving", ground="rail", slides="first"),
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
        symbols.universal,
        Looks(icon=END_ON),
        {"spherical": OF_POINT},
    ),
    JointKind(
        "spherical",
        Composition((POINT,)),
        TreeJoint(kernels.SPHERICAL, ("1",) * 4, _start_spherical, lambda q, _: np.array(q), turning=True),
        symbols.spherical,
        Looks(icon=END_ON),
        without_turn="universal",
    ),
    JointKind(
        "planar",
        Composition((*PARALLEL, PerpendicularDistance("z")), (X, Y, ANGLE)),
        # along the axes of the second marker, which turn against those of the first
        _by_coordinates(kernels.PLANAR, "x", "y", "angle", backwards=("x_from_second", "y_from_second", "angle")),
        symbols.planar,
        Looks("second", ground="plane", turns=("first",), icon=(0.0, -1.0)),
        {"point-on-plane": ("d2.z",)},
    ),
    JointKind(
        "fixed",
        Composition((POINT, *PARALLEL, NO_SPIN)),
        _by_coordinates(kernels.FIXED),
        symbols.fixed,
        Looks(icon=END_ON),
        {"spherical": OF_POINT, "revolute": (*OF_POINT, "d1.xz", "d1.yz")},
    ),
    _on_beam("point-on-beam", (), _slider(kernels.POINT_ON_BEAM, turning=True), DOT),
    _on_beam("keyed-on-beam", (KEY,), _slider(kernels.KEYED_ON_BEAM, "turn_1", "turn_2"), f"{DOT}{LINE}"),
    _on_beam("cylindrical-on-beam", WITH_LINE, _slider(kernels.CYLINDRICAL_ON_BEAM, "turn"), f'{BLOCK} rx="2.5"/>'),
    _on_beam(
        "translational-on-beam",
        (*WITH_LINE, KEY),
        _slider(kernels.TRANSLATIONAL_ON_BEAM),
        f'{BLOCK} class="solid"/>',
    ),
)
