"""Loads that the steps of a run miss, functions that change between two samples, events that were passed unseen, and what was not
examined."""

import math
from bisect import bisect_left
from collections.abc import Iterator

import numpy as np

from nivel.analysis.curves.corners import corners, with_features
from nivel.analysis.curves.functions import LawCurve, SideOf, Varying, varying
from nivel.analysis.curves.missed_impulse import Unseen, beyond_samples, unseen_loads
from nivel.analysis.curves.path import Path, Steps, path_of, steps_between, steps_of
from nivel.analysis.curves.pulses import Pulse, largest_pulse
from nivel.judge.after.checks.accuracy import error_from_finer, extent
from nivel.judge.after.report import STEPS, Check
from nivel.judge.after.subject import Run
from nivel.lazy import Struct, replace
from nivel.machine.core.vectors import Array
from nivel.machine.laws.functions import Sampling
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import TIME
from nivel.results.motion import Motion
from nivel.results.trust import Item, Threshold, number
from nivel.words.wording import first_of


def steps_of_run(run: Run) -> Steps | None:
    """The steps of a run; None where it has not left its start. Those that were chosen are known where the run has looked at them."""
    end, ends = float(run.result.time[-1]), run.finished.ends
    if not end > 0.0:
        return None
    if ends is not None and len(ends) > 1:
        return steps_between(ends).until(end)
    settings = run.plan.settings
    step = settings.step if settings.steps else None
    met = corners(run.machine) if step is None or run.prepared.integrator.knows_corners else ()
    return steps_of(run.pace, settings.duration, step, met).until(end)


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


def _look_at_loads(run: Run) -> list[Unseen]:
    """What is missed by much, or by more than a headline that two runs agree on allows."""
    agreed = _agreed(run)
    return _most([each for each in _unseen_by(run) if _is_missed(each, agreed)])


def _say_loads(found: Unseen) -> Item:
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


def _look_between_samples(run: Run) -> list[Unseen]:
    found = between_samples(run.machine, float(run.result.time[-1]))
    return _most([each for each in found if not each.share < SAMPLING.green])


def _say_between_samples(found: Unseen) -> Item:
    said = f"after t = {found.time:.6g} s {found.name} changes by {number(found.share)} of its range and back between two samples"
    advice = f"{number(found.step)} s apart, within {number(found.scale)} s; use a shorter sample_time if the block shall see it"
    return SAMPLING.item("sampling", f"Sampling: {said} {advice}", found.share, found.time, found.name)


def _most(found: list[Unseen]) -> list[Unseen]:
    return sorted(found, key=lambda each: -each.share)[:SHOWN]


def _unseen_by(run: Run) -> list[Unseen]:
    chosen, steps = run.plan.settings.steps == 0, steps_of_run(run)
    if steps is None:
        return []
    known = run.finished.impulses
    found = list(unseen_loads(run.machine, run.result, steps, run.prepared.integrator, chosen=chosen, known=known))
    run.finished.hurried |= {each.name for each in found if not each.whole}
    return found


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


# Places between two samples that are looked at, and samples at most.
PLACES, MOST_SAMPLES = 16, 20_000


def between_samples(machine: MachineRecord, end: float) -> Iterator[Unseen]:
    """Of each sampled function of time alone up to `end` [s]: by how much of its range it goes beyond two samples between them, at most."""
    for function in varying(machine, sampled=True):
        if function.sampling is not None and function.sampling.period > 0.0 and not function.curve.signals:
            found = _beyond(function, function.sampling, end)
            if found is not None:
                yield found


def _beyond(function: Varying, sampling: Sampling, end: float) -> Unseen | None:
    count = min(int((end - sampling.offset) / sampling.period), MOST_SAMPLES)
    if count < 1:
        return None
    samples: Array = sampling.offset + sampling.period * np.arange(count + 1, dtype=np.float64)
    share = np.arange(PLACES) / PLACES
    time = np.append((samples[:-1, None] + sampling.period * share).ravel(), samples[-1])
    time, values = with_features(function.curve, time, np.nan_to_num(function.curve.values({TIME: time})))
    interval = np.clip(np.searchsorted(samples, time, side="right") - 1, 0, count - 1)
    low, high = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(low, interval, values)
    np.maximum.at(high, interval, values)
    at_samples = np.nan_to_num(function.curve.values({TIME: samples}))
    beyond = np.maximum(
        high - np.maximum(at_samples[:-1], at_samples[1:]), np.minimum(at_samples[:-1], at_samples[1:]) - low
    )
    span, k = float(np.ptp(values)), int(np.argmax(beyond))
    if not span > 0.0:
        return None
    inside = np.flatnonzero(interval == k)
    slope = float(np.max(np.abs(np.diff(values[inside])) / np.maximum(np.diff(time[inside]), 1e-300), initial=0.0))
    scale = span / slope if slope > 0.0 else sampling.period
    return Unseen(function.name, float(beyond[k]) / span, float(samples[k]), scale, sampling.period)


