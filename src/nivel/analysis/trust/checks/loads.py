"""Loads that the steps of a run miss, in whole or in part, and functions that change between two samples."""

from __future__ import annotations

import math

from nivel.analysis.curves.missed_impulse import Unseen, unseen_loads
from nivel.analysis.curves.sampled import between_samples
from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.checks.accuracy import error_from_finer, extent
from nivel.analysis.trust.steps_of_run import steps_of_run
from nivel.analysis.trust.subject import Run
from nivel.results.motion import Motion
from nivel.results.trust import Item, Threshold, number

SHOWN = 5  # functions of which each has a line
# What is hidden between the places where steps look counts above so many times what two runs are apart by, and this share of a load.
BEYOND_AGREED, LEAST_HIDDEN = 10.0, 1e-10
LOADS = Threshold(
    1e-2,
    1e-1,
    "Loads of real machines are known to about a hundredth. If the steps miss a tenth of an impulse, the error is visible in every "
    "curve.",
)
SAMPLING = Threshold(
    0.3,
    math.inf,
    "Between two samples the function leaves their values by this share of its range: a sine with less than three samples a period, or "
    "a pulse. The model itself samples, so its motion is still exact.",
)


def look(run: Run) -> list[Unseen]:
    """What is missed by much, or by more than a headline that two runs agree on allows."""
    agreed = _agreed(run)
    return _most([each for each in _unseen(run) if _is_missed(each, agreed)])


def say(found: Unseen) -> Item:
    """What is missed of a load, and the step that does not miss it."""
    by = "" if found.of == "time" else f" along {found.of}"
    said = f"the steps miss {number(min(found.share, 1.0))} of {found.name} at t = {found.time:.6g} s, where it changes{by} within"
    finer = number(min(found.scale, found.step) / 10.0)
    advice = f"{number(found.scale)} s, with steps of {number(found.step)} s; use steps of {finer} s"
    if not found.share < LOADS.green:
        return LOADS.item("loads", f"Loads: {said} {advice}", found.share, found.time, found.name)
    much = (
        f"this is {number(found.hidden)} of it over the whole run, more than the two runs differ, and both may miss it"
    )
    text = f"Loads: {said} {advice} ({much})"
    return Item("loads", "amber", text, found.share, row=found.name, time=found.time)


def look_between_samples(run: Run) -> list[Unseen]:
    """Sampled functions that no sample shows."""
    found = between_samples(run.machine, float(run.result.time[-1]))
    return _most([each for each in found if not each.share < SAMPLING.green])


def say_between_samples(found: Unseen) -> Item:
    """What a function does between two samples."""
    said = f"after t = {found.time:.6g} s {found.name} changes by {number(found.share)} of its range and back between two samples"
    advice = f"{number(found.step)} s apart, within {number(found.scale)} s; use a shorter sample_time if the block shall see it"
    return SAMPLING.item("sampling", f"Sampling: {said} {advice}", found.share, found.time, found.name)


def _most(found: list[Unseen]) -> list[Unseen]:
    return sorted(found, key=lambda each: -each.share)[:SHOWN]


def _unseen(run: Run) -> list[Unseen]:
    chosen, steps = run.plan.settings.steps == 0, steps_of_run(run)
    if steps is None:
        return []
    known = run.finished.impulses
    return list(unseen_loads(run.machine, run.result, steps, run.prepared.integrator, chosen=chosen, known=known))


def _agreed(run: Run) -> float | None:
    """By what two runs are apart, as a share of the longest path of a body, or of the machine's size where that is more."""
    if run.second is None:
        return None
    apart = error_from_finer(run.result, run.second.result, run.second.refinement.left).value
    return apart / extent(Motion.of(run.result), run.scales.size)


def _is_missed(each: Unseen, agreed: float | None) -> bool:
    if not each.share < LOADS.green:
        return True
    return agreed is not None and each.hidden > BEYOND_AGREED * max(agreed, LEAST_HIDDEN)


CHECKS = (
    Check("loads", Run, look, say, 200, (STEPS,), "Loads", LOADS, blind="their steps miss {row}", quiet=True),
    Check("sampling", Run, look_between_samples, say_between_samples, 210, (STEPS,), "Sampling", SAMPLING, quiet=True),
)
