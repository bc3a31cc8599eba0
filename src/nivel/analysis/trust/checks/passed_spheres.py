"""Spheres that pass through each other between two frames, as steps that are longer than the time in which they overlap let them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

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

Array = NDArray[np.float64]
# Overlaps above this share of the distance at which they touch are no touch in passing; speeds of frames differ by less where nothing
# happened between them.
DEEP, UNCHANGED = 0.05, 0.2
SHOWN = 5  # contacts of which each has a line
BLIND = "their steps pass {row}"


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


def look(run: Run) -> list[Passed]:
    """The pairs of spheres that passed each other."""
    return passed_spheres(run.result, pairs_of(run.machine))[:SHOWN]


def say(found: Passed) -> Item:
    """Who passed whom, and what the step has to be."""
    text = (
        f"Contact: {' and '.join(found.bodies)} pass through each other at t = {found.time:.6g} s, by {number(found.overlap)} of "
        f"{found.of}, and {found.contact} does not push them apart: they overlap for only "
        f"{number(found.lasted)} s; use steps of {number(found.lasted / 10.0)} s, or a method that chooses its steps "
        f"(green if none do, red otherwise)"
    )
    return Item("contact", "red", text, found.overlap, row=found.contact, time=found.time)


def pairs_of(machine: MachineRecord) -> list[Pair]:
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


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def passed_spheres(result: Readable, pairs: Sequence[Pair]) -> list[Passed]:
    """The deepest of each pair, where straight lines between frames, along the speeds at both, lead through the overlap."""
    out, time = [], result.time
    for pair in pairs:
        first, second = (
            place_and_velocity(result, body, at) for body, at in zip(pair.bodies, pair.centres, strict=True)
        )
        place, speed = first[0] - second[0], first[1] - second[1]
        begin, way, span = place[:-1], np.diff(place, axis=0), np.diff(time)[:, None]
        square = np.sum(way * way, axis=1)
        share = -np.sum(begin * way, axis=1) / square
        overlap = 1.0 - np.linalg.norm(begin + share[:, None] * way, axis=1) / pair.reach
        half = np.sqrt(np.maximum(1.0 - (1.0 - overlap) ** 2, 0.0)) * pair.reach / np.sqrt(square)
        straight = np.ones(len(way), dtype=bool)
        for each in (speed[:-1], speed[1:]):
            straight &= np.linalg.norm(each * span - way, axis=1) < UNCHANGED * np.sqrt(square)
        through = straight & (overlap > DEEP) & (share > half) & (share < 1.0 - half)
        if through.any():
            k = int(np.argmax(np.where(through, overlap, 0.0)))
            lasted = float(2.0 * half[k] * span[k, 0])
            at = float(time[k] + share[k] * span[k, 0])
            out.append(
                Passed(pair.contact, pair.bodies, float(overlap[k]), "the distance at which they touch", at, lasted)
            )
    return out


def place_and_velocity(result: Readable, body: str, at: Array) -> tuple[Array, Array]:
    """Place and velocity (n, 3) of a point of a body."""
    k = result.coordinates["body"].index(body)
    arm = rotated(result.array("orientation")[:, k], at)
    turning = cross(result.array("angular_velocity")[:, k], arm)
    return result.array("position")[:, k] + arm, result.array("velocity")[:, k] + turning


CHECKS = (Check("passed_spheres", (Run,), look, say, 220, (STEPS,), "Contact", line="contact", blind=BLIND),)
