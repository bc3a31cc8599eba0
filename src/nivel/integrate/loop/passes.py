"""Passes of events: those that change their side within a step and are back on it at its end.

Values of events have corners and jumps where a sign within their functions changes; such signs are watched as marks, and events are looked
at on both sides of each place where one changes. Elsewhere a value that is passed twice bends, and more than it did in the step before.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop.crossing import (
    NEVER,
    SHARE,
    is_mark,
    is_wanted,
    locate,
    locate_between,
    probe,
    side_of,
    value_at,
    value_of,
)
from nivel.integrate.loop.run import (
    AFTER,
    BEFORE,
    BETWEEN,
    LENGTH,
    PAST,
    SIDE,
    SLOPE,
    TIME,
    TO,
    TWICE,
    WHEN,
    run_at,
)
from nivel.integrate.loop.switches import look_between
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import DIRECTION, WATCH, record_at
from nivel.native.function import leaf

# A mark is located to SHARE of the step; on its near side an event is looked at so many times that before it.
BEFORE_A_MARK = 8.0


@leaf
def is_back(machine, history, k):
    """Whether value k is one of an event that is on the same side at both ends of the step."""
    values, watched = run_at(history).event_values, record_at(machine).watched
    side = values[SIDE, k]
    return not is_mark(watched, k) and side != 0.0 and side * values[AFTER, k] >= 0.0 and values[WHEN, k] == NEVER


@leaf
def note_pass(evaluate, correct, machine, history, k, theta, value, end):
    """WHEN := where event k, which at θ has a value on its other side and at the share `end` of the step is back, changes its side as it is
    wanted. Returns a status."""
    values, watched = run_at(history).event_values, record_at(machine).watched
    side = values[SIDE, k]
    values[TWICE, k] = 1.0
    if is_wanted(watched.event[k, DIRECTION], -side):
        values[TO, k] = -side
        status, values[WHEN, k] = locate(evaluate, correct, machine, history, k, theta, value)
    else:
        values[TO, k] = side
        status, values[WHEN, k] = locate_between(
            evaluate, correct, machine, history, k, -side, theta, value, end, values[AFTER, k]
        )
    return status


@leaf
def look_at(evaluate, correct, machine, history, theta, end):
    """Note the events that are on their other side at the share θ of the step. Returns a status."""
    run, watched = run_at(history), record_at(machine).watched
    values, events = run.event_values, watched.event.shape[0]
    status = probe(evaluate, correct, machine, history, theta)
    if status != OK:
        return status
    call_hook(machine, WATCH, 0, run.clock[TIME] + theta * run.clock[LENGTH])
    for k in range(events):
        values[BETWEEN, k] = value_of(watched, k)
    for k in range(events):
        if is_back(machine, history, k) and side_of(values[BETWEEN, k], k, events) == -values[SIDE, k]:
            status = note_pass(evaluate, correct, machine, history, k, theta, values[BETWEEN, k], end)
            if status != OK:
                return status
    return OK


@leaf
def bends(run, k, end):
    """Whether value k may be on its other side within the step up to the share `end`: it leaves its chord by more than its distance from
    zero, if it bends as much as from the step before to this one. Of the first step nothing is known."""
    values, h = run.event_values, end * run.clock[LENGTH]
    before, after, past = np.abs(values[BEFORE, k]), np.abs(values[AFTER, k]), values[PAST, k]
    bend = np.abs((values[AFTER, k] - values[BEFORE, k]) / h - values[SLOPE, k]) * h * h / (h + past)
    return past > 0.0 and bend > min(before, after)


@leaf
def find_passes(evaluate, correct, machine, history, end):
    """WHEN := where events change their sides that are back on them at the share `end` of the step. Returns a status."""
    run, watched = run_at(history), record_at(machine).watched
    values, events = run.event_values, watched.event.shape[0]
    for k in range(events):
        values[TWICE, k] = 0.0
    for m in range(events):
        if not is_mark(watched, m) or not 0.0 < values[WHEN, m] < end:
            continue
        theta = values[WHEN, m]
        status = look_at(evaluate, correct, machine, history, theta, end)
        if status == OK:
            near = max(theta - BEFORE_A_MARK * SHARE, 0.0)
            status = look_at(evaluate, correct, machine, history, near, end)
        if status != OK:
            return status
    for k in range(events):
        if not is_back(machine, history, k) or not bends(run, k, end):
            continue
        status, between = value_at(evaluate, correct, machine, history, k, 0.5 * end)
        theta, value = NEVER, 0.0
        if status == OK:
            status, theta, value = look_between(evaluate, correct, machine, history, k, end, between)
        if status == OK and theta < NEVER:
            status = note_pass(evaluate, correct, machine, history, k, theta, value, end)
        if status != OK:
            return status
    return OK
