"""Accuracy of a run, estimated from a second one whose error is a known share of that of the first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.curves.step_limits import rounding_of_times
from nivel.analysis.trust.check import FRAMES, Check, Need
from nivel.analysis.trust.report import blindness
from nivel.analysis.trust.subject import Run, Scales
from nivel.results.motion import Motion, distances
from nivel.results.peaks import Peak
from nivel.results.scales import Readable, levers, machine_size
from nivel.results.trust import ROUND_OFF, Item, Threshold, number

THRESHOLD = Threshold(
    1e-4,
    1e-2,
    "1e-4 of a machine of one metre is a tenth of a millimetre, less than manufacturing tolerances. Above 1e-2 the curves of the run "
    "and of the exact motion are visibly different.",
)
BRANCHING = ("singular", "branch")  # lines after which two runs may go different ways
VERIFIED = Need("a second run", lambda run: run.second is not None)
# Estimates are this much larger than what the two runs are apart by where the error falls with the step as it should: where it falls
# with its first power only they are still no less than 0.8 of the error, for steps shorter by 5/8 and an order of two.
MARGIN = 1.25


@dataclass(frozen=True)
class Accuracy:
    """Estimated largest error of a position [m], of which body and when [s]. refinement : of the second run, in words. until : the time [s]
    up to which it went, None: to the end. blind : why the second run may be wrong as the first, in words; then parted [s]: from when on the
    two go different ways, None: they do not."""

    error: float
    body: str
    time: float
    refinement: str
    until: float | None
    blind: str
    scales: Scales
    parted: float | None = None


@dataclass(frozen=True)
class Verified:
    """The time [s] up to which a run was verified, and why not further."""

    until: float
    ended: str


def look(run: Run) -> Accuracy:
    """What two runs are apart by, and what both may have wrong by the rounding of times."""
    finer = run.finer
    rounded = rounding_of_times(run.machine, float(run.result.time[-1]))
    found = error_from_finer(run.result, finer.result, finer.refinement.left, rounded)
    until = finer.until if finer.ended else None
    words, blind = finer.refinement.words, blindness(run.items)
    branching = any(item.name in BRANCHING and item.verdict != "green" for item in run.items)
    parted = parting(run.result, finer.result, run.scales.size) if branching else None
    return Accuracy(found.value, found.row, found.time, words, until, blind, run.scales, parted)


def say(found: Accuracy) -> Item:
    """How far the motion is from the exact one."""
    fraction = found.error / found.scales.size
    by = f"by a second run with {found.refinement}"
    if found.parted is not None:
        said = f"not known: a second run with {found.refinement} goes another way from t = {found.parted:.6g} s on, and {found.blind}"
    elif found.blind:
        agrees = f"a second run with {found.refinement} agrees within {number(found.error)} m"
        said = f"{agrees}, but both may have the same error: {found.blind}"
    elif fraction < ROUND_OFF:
        said = f"exact for this model, except for round-off, {by}"
    else:
        until = f" up to t = {found.until:.6g} s" if found.until is not None else ""
        within = f"within {number(found.error)} m of the exact motion of this model{until}"
        share = f"{number(fraction)} of the {found.scales.size_kind} {number(found.scales.size)} m"
        where = f"; largest at {found.body}" if found.body else ""
        said = f"{within}, {share}, {by}{where}, t = {found.time:.6g} s"
    return THRESHOLD.item("accuracy", f"Accuracy: {said}", fraction, found.time, found.body)


def look_at_end(run: Run) -> Verified | None:
    """Where the second run ended before the first."""
    return Verified(run.finer.until, run.finer.ended) if run.finer.ended else None


def say_end(found: Verified) -> Item:
    """How far the run was verified."""
    text = f"Verified: up to t = {found.until:.6g} s only, not verified beyond: {found.ended}"
    return Item("verified", "amber", f"{text} (green if verified to the end, amber otherwise)", time=found.until)


def factor(left: float) -> float:
    """What distances between two runs are multiplied by, where the share `left` of the error of the first is left in the second.

    Of e₁ - e₂ = (1 - left) e₁, with a margin.
    """
    return MARGIN / abs(1.0 - left)


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is red, not a warning
def error_from_finer(result: Readable, finer: Readable, left: float, rounded: float = 0.0) -> Peak:
    """Estimated largest error of the positions of `result` [m], with its body and time.

    finer : a run with the share `left` of its error, with frames at some of its times, as far as it got. rounded : share of the motion that
    both runs may have wrong because times are rounded.
    A body is off by the distance of its two origins, or by the angle between its two orientations times its own reach,
    whichever is larger: a rotor whose origin rests counts too. No error is less than the round-off of the places, or
    what that of times makes of the longest path.
    """
    size = machine_size(result)[0]
    motion = Motion.of(result)
    time, apart = distances(motion, Motion.of(finer), size, levers(result, size))
    if not apart.size:
        return Peak(0.0)
    k, body = np.unravel_index(int(np.argmax(apart)), apart.shape)
    floor = max(round_off(motion), rounded * extent(motion, size))
    error = max(float(apart[k, body]) * size * factor(left), floor)
    return Peak(error, motion.bodies[body], float(time[k]))


def parting(result: Readable, finer: Readable, size: float) -> float | None:
    """The time [s] from which on two runs are visibly apart; None where they are not."""
    time, apart = distances(Motion.of(result), Motion.of(finer), size)
    far = np.flatnonzero(~(apart.max(axis=1, initial=0.0) < THRESHOLD.amber))
    return float(time[far[0]]) if len(far) else None


def extent(motion: Motion, size: float) -> float:
    """How far the body that moves farthest does [m], or the size of the machine where that is more."""
    paths = np.linalg.norm(np.ptp(motion.position, axis=0), axis=-1)
    return max(size, float(np.max(paths, initial=0.0, where=np.isfinite(paths))))


def round_off(motion: Motion) -> float:
    """What the places of bodies are rounded to, over all frames [m]: half a unit in the last place each, as a random walk."""
    largest = float(np.max(np.abs(motion.position), initial=0.0, where=np.isfinite(motion.position)))
    return 0.5 * float(np.spacing(largest)) * len(motion.time) ** 0.5


CHECKS = (
    Check("accuracy", Run, look, say, 80, (VERIFIED, FRAMES), "Accuracy", THRESHOLD, last=True),
    Check("verified", Run, look_at_end, say_end, 90, (VERIFIED,), "Verified"),
)
