"""Steps of fixed size that are too long for what is fastest in the machine, where a run is red."""

from __future__ import annotations

import math
from dataclasses import dataclass

from nivel.analysis.failures.fastest import fastest, held_step
from nivel.analysis.trust.check import FIXED_STEPS, Check, Need
from nivel.analysis.trust.subject import Run
from nivel.results.trust import Item, Threshold, number, worst

THRESHOLD = Threshold(
    0.3,
    math.inf,
    "The fastest rate of the machine times the step, reported if a run is red. Above 0.3 an explicit method does not resolve motions "
    "of this rate; above 1 to 3 it diverges.",
)
EXPLICIT = Need("an explicit method", lambda run: run.prepared.integrator.kind == "explicit")


@dataclass(frozen=True)
class Fast:
    """The fastest rate [1/s] of a machine and the part that it is of, the step [s] of a run, and the longest with which `method` holds
    that rate [s]."""

    part: str
    rate: float
    step: float
    held: float
    method: str


def look(run: Run) -> Fast | None:
    """The fastest rate at the start or in the last state; None where the run is not red, or has failed: then its advice has told."""
    if worst(run.items) != "red" or run.outcome == "failed":
        return None
    settings, prepared, last = run.plan.settings, run.prepared, run.finished.last
    states = [(0.0, prepared.start), *([last] if last is not None else [])]
    found = [each for each in (fastest(prepared.motion, t, y) for t, y in states) if each is not None]
    most = max(found, key=lambda each: each.rate, default=None)
    if most is None:
        return None
    return Fast(most.part, most.rate, settings.step, held_step(settings.integrator, most.rate), settings.integrator)


def say(found: Fast) -> Item:
    """What is fastest, and the step that it asks for."""
    of = f", of {found.part}" if found.part else ""
    too_long = found.step > found.held
    step, does = (found.held, "holds") if too_long else (THRESHOLD.green / found.rate, "follows")
    said = f"the fastest rate of the machine is {number(found.rate)}/s{of}, and {found.method} {does} it with steps below {number(step)} s"
    text = f"Steps: {said}, but the step is {number(found.step)} s; use a shorter step, or `integrator: radau`"
    return THRESHOLD.item("steps", text, found.step * found.rate, row=found.part)


CHECKS = (Check("steps", Run, look, say, 350, (FIXED_STEPS, EXPLICIT), "Steps", THRESHOLD, quiet=True, last=True),)
