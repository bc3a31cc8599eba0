"""Sensitivity of a motion to its start: neighbouring motions that part, as a second run tells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import SECOND_RUN, Check
from nivel.analysis.trust.checks.accuracy import factor, round_off
from nivel.analysis.trust.subject import Run
from nivel.results.motion import Motion, distances
from nivel.results.trust import Item, number

Array = NDArray[np.float64]
# Distances grow with the exponential of time where they do so over so many powers of e, better than with a power of time.
POWERS_OF_E, LEAST_POINTS = 5.0, 8
# Distances between these are looked at: times the round-off, of the size; motions that far apart have parted.
ABOVE, PARTED = 100.0, 0.1


@dataclass(frozen=True)
class Growth:
    """Neighbouring motions part by e in `time_constant` [s], and have parted at `parted` [s]."""

    time_constant: float
    parted: float


def look(run: Run) -> Growth | None:
    """How neighbouring motions part: None where they do not, or no faster than with a power of time, or stay near to the end."""
    result, finer, left = run.result, run.finer.result, run.finer.refinement.left
    size, motion = run.scales.size, Motion.of(result)
    time, apart = distances(motion, Motion.of(finer), size)
    if not apart.size:
        return None
    running = np.maximum.accumulate(factor(left) * np.nan_to_num(apart.max(axis=1), nan=np.inf))
    floor = ABOVE * max(round_off(motion) / size, 1e-15)
    inside = (running > floor) & (running < PARTED) & (time > 0.0)
    if inside.sum() < LEAST_POINTS or not running[-1] >= PARTED:
        return None
    log, t = np.log(running[inside]), time[inside]
    (rate, _), straight = np.polyfit(t, log, 1), _misfit(t, log)
    if log[-1] - log[0] < POWERS_OF_E or straight > _misfit(np.log(t), log) or rate <= 0.0:
        return None
    return Growth(1.0 / float(rate), float(time[np.argmax(running >= PARTED)]))


def say(found: Growth) -> Item:
    """How fast neighbouring motions part, and what is left to say then."""
    text = (
        f"Sensitivity: neighbouring motions separate by a factor e every {number(found.time_constant)} s, and have separated at t = "
        f"{found.parted:.6g} s: the motion is chaotic; after that time only means and extremes are meaningful "
        f"(green if they stay together, amber otherwise)"
    )
    return Item("sensitivity", "amber", text, time=found.parted)


def _misfit(x: Array, y: Array) -> float:
    """Mean square distance of y from a straight line over x."""
    return float(np.mean((np.polyval(np.polyfit(x, y, 1), x) - y) ** 2))


CHECKS = (Check("sensitivity", Run, look, say, 340, (SECOND_RUN,), "Sensitivity"),)
