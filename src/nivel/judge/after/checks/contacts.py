"""Contacts: bodies that pass through each other within a step, friction that lets bodies creep, wheels that roll, and
loads of tyres.

Of contacts in passing spheres are exact. Of other shapes the convex hulls are looked at, of round ones polyhedra inside them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.judge.after.report import FRAMES, STEPS, Check
from nivel.judge.after.subject import Equilibria, Motion, Run
from nivel.judge.after.touching_pairs import (
    DEEP,
    HullPair,
    Pair,
    hulls_of,
    spheres_among,
    spheres_of,
    turns_of,
    way_between,
)
from nivel.lazy import dataclass, scipy
from nivel.machine.forces.contact import Contact
from nivel.machine.forces.contacts import Contacts
from nivel.results.scales import Readable, machine_size, rotated
from nivel.results.trust import Item, Threshold, number

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


def look_for_passing(run: Run) -> list[Passed]:
    """The pairs of spheres and of hulls that passed each other."""
    spheres, hulls = spheres_of(run.machine), hulls_of(run.machine)
    for force in run.machine.forces:
        if isinstance(force, Contacts):
            spheres += spheres_among(run.machine, force, run.result) or []
    return [*passed_spheres(run.result, spheres), *passed_hulls(run.result, hulls)][:SHOWN]


def say_passing(found: Passed) -> Item:
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
    turns = [turns_of(result, body) for body in pair.bodies]
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


Array = NDArray[np.float64]
CREEP = Threshold(
    1e-4,
    np.inf,
    "Way over which a contact with `friction_model: coulomb` lets bodies creep, as a share of the size of the machine. Real friction would "
    "hold them.",
)


@dataclass(frozen=True)
class Creep:
    """A contact, how far its bodies creep in all [m], as a share of the machine's size, and the time [s] and speed [m/s] where they are
    fastest."""

    contact: str
    way: float
    share: float
    time: float
    speed: float


def look_at_creep(run: Run) -> list[Creep]:
    """Contacts that creep: they slide slower than the transition speed of their friction, from frame to frame."""
    time, found = run.result.time, []
    if len(time) < 2:
        return found
    for force in run.machine.forces:
        if not isinstance(force, Contact | Contacts) or not _is_smooth(force):
            continue
        speed = _sliding(run, force)
        touches = run.result.array(f"force.{force.name}.normal_force") > 0.0
        creeps = touches & (speed < (force.friction_transition_speed or np.inf))
        between = creeps[1:] & creeps[:-1]
        way = float(np.sum(np.where(between, 0.5 * (speed[1:] + speed[:-1]) * np.diff(time), 0.0)))
        if way > 0.0:
            fastest = int(np.argmax(np.where(creeps, speed, 0.0)))
            share = way / machine_size(run.result)[0]
            found.append(Creep(force.name, way, share, float(time[fastest]), float(speed[fastest])))
    return found


def _is_smooth(force: Contact | Contacts) -> bool:
    """Whether a force has friction that goes to zero with the speed of sliding."""
    if isinstance(force, Contact):
        return bool(force.friction) and not force.sticks
    return bool(force.friction) and force.friction_transition_speed is not None


def _sliding(run: Run, force: Contact | Contacts) -> Array:
    """(n,) [m/s] speed of sliding; of many pairs the mean by their friction."""
    if isinstance(force, Contact):
        return run.result.array(f"force.{force.name}.slip_speed")
    friction, power = (run.result.array(f"force.{force.name}.friction_{each}") for each in ("force", "power"))
    return np.divide(power, friction, out=np.zeros_like(power), where=friction > 0.0)


def say_creep(found: Creep) -> Item:
    """How far it creeps."""
    said = (
        f"Contact: {found.contact} lets its bodies creep by {number(found.way)} m, with up to {number(found.speed)} m/s at "
        f"t = {found.time:.6g} s, where friction would hold them: a `contact` with `friction_model: stiction` does"
    )
    return CREEP.item("creep", said, found.share, found.time, found.contact)


NORMAL = ".normal_force"
# a wheel that is pulled by less than this share of the largest normal force is not: that is round-off
PULLED = 1e-9


@dataclass(frozen=True)
class Wheel:
    """The least normal force [N] on a wheel and its time [s]; lifts : from when on the plane would have to pull [s], None: never. The
    largest ratio of friction and normal force, and its time [s]."""

    name: str
    least: float
    time: float
    lifts: float | None
    ratio: float
    ratio_time: float


def look_at_wheels(run: Motion) -> list[Wheel]:
    """All wheels."""
    names = [name for name in run.result.variables if name.startswith("joint.") and name.endswith(NORMAL)]
    return [_wheel(run.result, name.removesuffix(NORMAL)) for name in names]


def say_wheel(found: Wheel) -> Item:
    """Whether a wheel stays on the plane, and does not slip."""
    if found.lifts is not None:
        said = (
            f"the plane would have to pull {found.name} with {number(-found.least)} N at t = {found.time:.6g} s: a real wheel "
            f"lifts off, from t = {found.lifts:.6g} s on; use a contact there"
        )
        return Item("rolling", "amber", f"Rolling: {said}", row=found.name, time=found.time)
    said = f"the plane presses on {found.name} with {number(found.least)} N or more"
    slips = f"it does not slip where the coefficient of friction is {found.ratio:.3g} or more (t = {found.ratio_time:.6g} s)"
    return Item("rolling", "green", f"Rolling: {said}, and {slips} (green if it never pulls)", row=found.name)


def _wheel(result: Readable, wheel: str) -> Wheel:
    time, normal = result.time, result.array(f"{wheel}{NORMAL}")
    friction = np.hypot(result.array(f"{wheel}.friction_x"), result.array(f"{wheel}.friction_y"))
    least, largest = int(np.argmin(normal)), float(np.max(np.abs(normal)))
    pulled, pressed = normal < -PULLED * largest, normal > PULLED * largest
    ratio = np.divide(friction, normal, out=np.zeros_like(friction), where=pressed)
    worst = int(np.argmax(ratio))
    return Wheel(
        wheel.removeprefix("joint."),
        float(normal[least]),
        float(time[least]),
        float(time[int(np.argmax(pulled))]) if pulled.any() else None,
        float(ratio[worst]),
        float(time[worst]),
    )


LADEN = Threshold(
    2.0,
    np.inf,
    "Largest load of a tyre as a share of its nominal load. Its curves are given up to twice that. Up to three times they are "
    "extrapolated, and with more load the grip stays.",
)


@dataclass(frozen=True)
class Laden:
    """The largest load of a tyre by its nominal load, and when [s]."""

    tyre: str
    share: float
    time: float


def look_at_loads(subject: Run | Equilibria) -> list[Laden]:
    """Every tyre."""
    out = []
    for force in subject.machine.forces:
        if (nominal := getattr(force, "nominal_load", None)) is not None:  # of tyres
            load = subject.result.array(f"force.{force.name}.magnitude") / nominal
            k = int(np.argmax(load))
            out.append(Laden(force.name, float(load[k]), float(subject.result.time[k])))
    return out


def say_load(found: Laden) -> Item:
    """How much it bears, and what is known of it there."""
    bears = f"{found.tyre} bears {number(found.share)} times its nominal load at t = {found.time:.6g} s"
    text = f"Tyres: {bears}, and its curves are given up to twice"
    return LADEN.item("laden", text, found.share, found.time, found.tyre)


CHECKS = (
    Check("laden", (Run, Equilibria), look_at_loads, say_load, 227, (FRAMES,), "Tyres", LADEN, quiet=True),
    Check("contact", Run, look_for_passing, say_passing, 220, (STEPS,), "Contact", blind="their steps pass {row}"),
    Check("creep", Run, look_at_creep, say_creep, 225, (FRAMES,), "Contact", CREEP, quiet=True),
    Check("rolling", Motion, look_at_wheels, say_wheel, 420, (FRAMES,), "Rolling"),
)
