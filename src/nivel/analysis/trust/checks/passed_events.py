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
from nivel.results.trust import Item, number

# parts of a step between samples
SAMPLES = 16


@dataclass(frozen=True)
class Passed:
    """An event that was passed unseen near `time` [s], within a step [s] in which its side changes more than once; how many such passes."""

    event: str
    time: float
    step: float
    count: int


def look(run: Run) -> list[Passed]:
    """The first unseen pass of each event."""
    steps = steps_of_run(run) if run.machine.events else None
    return [] if steps is None else list(_unseen(run, steps))


def _unseen(run: Run, steps: Steps) -> Iterator[Passed]:
    directions = {each.name: each.direction for each in run.machine.events}
    for function in varying(run.machine):
        section, _, event = function.of.partition(".")
        path = path_of(function, run.machine, run.result) if section == "events" else None
        if path is not None and len(path.time) > 1:
            came = [each.time for each in run.finished.events if each.name == event]
            side = replace(function, curve=SideOf(function.curve))
            found = passed(side, path, steps, came, directions[event])
            if found is not None:
                yield replace(found, event=event)


def passed(side: Varying, path: Path, steps: Steps, came: list[float], direction: str) -> Passed | None:
    """The first pass within a step in which a side changes more than once, without an event that `came` [s] near it; each of these stands
    for one pass. Near is what two frames are apart by, between which the path is straight."""
    time = steps.begin + steps.length * (np.arange(SAMPLES + 1)[:, None] / SAMPLES)
    values = side.curve.values(path.at(time.ravel())).reshape(time.shape).T
    places = beyond_samples(side, path, steps, values)
    signs = values.copy()
    for k in range(1, SAMPLES + 1):  # a zero belongs to what was before
        signs[:, k] = np.where(signs[:, k] == 0.0, signs[:, k - 1], signs[:, k])
    change = np.diff(signs, axis=1)
    repeated = np.count_nonzero(change, axis=1) > 1
    # of both directions a step tells the first change of two
    first = np.cumsum(change != 0.0, axis=1) % 2 == 1
    wanted = {"rising": change > 0.0, "falling": change < 0.0}.get(direction, (change != 0.0) & first)
    sampled, inside = np.nonzero(repeated[:, None] & wanted)
    number, at = np.unique(places.step, return_index=True)
    step = np.concatenate([sampled, number])
    when = np.concatenate([time.T[sampled, inside + 1], places.time[at]])
    order = np.argsort(when, kind="stable")
    missed = order[_unmatched(when[order], came, float(np.diff(path.time).max()))]
    if not len(missed):
        return None
    return Passed("", float(when[missed[0]]), float(steps.length[step[missed[0]]]), len(missed))


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
    more = f", and so {found.count - 1} times more" if found.count > 1 else ""
    said = f"{found.event} passes zero and back near t = {found.time:.6g} s within one step of {number(found.step)} s{more}"
    text = f"Events: {said}; the run has not seen it: use a shorter step, or a method that chooses its steps"
    return Item("events", "amber", text, row=found.event, time=found.time)


CHECKS = (Check("events", (Run,), look, say, 205, (STEPS,), "Events", blind="both pass {row} unseen"),)
