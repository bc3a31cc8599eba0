"""Ranges of motion: how far a joint coordinate can go, both ways, until the joints cannot be closed any further."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import pi

import numpy as np

from nivel.errors import ModelError, SolveError
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Reach
from nivel.results.analyses.configuration_curve import ConfigurationCurve
from nivel.results.analyses.mechanism import Range
from nivel.results.result import Result

# a coordinate that comes this near to a whole turn, and is there again, turns right round
TURN = 2.0 * pi


def range_of_motion(
    name: str,
    unit: str,
    start: float,
    reach: float,
    move: Callable[[float, float], Result],
    curve: Callable[[], ConfigurationCurve],
) -> Range:
    """The range of a coordinate that is at `start` now. reach : how far it is tried at most, each way. move(start, end) : the kinematic
    analysis of that way, which raises SolveError where it cannot go on. curve() : all positions, whose turning points are the ends found in
    another way; it raises ModelError where more than one motion is free."""
    ends, reasons, ways = [], [], []
    for way in (-reach, reach):
        end, reason = start + way, ""
        try:
            result: Result | None = move(start, end)
        except SolveError as error:
            found = error.result
            result = found if isinstance(found, Result) else None
            reason = error.message
        if result is not None:
            ways.append(result.trust)
        if result is not None and len(result.time):
            end = float(np.asarray(result.array(name))[-1])
        elif reason:
            end = start
        ends.append(end)
        reasons.append(reason)
    full = unit == "rad" and not any(reasons)
    found = Range(name, unit, ends[0], ends[1], full, reasons[0], reasons[1])
    turning = _turning_points(curve) if any(reasons) else None
    return replace(found, trust=assess(Reach(outcome="done", range=found, ways=tuple(ways), turning=turning)))


def _turning_points(curve: Callable[[], ConfigurationCurve]) -> tuple[float, ...] | None:
    """Where the coordinate turns back; None where that cannot be told."""
    try:
        return tuple(each.value for each in curve().turning)
    except (ModelError, SolveError):
        return None
