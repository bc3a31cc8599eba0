"""Accuracy of a run: its error as a second run tells it, the growth of errors, and round-off of positions."""

import numpy as np

from nivel.analysis.curves.corners import rounding_of_times
from nivel.judge.after.report import FRAMES, SECOND_RUN, STEPS, Check, Need, blindness
from nivel.judge.after.subject import Run, Scales
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.results.motion import Motion, Peak, distances
from nivel.results.scales import Readable, levers, machine_size
from nivel.results.trust import ROUND_OFF, Item, Threshold, number

ACCURACY = Threshold(
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


class Accuracy(Struct):
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


class Verified(Struct):
    """The time [s] up to which a run was verified, and why not further."""

    until: float
    ended: str


def _look_at_error(run: Run) -> Accuracy:
    """What two runs are apart by, and what both may have wrong by the rounding of times."""
    finer = run.finer
    rounded = rounding_of_times(run.machine, float(run.result.time[-1]))
    found = error_from_finer(run.result, finer.result, finer.refinement.left, rounded)
    until = finer.until if finer.ended else None
    words, blind = finer.refinement.words, blindness(run.items)
    branching = any(item.name in BRANCHING and item.verdict != "green" for item in run.items)
    parted = parting(run.result, finer.result, run.scales.size) if branching else None
    return Accuracy(found.value, found.row, found.time, words, until, blind, run.scales, parted)


def _say_error(found: Accuracy) -> Item:
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
    return ACCURACY.item("accuracy", f"Accuracy: {said}", fraction, found.time, found.body)


def _look_at_end(run: Run) -> Verified | None:
    return Verified(run.finer.until, run.finer.ended) if run.finer.ended else None


def _say_end(found: Verified) -> Item:
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
    far = np.flatnonzero(~(apart.max(axis=1, initial=0.0) < ACCURACY.amber))
    return float(time[far[0]]) if len(far) else None


def extent(motion: Motion, size: float) -> float:
    """How far the body that moves farthest does [m], or the size of the machine where that is more."""
    paths = np.linalg.norm(np.ptp(motion.position, axis=0), axis=-1)
    return max(size, float(np.max(paths, initial=0.0, where=np.isfinite(paths))))


def round_off(motion: Motion) -> float:
    """What the places of bodies are rounded to, over all frames [m]: half a unit in the last place each, as a random walk."""
    largest = float(np.max(np.abs(motion.position), initial=0.0, where=np.isfinite(motion.position)))
    return 0.5 * float(np.spacing(largest)) * len(motion.time) ** 0.5


# Distances grow with the exponential of time where they do so over so many powers of e, better than with a power of time.
POWERS_OF_E, LEAST_POINTS = 5.0, 8
# Distances between these are looked at: times the round-off, of the size; motions that far apart have parted.
ABOVE, PARTED = 100.0, 0.1


class Growth(Struct):
    """Neighbouring motions part by e in `time_constant` [s], and have parted at `parted` [s]."""

    time_constant: float
    parted: float


def _look_at_growth(run: Run) -> Growth | None:
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


def _say_growth(found: Growth) -> Item:
    text = (
        f"Sensitivity: neighbouring motions separate by a factor e every {number(found.time_constant)} s, and have separated at t = "
        f"{found.parted:.6g} s: the motion is chaotic; after that time only means and extremes are meaningful "
        f"(green if they stay together, amber otherwise)"
    )
    return Item("sensitivity", "amber", text, time=found.parted)


def _misfit(x: Array, y: Array) -> float:
    """Mean square distance of y from a straight line over x."""
    return float(np.mean((np.polyval(np.polyfit(x, y, 1), x) - y) ** 2))


ROUNDING = Threshold(
    1e-6,
    1e-3,
    "Half a unit in the last place of a coordinate, added in every step with the same sign, as a share of the machine's size. The "
    "limit is that of the constraint violation.",
)
FAR_AWAY = "{row} is so far from the origin that the motion in a step is below round-off"


class Rounding(Struct):
    """The place farthest from the origin [m], what it is rounded to [m], and what that is in all steps of the run, as a share of the size
    of the machine."""

    body: str
    distance: float
    unit: float
    share: float


def _look_at_rounding(run: Run) -> Rounding | None:
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


def _say_rounding(found: Rounding) -> Item:
    far = f"{found.body} is {number(found.distance)} m from the origin, where positions are rounded to {number(found.unit)} m"
    lost = f"over all steps this may add up to {number(found.share)} of the machine's size"
    said = f"Round-off: {far}; {lost}; move the machine to the origin"
    return ROUNDING.item("rounding", said, found.share, row=found.body)


CHECKS = (
    Check("accuracy", Run, _look_at_error, _say_error, 80, (VERIFIED, FRAMES), "Accuracy", ACCURACY, last=True),
    Check("verified", Run, _look_at_end, _say_end, 90, (VERIFIED,), "Verified"),
    Check("sensitivity", Run, _look_at_growth, _say_growth, 340, (SECOND_RUN,), "Sensitivity"),
    Check(
        "rounding", Run, _look_at_rounding, _say_rounding, 240, (STEPS,), "Round-off", ROUNDING, FAR_AWAY, quiet=True
    ),
)
