"""Spheres that pass through each other between two frames, as steps that are longer than the time in which they overlap let them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.machine.core.vectors import cross
from nivel.results.scales import Readable, rotated

Array = NDArray[np.float64]
# Overlaps above this share of the distance at which they touch are no touch in passing; speeds of frames differ by less where nothing
# happened between them.
DEEP, UNCHANGED = 0.05, 0.2


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


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def passed_contacts(result: Readable, pairs: Sequence[Pair]) -> list[Passed]:
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
