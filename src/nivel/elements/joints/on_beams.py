"""Joints that slide along a beam: what holds them on it, which nodes they may come by, and where they start."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.elements.joints.kind import (
    Array,
    Combination,
    Composition,
    JointCoordinate,
    JointKind,
    Measured,
    TreeJoint,
    sign,
)
from nivel.errors import Fault, ModelError, gathered, refuse
from nivel.kernels.bodies.coordinate import ACROSS_Y, ACROSS_Z, ALONG, LEAN_X, LEAN_Y, TWIST
from nivel.kernels.record import record as kernels
from nivel.known import Beam
from nivel.lazy import scipy
from nivel.machine.core.record import Problem

SAMPLES = 8  # of the line between two nodes, from which the nearest point is looked for
OFF = 1e-3  # of the length of a beam by which the point of a joint may miss its line: the joint is on the line


class OnBeam(Joint):
    """A joint whose second body is a beam, as placed: on the line through its nodes, axis along the line and x along the sections' y.

    Its second body is the nearest node. nodes : all nodes of the beam as bodies. stations : their places along its unstressed line [m].
    place : that of the joint's point.
    """

    nodes: tuple[str, ...] = ()
    stations: tuple[float, ...] = ()
    place: float = 0.0

    def problems(self) -> Iterator[Problem]:
        """None: the joint that it is made of was checked."""
        yield from ()


def on_beams(joints: Sequence[Joint], beams: Sequence[Beam]) -> tuple[Joint, ...]:
    """The joints, those that slide along one of the `beams` as `OnBeam`. Raises ModelError where their points are beside the beam."""
    named, made, faults = {beam.name: beam for beam in beams}, [], []
    for joint in joints:
        with gathered(faults):
            made.append(_on_beam(joint, named))
    refuse(faults)
    return tuple(made)


def stretches(nodes: Sequence[int], *, turned: bool) -> Iterator[tuple[int, ...]]:
    """The nodes of a beam that a slider looks at at one time, for each place along it: two, and the next ones where they turn it."""
    more = 1 if turned else 0
    return (tuple(nodes[max(e - more, 0) : e + 2 + more]) for e in range(len(nodes) - 1))


def _on_beam(joint: Joint, beams: dict[str, Beam]) -> Joint:
    if not JOINTS[joint.type].rail or joint.bodies is None or joint.bodies[1] not in beams:
        return joint
    assert joint.point is not None  # the record was checked
    beam = beams[joint.bodies[1]]
    stations = beam.line.length * beam.shares
    places, axes = beam.frames(beam.shares)
    place, point = _nearest(stations, places, axes[:, :, 0], np.array(joint.point))
    gap = float(np.linalg.norm(point - joint.point))
    if gap > OFF * beam.line.length:
        near = ", ".join(f"{x:.6g}" for x in point)
        message = f"the `point` is {gap:.3g} m beside the line of the beam `{beam.name}`; the nearest point on it is [{near}] m"
        raise ModelError(Fault("", 0, 0, f"joints.{joint.name}.point", message))
    e = element_of(stations, place)
    along, across = (between(stations, axes[:, :, k], e)(place) for k in (0, 1))
    across -= (across @ along) * along / (along @ along)
    given: dict[str, Any] = {name: getattr(joint, name) for name in type(joint).model_fields}
    given |= {
        "bodies": (joint.bodies[0], beam.node_names[int(np.argmin(np.abs(stations - place)))]),
        "point": tuple(point.tolist()),
        "axis": tuple(along.tolist()),
        "x_axis": tuple(across.tolist()),
        "nodes": beam.node_names,
        "stations": tuple(stations.tolist()),
        "place": place,
    }
    return OnBeam.model_construct(joint.model_fields_set | {"axis", "x_axis"}, **given)


def element_of(stations: Array, place: float) -> int:
    """Number of the node before a place, of those that are not the last; at a node the one before it."""
    return min(max(int(np.searchsorted(stations, place, side="left")) - 1, 0), len(stations) - 2)


def between(stations: Array, values: Array, e: int) -> Any:
    """An axis of the sections, or its rate, between the nodes e and e + 1, from its values (N, 3) at all nodes: slopes at nodes are those
    between their neighbours. A spline of scipy."""
    slopes = []
    for n in (e, e + 1):
        before, after = max(n - 1, 0), min(n + 1, len(values) - 1)
        slopes.append((values[after] - values[before]) / (stations[after] - stations[before]))
    return scipy.interpolate.CubicHermiteSpline(stations[e : e + 2], values[e : e + 2], np.array(slopes))


def _nearest(stations: Array, places: Array, tangents: Array, point: Array) -> tuple[float, Array]:
    """Where the line through the nodes is nearest to a global point (3,): place along the beam [m], and the point there."""
    line = scipy.interpolate.CubicHermiteSpline(stations, places, tangents)
    samples = np.linspace(stations[0], stations[-1], SAMPLES * (len(stations) - 1) + 1)
    k = int(np.argmin(np.linalg.norm(line(samples) - point, axis=1)))
    low, high = float(samples[max(k - 1, 0)]), float(samples[min(k + 1, len(samples) - 1)])

    def square(s: float) -> float:
        return float(np.sum((line(s) - point) ** 2))

    found = scipy.optimize.minimize_scalar(
        square, bounds=(low, high), method="bounded", options={"xatol": 1e-12 * float(stations[-1])}
    )
    place = min((float(found.x), low, high), key=square)
    return place, line(place)


def _on_rail(name: str, kind: int, units: str = "m") -> Combination:
    """A row that holds a coordinate of a slider on a beam at zero."""
    return Combination(name, ((Measured(kind, seen_from="rail"), 1.0),), units=units, zero=True)


ON_LINE = (_on_rail("across.y", ACROSS_Y), _on_rail("across.z", ACROSS_Z))
WITH_LINE = (_on_rail("lean.x", LEAN_X, "1"), _on_rail("lean.y", LEAN_Y, "1"))
KEY = _on_rail("twist", TWIST, "1")
BENT = '<path d="M-17 4Q0 -4 17 4" class="axis"/>'  # a line that bends, on which they slide
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


def _sliding(word: str, rows: tuple[Combination, ...], tree: TreeJoint, slider: str) -> JointKind:
    """Of a body that a beam carries; its start is in `nivel.system.states.joint_start`."""
    return JointKind(
        word,
        Composition((*ON_LINE, *rows), (PLACE_ON_BEAM,)),
        tree,
        sign(f"{BENT}{slider}"),
        place=("point",),
        rail=True,
    )


KINDS = (
    _sliding("point-on-beam", (), _slider(kernels.POINT_ON_BEAM, turning=True), DOT),
    _sliding("keyed-on-beam", (KEY,), _slider(kernels.KEYED_ON_BEAM, "turn_1", "turn_2"), f"{DOT}{LINE}"),
    _sliding("cylindrical-on-beam", WITH_LINE, _slider(kernels.CYLINDRICAL_ON_BEAM, "turn"), f'{BLOCK} rx="2.5"/>'),
    _sliding(
        "translational-on-beam", (*WITH_LINE, KEY), _slider(kernels.TRANSLATIONAL_ON_BEAM), f'{BLOCK} class="solid"/>'
    ),
)
