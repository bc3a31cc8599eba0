"""Events that were passed twice within a step, and that the run has not seen."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.functions import SideOf, Varying, varying
from nivel.analysis.curves.missed_impulse import beyond_samples
from nivel.analysis.curves.path import Path, Steps, path_of
from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.steps_of_run import steps_of_run
from nivel.analysis.trust.subject import Run
from nivel.results.frames.occurrence import Occurrence
from nivel.results.trust import Item, number

# parts of a step between samples
SAMPLES = 16


@dataclass(frozen=True)
class Passed:
    """An event that is on its other side at `time` [s], within a step [s] that has it on one side at both ends; how many steps have."""

    event: str
    time: float
    step: float
    count: int


def look(run: Run) -> list[Passed]:
    """The first unseen pass of each event."""
    steps = steps_of_run(run) if run.machine.events else None
    return [] if steps is None else list(_unseen(run, steps))


def _unseen(run: Run, steps: Steps) -> Iterator[Passed]:
    for function in varying(run.machine):
        section, _, event = function.of.partition(".")
        path = path_of(function, run.machine, run.result) if section == "events" else None
        if path is not None and len(path.time) > 1:
            found = passed(replace(function, curve=SideOf(function.curve)), path, steps, run.finished.events, event)
            if found is not None:
                yield found


def passed(side: Varying, path: Path, steps: Steps, events: list[Occurrence], event: str) -> Passed | None:
    """The first step in which a side changes there and back without an event of this name near it; each stands for one such step. Near is
    what two frames are apart by, between which the path is straight."""
    time = steps.begin + steps.length * (np.arange(SAMPLES + 1)[:, None] / SAMPLES)
    values = side.curve.values(path.at(time.ravel())).reshape(time.shape).T
    is_back = (values[:, 0] == values[:, -1])[:, None] & (values[:, 1:-1] == -values[:, :1]) & (values[:, :1] != 0.0)
    places = beyond_samples(side, path, steps, values)
    sampled, inside = np.nonzero(is_back)
    step, first = np.unique(np.concatenate([sampled, places.step]), return_index=True)
    when = np.concatenate([time.T[sampled, inside + 1], places.time])[first]
    missed = _unmatched(when, [each.time for each in events if each.name == event], float(np.diff(path.time).max()))
    if not len(missed):
        return None
    k = missed[0]
    return Passed(event, float(when[k]), float(steps.length[step[k]]), len(missed))


def _unmatched(when: NDArray[np.float64], came: list[float], near: float) -> list[int]:
    """The places of times [s], ascending, that have no time that `came` within `near`, where each of these is taken once."""
    left, out = sorted(came), []
    for k, time in enumerate(when):
        found = bisect_left(left, time - near)
        if found < len(left) and left[found] <= time + near:
            del left[found]
        else:
            out.append(k)
    return out


def say(found: Passed) -> Item:
    """Which event was passed, and the step that sees it."""
    more = f", and so in {found.count - 1} further steps" if found.count > 1 else ""
    said = f"{found.event} passes zero and back near t = {found.time:.6g} s within one step of {number(found.step)} s{more}"
    text = f"Events: {said}; the run has not seen it: use a shorter step, or a method that chooses its steps"
    return Item("events", "amber", text, row=found.event, time=found.time)


CHECKS = (Check("events", (Run,), look, say, 205, (STEPS,), "Events", blind="both pass {row} unseen", quiet=True),)
