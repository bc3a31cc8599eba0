"""Pairs of bodies that contacts keep apart, as spheres or as convex hulls, and those that pass through each other between frames.

Two hulls are looked at where the ways between two frames can bring them together. From a place where a face keeps them apart the next one
is as far as this gap allows, and the intervals with the longest ways come first, so that the work is bounded: what is left is told.
"""

from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.known import Contact, Contacts, Hull
from nivel.lazy import Struct, nivel, scipy
from nivel.machine.bodies.shape import Capsule, Ellipsoid, Sphere
from nivel.machine.bodies.solids import length
from nivel.machine.bodies.touching import Touching
from nivel.machine.core.record import GROUND
from nivel.machine.core.vectors import Array, cross
from nivel.machine.machine_record import MachineRecord
from nivel.results.scales import Readable, rotated

# speeds of frames differ by less where nothing happened between them
UNCHANGED = 0.2
# straight pieces of the way between two frames
PIECES = 64


class Way(Struct):
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


class Motions:
    """Motions of points of bodies in a result, each found once."""

    def __init__(self, result: Readable) -> None:
        self.result, self.time = result, result.time
        self._read: dict[str, Array] = {}
        self._points: dict[tuple[str, bytes], tuple[Array, Array, Array]] = {}

    def _array(self, name: str, body: str) -> Array:
        if name not in self._read:
            self._read[name] = self.result.array(name)
        return self._read[name][:, self.result.coordinates["body"].index(body)]

    def between(self, bodies: tuple[str, str], points: tuple[Array, Array]) -> Way:
        """The way of a point of the first body, seen from one of the second in global axes."""
        first, second = (self.of(body, at) for body, at in zip(bodies, points, strict=True))
        return Way(self.time, *(a - b for a, b in zip(first, second, strict=True)))

    def of(self, body: str, at: Array) -> tuple[Array, Array, Array]:
        """Place, velocity and acceleration (n, 3) of a point of a body or the ground."""
        key = body, at.tobytes()
        if key not in self._points:
            self._points[key] = self._find(body, at)
        return self._points[key]

    def _find(self, body: str, at: Array) -> tuple[Array, Array, Array]:
        if body == GROUND:
            still = np.zeros((len(self.time), 3))
            return still + at, still, still
        arm = rotated(self._array("orientation", body), at)
        omega, alpha = self._array("angular_velocity", body), self._array("angular_acceleration", body)
        turning = cross(omega, arm)
        bending = cross(alpha, arm) + cross(omega, turning)
        return (
            self._array("position", body) + arm,
            self._array("velocity", body) + turning,
            self._array("acceleration", body) + bending,
        )

    def turns_of(self, body: str) -> Array:
        """Euler parameters (n, 4) of a body or the ground."""
        still = np.tile([1.0, 0.0, 0.0, 0.0], (len(self.time), 1))
        return still if body == GROUND else self._array("orientation", body)


# Overlaps above this share of the distance at which they touch are no touch in passing.
DEEP = 0.05
# Corners of the polyhedron inside a round shape; pairs of a heap times frames that are looked at.
CORNERS, MOST_OF_HEAP = 42, 2_000_000
# Places on the way through the thinner of two hulls, and at most between two frames.
LOOKS, MOST_IN_INTERVAL = 8, 100
# Places of all pairs of hulls that are looked at; one where they overlap takes as long as so many others.
MOST_LOOKS, LOOKS_OF_OVERLAP = 20_000, 20
# Speeds between two frames by the larger one at both, at most.
FASTER = 1.5


class Pair(Struct):
    """A contact of two spheres: its name, bodies, the centres of the spheres in them [m], and the distance at which these touch [m]."""

    contact: str
    bodies: tuple[str, str]
    centres: tuple[Array, Array]
    reach: float


class HullPair(Struct):
    """A contact of two hulls: its name, bodies, and of each hull its middle in the body frame, its corners from there and its faces
    (normal, distance) [m]."""

    contact: str
    bodies: tuple[str, str]
    middles: tuple[Array, Array]
    corners: tuple[Array, Array]
    faces: tuple[Array, Array]

    @cached_property
    def thinnest(self) -> float:
        """[m] of the two least widths between a face and the corners, the smaller one."""
        hulls = zip(self.corners, self.faces, strict=True)
        return min(float((faces[:, 3] - (corners @ faces[:, :3].T).min(axis=0)).min()) for corners, faces in hulls)

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