# parts of a step between samples
SAMPLES = 16


class Passed(Struct):
    """An event that was passed unseen near `time` [s], within a step [s] in which its side changes more than once; how many such passes."""

    event: str
    time: float
    step: float
    count: int


def _look_at_events(run: Run) -> list[Passed]:
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


def _unmatched(when: Array, came: list[float], near: float) -> list[int]:
    """The places of times [s], ascending, that have no time that `came` within `near`, where each of these is taken once."""
    left, out = sorted(came), []
    for k, time in enumerate(when):
        found = bisect_left(left, time - near)
        if found < len(left) and left[found] <= time + near:
            del left[found]
        else:
            out.append(k)
    return out


def _say_event(found: Passed) -> Item:
    more = f", and so {found.count - 1} times more" if found.count > 1 else ""
    said = f"{found.event} passes zero and back near t = {found.time:.6g} s within one step of {number(found.step)} s{more}"
    text = f"Events: {said}; the run has not seen it: use a shorter step, or a method that chooses its steps"
    return Item("events", "amber", text, row=found.event, time=found.time)


NAMED = 6  # names in a sentence


class Unexamined(Struct):
    """Names of functions that read a signal which is not in the result, of Python laws, which are known at samples only, of contacts with
    more fast pairs than *Contact* looks at, and of functions whose bounds stay wide for longer than the steps take."""

    functions: tuple[str, ...]
    laws: tuple[str, ...]
    contacts: tuple[str, ...] = ()
    hurried: tuple[str, ...] = ()


def _look_for_unexamined(run: Run) -> Unexamined | None:
    """The functions of which *Loads* knows too little."""
    every = list(varying(run.machine))
    hidden = tuple(each.name for each in every if path_of(each, run.machine, run.result) is None)
    laws = tuple(each.name for each in every if isinstance(each.curve, LawCurve) and each.name not in hidden)
    found = Unexamined(hidden, laws, run.passing.unexamined, tuple(sorted(run.finished.hurried)))
    return found if hidden or laws or found.contacts or found.hurried else None


def _say_unexamined(found: Unexamined) -> Item:
    """What was not looked at, by name. The line is green: nothing is known against the result."""
    said = []
    if found.functions:
        said.append(
            f"what the steps miss of {first_of(found.functions, NAMED)}, which read signals that are not in the result"
        )
    if found.laws:
        said.append(
            f"what {first_of(found.laws, NAMED)} may do within a sixteenth of a step: Python functions have no bounds"
        )
    if found.hurried:
        said.append(
            f"what {first_of(found.hurried, NAMED)} may do within a sixteenth of a step: to know it takes longer than the run"
        )
    if found.contacts:
        said.append(f"whether bodies pass through each other within a step at {first_of(found.contacts, NAMED)}")
    return Item("unexamined", "green", f"Not examined: {'; '.join(said)}")


def _look_for_pulses(run: Run) -> Pulse | None:
    """The function that does most between frames; noted, as numbers that are made from frames know nothing of it."""
    found = largest_pulse(run.machine, run.result)
    if found is not None:
        run.finished.pulse = found.told
    return found


def _say_pulse(found: Pulse) -> Item:
    """The line is green: the stored numbers are right."""
    said = f"Not examined: peaks, work and cycles: {found.told}; a shorter output_interval shows it"
    return Item("unexamined", "green", said, row=found.name)


CHECKS = (
    Check(
        "loads", Run, _look_at_loads, _say_loads, 200, (STEPS,), "Loads", LOADS, "their steps miss {row}", quiet=True
    ),
    Check(
        "sampling", Run, _look_between_samples, _say_between_samples, 210, (STEPS,), "Sampling", SAMPLING, quiet=True
    ),
    Check("events", (Run,), _look_at_events, _say_event, 205, (STEPS,), "Events", blind="both pass {row} unseen"),
    Check("pulses", (Run,), _look_for_pulses, _say_pulse, 913, line="unexamined"),
    Check("unexamined", (Run,), _look_for_unexamined, _say_unexamined, 910, (STEPS,), "Not examined"),
)
