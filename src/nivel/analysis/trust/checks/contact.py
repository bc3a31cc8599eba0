"""Contacts in passing: bodies that go through each other between two frames, because steps are too long to see it.

Spheres are exact. Of other shapes the convex hulls are looked at, of round ones polyhedra inside them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.subject import Run
from nivel.analysis.trust.touching_pairs import DEEP, HullPair, Pair, hulls_of, spheres_among, spheres_of
from nivel.analysis.trust.ways import way_between
from nivel.machine.forces import Contacts
from nivel.results.scales import Readable, rotated
from nivel.results.trust import Item, number

Array = NDArray[np.float64]
SHOWN = 5  # contacts of which each has a line
# Places looked at on the way through the thinner hull, and at most between two frames; intervals between frames that are looked at.
LOOKS, MOST_LOOKS, MOST_INTERVALS = 8, 100, 100


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


def look(run: Run) -> list[Passed]:
    """The pairs of spheres and of hulls that passed each other."""
    spheres, hulls = spheres_of(run.machine), hulls_of(run.machine)
    for force in run.machine.forces:
        if isinstance(force, Contacts):
            spheres += spheres_among(run.machine, force, run.result) or []
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

        def depth_at(s: float, k: int = k) -> float:
            return _depth(pair, way.between(k, s), *(_between(turn, k, s) for turn in turns))

        if depth_at(0.0) > 0.0 or depth_at(1.0) > 0.0:
            continue
        depth = np.array([depth_at(s) for s in shares])
        if depth.max() > 0.0:
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
