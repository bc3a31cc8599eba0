"""Pairs of bodies that contacts keep apart, as spheres or as convex hulls, and the ways of their points between the frames of a result."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import dataclass
from nivel.machine.bodies.shape import Capsule, Ellipsoid, Sphere
from nivel.machine.bodies.solids import length
from nivel.machine.bodies.touching import Touching
from nivel.machine.core.record import GROUND
from nivel.machine.core.vectors import cross
from nivel.machine.forces.contact import Contact
from nivel.machine.forces.contacts import Contacts
from nivel.machine.machine_record import MachineRecord
from nivel.results.scales import Readable, rotated
from nivel.system.forces.heaps import spheres_between
from nivel.system.forces.hulls import Hull, hull_of, hull_of_points, part_of

Array = NDArray[np.float64]
# speeds of frames differ by less where nothing happened between them
UNCHANGED = 0.2
# straight pieces of the way between two frames
PIECES = 64


@dataclass(frozen=True)
class Way:
    """Place (n, 3) of one point from another at the frames, its rate and its second rate."""

    time: Array
    place: Array
    rate: Array
    bend: Array

    @property
    def length(self) -> Array:
        """(n - 1,) [m] of the ways between frames, at most."""
        speed = np.linalg.norm(self.rate, axis=1)
        return np.diff(self.time) * np.maximum(speed[:-1], speed[1:])

    @property
    def undisturbed(self) -> NDArray[np.bool_]:
        """(n - 1,) whether accelerations at both frames explain the change of the velocity, as on straight lines and arcs: nothing else,
        such as an impact, has happened between them."""
        span, change = np.diff(self.time)[:, None], np.diff(self.rate, axis=0)
        left = np.linalg.norm(change - 0.5 * span * (self.bend[:-1] + self.bend[1:]), axis=1)
        speed = np.linalg.norm(self.rate, axis=1)
        return left < UNCHANGED * np.maximum(speed[:-1], speed[1:])

    def between(self, k: Any, share: Any) -> Array:
        """(…, 3) places at a share of the way from frame k to the next: the cubic with the places and rates at both."""
        s, span = np.asarray(share)[..., None], np.asarray(self.time[k + 1] - self.time[k])[..., None]
        first = (1.0 + 2.0 * s) * self.place[k] + s * span * self.rate[k]
        last = (3.0 - 2.0 * s) * self.place[k + 1] - (1.0 - s) * span * self.rate[k + 1]
        return (1.0 - s) ** 2 * first + s * s * last

    def nearest(self, reach: float) -> tuple[float, float, float] | None:
        """Least distance [m] in an interval at whose ends it is larger than `reach`, its time [s], and for how long it is less [s]."""
        distance = np.linalg.norm(self.place, axis=1)
        apart = np.minimum(distance[:-1], distance[1:])
        # to come within reach and to leave it again takes twice that way
        taken = self.undisturbed & (apart > reach) & (apart - 0.75 * self.length < reach)
        best: tuple[float, float, float] | None = None
        shares = np.linspace(0.0, 1.0, PIECES + 1)
        for k in np.flatnonzero(taken):
            points = self.between(k, shares)
            step = np.diff(points, axis=0)
            square = np.maximum(np.sum(step * step, axis=1), np.finfo(float).tiny)
            part = np.clip(-np.sum(points[:-1] * step, axis=1) / square, 0.0, 1.0)
            least = np.linalg.norm(points[:-1] + part[:, None] * step, axis=1)
            j = int(np.argmin(least))
            if least[j] < reach and (best is None or least[j] < best[0]):
                span = float(self.time[k + 1] - self.time[k])
                speed = np.sqrt(square[j]) * PIECES / span
                lasted = min(2.0 * np.sqrt(reach**2 - least[j] ** 2) / speed, span)
                best = float(least[j]), float(self.time[k] + (j + part[j]) / PIECES * span), float(lasted)
        return best


def way_between(result: Readable, bodies: tuple[str, str], points: tuple[Array, Array]) -> Way:
    """The way of a point of the first body, seen from one of the second in global axes."""
    first, second = (motion_of(result, body, at) for body, at in zip(bodies, points, strict=True))
    return Way(result.time, *(a - b for a, b in zip(first, second, strict=True)))


def motion_of(result: Readable, body: str, at: Array) -> tuple[Array, Array, Array]:
    """Place, velocity and acceleration (n, 3) of a point of a body or the ground."""
    if body == GROUND:
        still = np.zeros((len(result.time), 3))
        return still + at, still, still
    k = result.coordinates["body"].index(body)
    arm = rotated(result.array("orientation")[:, k], at)
    omega, alpha = result.array("angular_velocity")[:, k], result.array("angular_acceleration")[:, k]
    turning = cross(omega, arm)
    bending = cross(alpha, arm) + cross(omega, turning)
    return (
        result.array("position")[:, k] + arm,
        result.array("velocity")[:, k] + turning,
        result.array("acceleration")[:, k] + bending,
    )


def turns_of(result: Readable, body: str) -> Array:
    """Euler parameters (n, 4) of a body or the ground."""
    if body == GROUND:
        return np.tile([1.0, 0.0, 0.0, 0.0], (len(result.time), 1))
    return result.array("orientation")[:, result.coordinates["body"].index(body)]


Array = NDArray[np.float64]
# Overlaps above this share of the distance at which they touch are no touch in passing.
DEEP = 0.05
# Corners of the polyhedron inside a round shape; pairs of a heap times frames that are looked at.
CORNERS, MOST_LOOKS = 42, 2_000_000


@dataclass(frozen=True)
class Pair:
    """A contact of two spheres: its name, bodies, the centres of the spheres in them [m], and the distance at which these touch [m]."""

    contact: str
    bodies: tuple[str, str]
    centres: tuple[Array, Array]
    reach: float


@dataclass(frozen=True)
class HullPair:
    """A contact of two hulls: its name, bodies, and of each hull its middle in the body frame, its corners from there and its faces
    (normal, distance) [m]."""

    contact: str
    bodies: tuple[str, str]
    middles: tuple[Array, Array]
    corners: tuple[Array, Array]
    faces: tuple[Array, Array]

    @property
    def thinnest(self) -> float:
        """[m] of the two least widths between a face and the corners, the smaller one."""
        widths = [
            float((faces[:, 3] - (corners @ faces[:, :3].T).min(axis=0)).min())
            for corners, faces in zip(self.corners, self.faces, strict=True)
        ]
        return min(widths)

    @property
    def reach(self) -> float:
        """[m] between the middles, from which on they cannot touch."""
        return sum(float(np.linalg.norm(corners, axis=1).max()) for corners in self.corners)


def spheres_of(machine: MachineRecord) -> list[Pair]:
    """The contacts of two spheres."""
    out = []
    for force in machine.forces:
        if isinstance(force, Contact) and force.bodies is not None and _are_spheres(machine, force):
            pair = [machine.touching[name] for name in force.bodies]
            (first, one), (second, other) = map(_ball, pair)
            out.append(Pair(force.name, (pair[0].body, pair[1].body), (first, second), one + other))
    return out


def spheres_among(machine: MachineRecord, force: Contacts, result: Readable) -> list[Pair] | None:
    """The pairs of a heap that move so far between two frames that they may pass each other; None where these are too many to look at."""
    names = spheres_between(machine, force)
    balls = [_ball(machine.touching[name]) for name in names]
    if len(result.time) < 2:
        return []
    # [m] the longest way of each between two frames
    span = np.diff(result.time)
    ways = np.zeros(len(names))
    for k, (name, (centre, _)) in enumerate(zip(names, balls, strict=True)):
        speed = np.linalg.norm(motion_of(result, name, centre)[1], axis=1)
        ways[k] = (span * np.maximum(speed[:-1], speed[1:])).max()
    radii = np.array([radius for _, radius in balls])
    # to overlap by the share DEEP of the reach in passing they take at least this chord
    chord = 2.0 * np.sqrt(1.0 - (1.0 - DEEP) ** 2)
    first, second = np.triu_indices(len(names), 1)
    fast = ways[first] + ways[second] > chord * (radii[first] + radii[second])
    if int(fast.sum()) * len(result.time) > MOST_LOOKS:
        return None
    return [
        Pair(force.name, (names[i], names[j]), (balls[i][0], balls[j][0]), float(radii[i] + radii[j]))
        for i, j in zip(first[fast], second[fast], strict=True)
    ]


def hulls_of(machine: MachineRecord) -> list[HullPair]:
    """The contacts of two bodies that are not two spheres."""
    out = []
    for force in machine.forces:
        if isinstance(force, Contact) and force.bodies is not None and not _are_spheres(machine, force):
            pair = [machine.touching[name] for name in force.bodies]
            first, second = (_hull(pair[k], part_of(force, pair, k)) for k in range(2))
            middles, corners = (first.middle, second.middle), (first.corners, second.corners)
            out.append(
                HullPair(force.name, (pair[0].body, pair[1].body), middles, corners, (first.faces, second.faces))
            )
    return out


def _are_spheres(machine: MachineRecord, force: Contact) -> bool:
    return all(isinstance(machine.touching[name].shape, Sphere) for name in force.bodies or ())


def _ball(body: Touching) -> tuple[Array, float]:
    """Centre [m] of a sphere in its body, and its radius [m]."""
    assert isinstance(body.shape, Sphere)  # the record was checked
    return body.position + body.axes @ np.array(body.shape.centre or (0.0, 0.0, 0.0), dtype=float), body.shape.radius


def _hull(body: Touching, part: int | None) -> Hull:
    """The hull of a solid, or a polyhedron inside a round shape, in the frame of the body."""
    found = _hull_of_shape(body, part)
    faces = np.column_stack([found.faces[:, :3] @ body.axes.T, found.faces[:, 3]])
    return Hull(body.position + body.axes @ found.middle, found.corners @ body.axes.T, faces, found.edges)


def _hull_of_shape(body: Touching, part: int | None) -> Hull:
    match body.shape:
        case Sphere() as shape:
            points = shape.radius * _directions()
        case Ellipsoid() as shape:
            points = np.array(shape.semi_axes) * _directions()
        case Capsule() as shape:
            ends = np.zeros((2, 1, 3))
            ends[:, 0, "xyz".index(shape.along or "x")] = 0.5 * length(shape), -0.5 * length(shape)
            points = (ends + shape.radius * _directions()).reshape(-1, 3)
        case _:
            return hull_of(body, part)
    return hull_of_points(points + np.array(shape.centre or (0.0, 0.0, 0.0)))


def _directions() -> Array:
    """(CORNERS, 3) unit vectors that are about evenly apart, on a spiral (Fibonacci)."""
    k = np.arange(CORNERS) + 0.5
    height, turn = 1.0 - 2.0 * k / CORNERS, np.pi * (1.0 + np.sqrt(5.0)) * k
    around = np.sqrt(1.0 - height * height)
    return np.column_stack([around * np.cos(turn), around * np.sin(turn), height])
