"""Turning of bodies in a step, seen without a second run: beyond what the method resolves, or beyond what can be counted."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import FIXED_STEPS, Check
from nivel.analysis.trust.subject import Run
from nivel.integrate.loop.run import TURNED
from nivel.results.trust import Item, Threshold, number

THRESHOLD = Threshold(
    0.5,
    3.0,
    "Rotation in a step, in radians. At 0.5 the error of methods of order four is 2e-4 rad a turn. Near half a turn (3 rad) no method "
    "can determine the sense of the rotation.",
)
BLIND = "{row} rotates too far in a step"


@dataclass(frozen=True)
class Turn:
    """The largest angle [rad] by which a body turned in one step, and at which `time` [s]. counted : turns are part of the state, so that
    none is lost."""

    body: str
    angle: float
    time: float
    counted: bool = False


def look(run: Run) -> Turn | None:
    """The largest turn in a step; the body is the fastest one then. Where steps are chosen no body turns too far."""
    result, settings, turned = run.result, run.plan.settings, run.pace[TURNED]
    counted = settings.coordinates == "relative"
    if "angular_velocity" not in result.variables or not turned.size:
        return None
    part = int(np.argmax(turned))
    time = float((part + 0.5) / len(turned) * settings.duration)
    frame = min(int(np.searchsorted(result.time, time)), len(result.time) - 1)
    speed = np.linalg.norm(result.array("angular_velocity", slice(frame, frame + 1))[0], axis=-1)
    return Turn(result.coordinates["body"][int(np.nan_to_num(speed).argmax())], float(turned[part]), time, counted)


def say(found: Turn) -> Item:
    """The turn, and what is lost by it."""
    threshold = Threshold(THRESHOLD.amber, math.inf, "") if found.counted else THRESHOLD
    lost = "forces that depend on its angle are not resolved" if found.counted else "its turns can no longer be counted"
    meaning = lost if found.angle > THRESHOLD.amber else "that is more than the method resolves"
    turns = f"{found.body} rotates by {number(found.angle)} rad in one step at t = {found.time:.6g} s"
    said = f"Turning: {turns}, and {meaning}; use shorter steps"
    return threshold.item("turn", said, found.angle, found.time, found.body)


CHECKS = (Check("turn", Run, look, say, 230, (FIXED_STEPS,), "Turning", THRESHOLD, blind=BLIND, quiet=True),)
