"""Contacts in passing: spheres, and convex hulls, that go through each other between two frames, because steps are too long to see it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.subject import Run
from nivel.machine.bodies.shape import Sphere
from nivel.machine.core.vectors import cross
from nivel.machine.forces import Contact
from nivel.machine.machine_record import MachineRecord
from nivel.results.scales import Readable, rotated
from nivel.results.trust import Item, number
from nivel.system.forces.hulls import hull_of, part_of

Array = NDArray[np.float64]
# Overlaps above this share of the distance at which they touch are no touch in passing; speeds of frames differ by less where nothing
# happened between them.
DEEP, UNCHANGED = 0.05, 0.2
SHOWN = 5  # contacts of which each has a line
# straight pieces of the way between two frames
PIECES = 64
# Places looked at on the way through the thinner hull, and at most between two frames; intervals between frames that are looked at.
LOOKS, MOST_LOOKS, MOST_INTERVALS = 8, 100, 100


@dataclass(frozen=True)
class Pair:
    """A contact of two spheres: its name, bodies, the centres of the spheres in them [m], and the distance at which these touch [m]."""

    contact: str
    bodies: tuple[str, str]
    centres: tuple[Array, Array]
    reach: float


@dataclass(frozen=True)
class Passed:
    """A contact of two bodies that were never pushed apart, although they overlapped by the share `overlap` of what `of` says.

    time [s] : where they overlapped most; lasted [s] : how long.
    """

    contact: str
    bodies: tuple[str, str]
    overlap: float
    of: str
    time: float
    lasted: float


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


def look(run: Run) -> list[Passed]:
    """The pairs of spheres and of hulls that passed each other."""
    spheres, hulls = spheres_of(run.machine), hulls_of(run.machine)
    return [*passed_spheres(run.result, spheres), *passed_hulls(run.result, hulls)][:SHOWN]


def say(found: Passed) -> Item:
    """Who passed whom, and what the step has to be."""
    text = (
        f"Contact: {' and '.join(found.bodies)} pass through each other at t = {found.time:.6g} s, by {number(found.overlap)} of "
        f"{found.of}, and {found.contact} does not push them apart: they overlap for only "
        f"{number(found.lasted)} s; use steps of {number(found.lasted / 10.0)} s, or a method that chooses its steps "
        f"(green if none do, red otherwise)"
    )
    return Item("contact", "red", text, found.overlap, row=found.contact, time=found.time)


def spheres_of(machine: MachineRecord) -> list[Pair]:
    """The contacts of two spheres."""
    out, bodies = [], {each.name: each for each in machine.bodies}
    for force in machine.forces:
        if isinstance(force, Contact) and force.bodies is not None:
            spheres = [bodies[name].shape for name in force.bodies]
            if not all(isinstance(each, Sphere) for each in spheres):
                continue
            first, second = [np.array(each.centre or (0.0, 0.0, 0.0)) for each in spheres if isinstance(each, Sphere)]
            reach = sum(each.radius for each in spheres if isinstance(each, Sphere))
            out.append(Pair(force.name, force.bodies, (first, second), reach))
    return out


def hulls_of(machine: MachineRecord) -> list[HullPair]:
    """The contacts of two convex hulls."""
    out, bodies = [], {each.name: each for each in machine.bodies}
    for force in machine.forces:
        if isinstance(force, Contact) and force.bodies is not None and force.foundation_modulus is not None:
            pair = [bodies[name] for name in force.bodies]
            first, second = (hull_of(pair[k], part_of(force, pair, k)) for k in range(2))
            middles, corners = (first.middle, second.middle), (first.corners, second.corners)
            out.append(HullPair(force.name, force.bodies, middles, corners, (first.faces, second.faces)))
    return out


def passed_spheres(result: Readable, pairs: Sequence[Pair]) -> list[Passed]:
    """The deepest of each pair, where the ways between frames lead through the overlap."""
    out = []
    for pair in pairs:
        way = way_between(result, pair.bodies, pair.centres)
        found = way.nearest(pair.reach)
        if found is None:
            continue
        distance, at, lasted = found
        overlap = 1.0 - distance / pair.reach
        if overlap > DEEP:
            out.append(Passed(pair.contact, pair.bodies, overlap, "the distance at which they touch", at, lasted))
    return out


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
    first, second = (_motion(result, body, at) for body, at in zip(bodies, points, strict=True))
    return Way(result.time, *(a - b for a, b in zip(first, second, strict=True)))


def _motion(result: Readable, body: str, at: Array) -> tuple[Array, Array, Array]:
    """Place, velocity and acceleration (n, 3) of a point of a body."""
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


def passed_hulls(result: Readable, pairs: Sequence[HullPair]) -> list[Passed]:
    """The deepest of each pair, where the ways between frames lead through the overlap."""
    out = []
    for pair in pairs:
        found = [each for each in _passages(result, pair) if each.overlap > DEEP]
        if found:
            out.append(max(found, key=lambda each: each.overlap))
    return out


def _passages(result: Readable, pair: HullPair) -> Iterator[Passed]:
    """The intervals at whose ends the hulls are apart and inside which they overlap. What turns reaches its faces on arcs: corners move as
    far as their distance from the middle times the angle."""
    time, thinnest = result.time, pair.thinnest
    way = way_between(result, (pair.bodies[1], pair.bodies[0]), (pair.middles[1], pair.middles[0]))
    turns = [result.array("orientation")[:, result.coordinates["body"].index(body)] for body in pair.bodies]
    radii = [float(np.linalg.norm(corners, axis=1).max()) for corners in pair.corners]
    swept = sum(radius * _angles(turn) for radius, turn in zip(radii, turns, strict=True))
    length = way.length + swept
    distance = np.linalg.norm(way.place, axis=1)
    near = np.minimum(distance[:-1], distance[1:]) - 0.5 * way.length < pair.reach
    fast = np.flatnonzero(near & way.undisturbed & (length > thinnest / LOOKS))
    for k in fast[np.argsort(-length[fast])][:MOST_INTERVALS]:
        count = int(np.clip(np.ceil(LOOKS * length[k] / thinnest), 2, MOST_LOOKS))
        shares = np.linspace(0.0, 1.0, count + 1)
        depth = np.array([_depth(pair, way.between(k, s), *(_between(turn, k, s) for turn in turns)) for s in shares])
        if depth[0] <= 0.0 and depth[-1] <= 0.0 and depth.max() > 0.0:
            lasted = float((depth > 0.0).sum() / count * (time[k + 1] - time[k]))
            at = float(time[k] + shares[np.argmax(depth)] * (time[k + 1] - time[k]))
            yield Passed(
                pair.contact, pair.bodies, float(depth.max() / thinnest), "the thinner one's width", at, lasted
            )


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
    """[m] by which two hulls overlap, r from the first middle to the second; negative where a face keeps them apart, 0 where edges do."""
    from scipy.optimize import linprog

    normals = [rotated(turn, faces[:, :3]) for turn, faces in zip((first, second), pair.faces, strict=True)]
    corners = [rotated(turn, points) for turn, points in zip((first, second), pair.corners, strict=True)]
    of_first = pair.faces[0][:, 3] - ((corners[1] + r) @ normals[0].T).min(axis=0)
    of_second = pair.faces[1][:, 3] - ((corners[0] - r) @ normals[1].T).min(axis=0)
    least = float(min(of_first.min(), of_second.min()))
    if least <= 0.0:
        return least
    rows = np.vstack([np.column_stack([n, np.ones(len(n))]) for n in normals])
    heights = np.concatenate([pair.faces[0][:, 3], pair.faces[1][:, 3] + normals[1] @ r])
    deepest = linprog([0.0, 0.0, 0.0, -1.0], rows, heights, bounds=[(None, None)] * 4)
    return 2.0 * max(float(deepest.x[3]), 0.0) if deepest.success else 0.0


CHECKS = (Check("contact", Run, look, say, 220, (STEPS,), "Contact", blind="their steps pass {row}"),)