def spheres_among(machine: MachineRecord, force: Contacts, motions: Motions) -> list[Pair] | None:
    """The pairs of a heap that move so far between two frames that they may pass each other; None where these are too many to look at."""
    names = nivel.elements.contacts.heap.spheres_between(machine, force)
    balls = [_ball(machine.touching[name]) for name in names]
    if len(motions.time) < 2:
        return []
    # [m] the longest way of each between two frames
    span = np.diff(motions.time)
    ways = np.zeros(len(names))
    for k, (name, (centre, _)) in enumerate(zip(names, balls, strict=True)):
        speed = np.linalg.norm(motions.of(name, centre)[1], axis=1)
        ways[k] = (span * np.maximum(speed[:-1], speed[1:])).max()
    radii = np.array([radius for _, radius in balls])
    # to overlap by the share DEEP of the reach in passing they take at least this chord
    chord = 2.0 * np.sqrt(1.0 - (1.0 - DEEP) ** 2)
    first, second = np.triu_indices(len(names), 1)
    fast = ways[first] + ways[second] > chord * (radii[first] + radii[second])
    if int(fast.sum()) * len(motions.time) > MOST_OF_HEAP:
        return None
    return [
        Pair(force.name, (names[i], names[j]), (balls[i][0], balls[j][0]), float(radii[i] + radii[j]))
        for i, j in zip(first[fast], second[fast], strict=True)
    ]


def hulls_of(machine: MachineRecord) -> list[HullPair]:
    """The contacts of two bodies that are not two spheres."""
    out, known = [], dict[tuple[str, int | None], Any]()
    for force in machine.forces:
        if isinstance(force, Contact) and force.bodies is not None and not _are_spheres(machine, force):
            pair = [machine.touching[name] for name in force.bodies]
            parts = [(pair[k].name, nivel.elements.contacts.shapes.part_of(force, pair, k)) for k in range(2)]
            for body, part in zip(pair, parts, strict=True):
                if part not in known:
                    known[part] = _hull(body, part[1])
            first, second = (known[part] for part in parts)
            middles, corners = (first.middle, second.middle), (first.corners, second.corners)
            bodies = pair[0].body, pair[1].body
            out.append(HullPair(force.name, bodies, middles, corners, (first.faces, second.faces)))
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
    return nivel.elements.contacts.shapes.Hull(
        body.position + body.axes @ found.middle, found.corners @ body.axes.T, faces, found.edges
    )


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
            return nivel.elements.contacts.shapes.hull_of(body, part)
    return nivel.elements.contacts.shapes.hull_of_points(points + np.array(shape.centre or (0.0, 0.0, 0.0)))


def _directions() -> Array:
    """(CORNERS, 3) unit vectors that are about evenly apart, on a spiral (Fibonacci)."""
    k = np.arange(CORNERS) + 0.5
    height, turn = 1.0 - 2.0 * k / CORNERS, np.pi * (1.0 + np.sqrt(5.0)) * k
    around = np.sqrt(1.0 - height * height)
    return np.column_stack([around * np.cos(turn), around * np.sin(turn), height])


class Passed(Struct):
    """A contact of two bodies that were never pushed apart, although they overlapped by the share `overlap` of what `of` says.

    time [s] : where they overlapped most; lasted [s] : how long.
    """

    contact: str
    bodies: tuple[str, str]
    overlap: float
    of: str
    time: float
    lasted: float


class Passing(Struct):
    """The deepest of each pair that passed each other, and the contacts of which not all was looked at."""

    passed: list[Passed]
    unexamined: tuple[str, ...]


def find_passing(machine: MachineRecord, result: Readable) -> Passing:
    """The pairs of spheres and of hulls that passed each other."""
    motions, spheres, unexamined = Motions(result), spheres_of(machine), list[str]()
    for force in machine.forces:
        if isinstance(force, Contacts):
            among = spheres_among(machine, force, motions)
            spheres += among or []
            unexamined += [force.name] * (among is None)
    passed, left = passed_hulls(motions, hulls_of(machine))
    return Passing([*passed_spheres(motions, spheres), *passed], (*unexamined, *left))


def passed_spheres(motions: Motions, pairs: Sequence[Pair]) -> list[Passed]:
    """The deepest of each pair, where the ways between frames lead through the overlap."""
    out = []
    for pair in pairs:
        if found := motions.between(pair.bodies, pair.centres).nearest(pair.reach):
            distance, at, lasted = found
            share = 1.0 - distance / pair.reach
            out.append(Passed(pair.contact, pair.bodies, share, "the distance at which they touch", at, lasted))
    return [each for each in out if each.overlap > DEEP]


def passed_hulls(motions: Motions, pairs: Sequence[HullPair]) -> tuple[list[Passed], tuple[str, ...]]:
    """The deepest of each pair, where the ways between frames lead through the overlap; and the contacts of which intervals are left."""
    intervals = [interval for pair in pairs for interval in _intervals(motions, pair)]
    intervals.sort(key=lambda interval: -interval.length / interval.pair.thinnest)
    deepest, looks = dict[str, Passed](), 0
    for at, interval in enumerate(intervals):
        if looks > MOST_LOOKS:
            return [*deepest.values()], tuple(dict.fromkeys(each.pair.contact for each in intervals[at:]))
        passed, taken = interval.look()
        looks += taken
        if passed is not None and passed.overlap > max(DEEP, getattr(deepest.get(passed.contact), "overlap", 0.0)):
            deepest[passed.contact] = passed
    return [*deepest.values()], ()


