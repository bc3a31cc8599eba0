"""Round-off of positions, seen without a second run: places so far from the origin that steps move them by less."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.subject import Run
from nivel.results.trust import Item, Threshold, number

THRESHOLD = Threshold(
    1e-6,
    1e-3,
    "Half a unit in the last place of a coordinate, added in every step with the same sign, as a share of the machine's size. The "
    "limit is that of the constraint violation.",
)
BLIND = "{row} is so far from the origin that the motion in a step is below round-off"


@dataclass(frozen=True)
class Rounding:
    """The place farthest from the origin [m], what it is rounded to [m], and what that is in all steps of the run, as a share of the size
    of the machine."""

    body: str
    distance: float
    unit: float
    share: float


def look(run: Run) -> Rounding | None:
    """What the places of bodies are rounded to, against what all steps can lose by it: half a unit in the last place each."""
    result, steps = run.result, int(run.finished.timing["steps"])
    if "position" not in result.variables:
        return None
    position = np.abs(result.array("position"))
    position[~np.isfinite(position)] = 0.0
    largest = position.max(axis=(0, 2))
    body = int(np.argmax(largest))
    unit = float(np.spacing(largest[body]))
    share = 0.5 * unit * steps / run.scales.size
    return Rounding(result.coordinates["body"][body], float(largest[body]), unit, share)


def say(found: Rounding) -> Item:
    """Where it is, and what it loses there."""
    far = f"{found.body} is {number(found.distance)} m from the origin, where positions are rounded to {number(found.unit)} m"
    lost = f"over all steps this may add up to {number(found.share)} of the machine's size"
    said = f"Round-off: {far}; {lost}; move the machine to the origin"
    return THRESHOLD.item("rounding", said, found.share, row=found.body)


CHECKS = (Check("rounding", Run, look, say, 240, (STEPS,), "Round-off", THRESHOLD, blind=BLIND, quiet=True),)
