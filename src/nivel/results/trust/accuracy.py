"""Accuracy of a run, estimated from a second one whose error is a known share of that of the first."""

from __future__ import annotations

import numpy as np

from nivel.results.scales import Readable, machine_size
from nivel.results.trust.motion import Motion, distances
from nivel.results.trust.trust import Peak

# Estimates are this much larger than what the two runs are apart by where the error falls with the step as it should: where it falls
# with its first power only they are still no less than 0.8 of the error, for steps shorter by 5/8 and an order of two.
MARGIN = 1.25


def factor(left: float) -> float:
    """What distances between two runs are multiplied by, where the share `left` of the error of the first is left in the second.

    Of e₁ - e₂ = (1 - left) e₁, with a margin.
    """
    return MARGIN / (1.0 - left)


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is red, not a warning
def error_from_finer(result: Readable, finer: Readable, left: float, rounded: float = 0.0) -> Peak:
    """Estimated largest error of the positions of `result` [m], with its body and time.

    finer : a run with the share `left` of its error, with frames at some of its times, as far as it got. rounded : share of the motion that
    both runs may have wrong because times are rounded.
    A body is off by the distance of its two origins, or by the angle between its two orientations times the machine's
    size, whichever is larger: a rotor whose origin rests counts too. No error is less than the round-off of the places, or
    what that of times makes of the longest path.
    """
    size = machine_size(result)[0]
    motion = Motion.of(result)
    time, apart = distances(motion, Motion.of(finer), size)
    if not apart.size:
        return Peak(0.0)
    k, body = np.unravel_index(int(np.argmax(apart)), apart.shape)
    floor = max(round_off(motion), rounded * extent(motion, size))
    error = max(float(apart[k, body]) * size * factor(left), floor)
    return Peak(error, motion.bodies[body], float(time[k]))


def extent(motion: Motion, size: float) -> float:
    """How far the body that moves farthest does [m], or the size of the machine where that is more."""
    paths = np.linalg.norm(np.ptp(motion.position, axis=0), axis=-1)
    return max(size, float(np.max(paths, initial=0.0, where=np.isfinite(paths))))


def round_off(motion: Motion) -> float:
    """What the places of bodies are rounded to, over all frames [m]: half a unit in the last place each, as a random walk."""
    largest = float(np.max(np.abs(motion.position), initial=0.0, where=np.isfinite(motion.position)))
    return 0.5 * float(np.spacing(largest)) * len(motion.time) ** 0.5