class Interval(Struct):
    """Frames k and k + 1, between which two hulls may pass each other. turns : Euler parameters (n, 4) of both bodies. length [m] : of the
    way of any of their points, at most."""

    pair: HullPair
    way: Way
    turns: tuple[Array, Array]
    k: int
    length: float

    def look(self) -> tuple[Passed | None, int]:
        """What passed inside where the hulls are apart at both ends, and how many looks that took."""
        pair, time, k = self.pair, self.way.time, self.k
        begin, end = self._depth_at(0.0), self._depth_at(1.0)
        if begin > 0.0 or end > 0.0 or -begin - end > FASTER * self.length:
            return None, 2
        count = int(np.clip(np.ceil(LOOKS * self.length / pair.thinnest), 2, MOST_IN_INTERVAL))
        # they stay apart until their ways are as long as the gap
        ahead = count / (FASTER * self.length)
        at, looks, overlaps, most, deepest = max(1, int(np.ceil(-begin * ahead))), 2, 0, 0.0, 0
        while at < count:
            depth = self._depth_at(at / count)
            looks += LOOKS_OF_OVERLAP if depth > 0.0 else 1
            overlaps += depth > 0.0
            if depth > most:
                most, deepest = depth, at
            at += max(1, int(np.ceil(-depth * ahead)))
        if most == 0.0:
            return None, looks
        step, share = float(time[k + 1] - time[k]) / count, most / pair.thinnest
        of, when = "the thinner one's width", float(time[k] + deepest * step)
        return Passed(pair.contact, pair.bodies, share, of, when, overlaps * step), looks

    def _depth_at(self, share: float) -> float:
        first, second = (_between(turn, self.k, share) for turn in self.turns)
        return _depth(self.pair, self.way.between(self.k, share), first, second)


def _intervals(motions: Motions, pair: HullPair) -> list[Interval]:
    """Those in which two hulls may come together. What turns reaches its faces on arcs: corners move as far as their distance from the
    middle times the angle."""
    bodies, middles = pair.bodies, pair.middles
    way = motions.between((bodies[1], bodies[0]), (middles[1], middles[0]))
    length, distance = way.length, np.linalg.norm(way.place, axis=1)
    near = np.minimum(distance[:-1], distance[1:]) - 0.5 * length < pair.reach
    if not near.any():
        return []
    turns = motions.turns_of(bodies[0]), motions.turns_of(bodies[1])
    radii = [float(np.linalg.norm(corners, axis=1).max()) for corners in pair.corners]
    length = length + sum(radius * _angles(turn) for radius, turn in zip(radii, turns, strict=True))
    fast = near & (length > pair.thinnest / LOOKS)
    if not fast.any():
        return []
    return [Interval(pair, way, turns, int(k), float(length[k])) for k in np.flatnonzero(fast & way.undisturbed)]


def _angles(theta: Array) -> Array:
    """(n - 1,) [rad] by which a body turns from frame to frame, the shorter way."""
    cosine = np.abs(np.sum(theta[:-1] * theta[1:], axis=1))
    return 2.0 * np.arccos(np.minimum(cosine, 1.0))


def _between(theta: Array, k: int, share: float) -> Array:
    """Euler parameters at a share of the way from frame k to the next, along the shorter turn."""
    there = theta[k + 1] if theta[k] @ theta[k + 1] >= 0.0 else -theta[k + 1]
    mean = (1.0 - share) * theta[k] + share * there
    return mean / np.linalg.norm(mean)


def _depth(pair: HullPair, r: Array, first: Array, second: Array) -> float:
    """[m] by which two hulls overlap, r from the first middle to the second; the gap, negative, where a face keeps them apart; 0 where
    edges do."""
    normals = [rotated(turn, faces[:, :3]) for turn, faces in zip((first, second), pair.faces, strict=True)]
    corners = [rotated(turn, points) for turn, points in zip((first, second), pair.corners, strict=True)]
    of_first = pair.faces[0][:, 3] - ((corners[1] + r) @ normals[0].T).min(axis=0)
    of_second = pair.faces[1][:, 3] - ((corners[0] - r) @ normals[1].T).min(axis=0)
    least = float(min(of_first.min(), of_second.min()))
    if least <= 0.0:
        return least
    rows = np.vstack([np.column_stack([n, np.ones(len(n))]) for n in normals])
    heights = np.concatenate([pair.faces[0][:, 3], pair.faces[1][:, 3] + normals[1] @ r])
    deepest = scipy.optimize.linprog([0.0, 0.0, 0.0, -1.0], rows, heights, bounds=[(None, None)] * 4)
    return 2.0 * max(float(deepest.x[3]), 0.0) if deepest.success else 0.0
