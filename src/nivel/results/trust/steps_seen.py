"""Steps of a run that are too long or too small, seen without a second run: bodies that turn too far in one, places that are
rounded to more than a step moves them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.results.scales import Readable, machine_size

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Turn:
    """The largest angle [rad] by which a body turned in one step, and at which `time` [s]. counted : turns are part of the state, so that
    none is lost."""

    body: str
    angle: float
    time: float
    counted: bool = False


@dataclass(frozen=True)
class Rounding:
    """The place farthest from the origin [m], what it is rounded to [m], and what that is in all steps of the run, as a share of the size
    of the machine."""

    body: str
    distance: float
    unit: float
    share: float


def largest_turn(result: Readable, turned: Array, end: float, *, counted: bool) -> Turn | None:
    """turned : (parts,) [rad] largest angle in a step of each part of the duration `end` [s]. The body is the fastest one then."""
    if "angular_velocity" not in result.variables or not len(result.time) or not turned.size:
        return None
    part = int(np.argmax(turned))
    time = float((part + 0.5) / len(turned) * end)
    frame = min(int(np.searchsorted(result.time, time)), len(result.time) - 1)
    speed = np.linalg.norm(result.array("angular_velocity", slice(frame, frame + 1))[0], axis=-1)
    return Turn(result.coordinates["body"][int(np.nan_to_num(speed).argmax())], float(turned[part]), time, counted)


def rounding(result: Readable, steps: int) -> Rounding | None:
    """What the places of bodies are rounded to, against what all steps can lose by it: half a unit in the last place each."""
    if "position" not in result.variables or not len(result.time):
        return None
    position = np.abs(result.array("position"))
    position[~np.isfinite(position)] = 0.0
    largest = position.max(axis=(0, 2))
    body = int(np.argmax(largest))
    unit = float(np.spacing(largest[body]))
    share = 0.5 * unit * steps / machine_size(result)[0]
    return Rounding(result.coordinates["body"][body], float(largest[body]), unit, share)
