"""Events of a step: which values change their sign in it, when, and where the step then ends.

A value has a side, the sign of what it last was other than zero: a value that is exactly zero at an accepted state counts with the next
sign. An event is a change of sides from one accepted state to the next; of two changes within one step nothing is seen. Contacts and
stops are on either side always: apart at the overlap zero.

Sides are kept from step to step, never found anew from the state, so an event is found once whatever changes the state afterwards by
round-off (corrections, energies).
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import leaf
from nivel.kernels.hook import call_hook
from nivel.kernels.record import BOTH, DIRECTION, RISING, STOP, WATCH, record_at
from nivel.kernels.status import BUFFER_FULL, EVENT_NOT_FINITE, OK
from nivel.march.dense import cubic, inside
from nivel.march.run import (
    AFTER,
    BEFORE,
    DENSE,
    EVALUATIONS,
    EVENTS,
    KNOWN,
    LENGTH,
    RATE_AFTER,
    RATE_BEFORE,
    REACHED,
    RESTART,
    SIDE,
    STOPPED,
    SWITCHED,
    TIME,
    WHEN,
    run_at,
)

# An event is located to this share of its step, or to the round-off of the time where that is larger.
SHARE, ROUND_OFF = 1e-12, 2.220446049250313e-16
NEVER = 2.0
# The value at an end of a bracket of which the side alone is known.
UNKNOWN = 1e-300
# At most so many states are looked at within a step that may touch a surface and leave it; none nearer to others than this share.
LOOKS, MARGIN = 30, 0.01
# A bracket that so many regula falsi steps do not halve is bisected.
PATIENCE = 4


@leaf
def read_values(machine, history, row, t):
    """Row BEFORE or AFTER := the values watched in the state last evaluated, and their rates. Returns a status."""
    run, watched = run_at(history), record_at(machine).watched
    call_hook(machine, WATCH, 0, t)
    for k in range(run.event_values.shape[1]):
        value = watched.value[k]
        if not np.abs(value) < np.inf:
            record_at(machine).control.failure[0] = k
            return EVENT_NOT_FINITE
        run.event_values[row, k] = value
        run.event_values[RATE_BEFORE if row == BEFORE else RATE_AFTER, k] = watched.rate[k]
    return OK


@leaf
def side_of(value, k, events):
    """1, -1, or 0 where a value does not say it; those of contacts and stops, behind the `events`, always do."""
    if value > 0.0:
        return 1.0
    return -1.0 if value < 0.0 or k >= events else 0.0


@leaf
def begin_events(machine, history):
    """The sides at the start of a run, in the state just evaluated. Returns a status."""
    run, values = run_at(history), run_at(history).event_values
    events = record_at(machine).watched.event.shape[0]
    status = read_values(machine, history, BEFORE, run.clock[TIME])
    for k in range(values.shape[1]):
        values[SIDE, k], values[WHEN, k] = side_of(values[BEFORE, k], k, events), NEVER
    return status


@leaf
def probe(evaluate, correct, machine, history, theta):
    """trial := the state at the share θ of the last step, corrected and evaluated. Returns a status."""
    run = run_at(history)
    t = run.clock[TIME] + theta * run.clock[LENGTH]
    inside(run, theta, run.trial)
    status = correct(machine, t, run.trial)
    if status != OK:
        return status
    run.counter[EVALUATIONS] += 1
    run.counter[KNOWN] = 0
    return evaluate(machine, t, run.trial, run.scratch)


@leaf
def value_at(evaluate, correct, machine, history, k, theta):
    """(status, value k) at the share θ of the last step."""
    run, watched = run_at(history), record_at(machine).watched
    status = probe(evaluate, correct, machine, history, theta)
    if status == OK:
        call_hook(machine, WATCH, 0, run.clock[TIME] + theta * run.clock[LENGTH])
        if not np.abs(watched.value[k]) < np.inf:
            record_at(machine).control.failure[0] = k
            status = EVENT_NOT_FINITE
    return status, watched.value[k]


@leaf
def locate(evaluate, correct, machine, history, k, high, above):
    """(status, θ) where value k, which has the value `above` on its other side at θ = high, changes to it.

    Regula falsi in the Illinois form (Dowell & Jarratt 1971), bisection where that is slow. No state is looked at nearer to an end of
    the bracket than half the tolerance, so the bracket closes when the estimate no longer moves. θ is its upper end: on the other side.
    """
    run = run_at(history)
    events, clock = record_at(machine).watched.event.shape[0], run.clock
    side, below = run.event_values[SIDE, k], run.event_values[BEFORE, k]
    if below == 0.0 and k < events:
        return OK, 0.0
    if below * side <= 0.0:
        below = side * UNKNOWN
    tolerance = max(SHARE, ROUND_OFF * np.abs(clock[REACHED]) / clock[LENGTH])
    low, last, width, slow = 0.0, side, high, 0
    while high - low > tolerance:
        theta = 0.5 * (low + high)
        if slow < PATIENCE:
            theta = low + (high - low) * (below / (below - above))
            theta = min(max(theta, low + 0.5 * tolerance), high - 0.5 * tolerance)
        status, value = value_at(evaluate, correct, machine, history, k, theta)
        now = side_of(value, k, events)
        if status != OK or now == 0.0:
            return status, theta
        if now == side:
            low, below, above = theta, value, 0.5 * above if last == now and slow > 0 else above
        else:
            high, above, below = theta, value, 0.5 * below if last == now and slow > 0 else below
        last, slow = now, slow + 1
        if high - low < 0.5 * width:
            slow, width = 0, high - low
    return OK, high


@leaf
def is_wanted(direction, now):
    """Whether an event of this direction is one that changes to the side `now`."""
    return direction == BOTH or (direction == RISING) == (now > 0.0)


@leaf
def find_crossings(evaluate, correct, machine, history, first, last, high):
    """WHEN := where each of the values `first` … `last` - 1 changes its side, whose side at θ = high, in row AFTER, is another one.

    Returns a status.
    """
    run, watched = run_at(history), record_at(machine).watched
    values, events = run.event_values, watched.event.shape[0]
    for k in range(first, last):
        side, now = values[SIDE, k], side_of(values[AFTER, k], k, events)
        if side * now >= 0.0 or (k < events and not is_wanted(watched.event[k, DIRECTION], now)):
            continue
        status, values[WHEN, k] = locate(evaluate, correct, machine, history, k, high, values[AFTER, k])
        if status != OK:
            return status
    return OK


@leaf
def first_of(when, first):
    """The first time of those from number `first` on; of those so near to it that they are one, the last."""
    least = NEVER
    for k in range(first, when.shape[0]):
        least = min(least, when[k])
    end = least
    for k in range(first, when.shape[0]):
        if when[k] <= least + SHARE:
            end = max(end, when[k])
    return end


@leaf
def look_into(evaluate, correct, machine, history, k):
    """(status, θ, value) of a state within the step in which surface k is on its other side, although at its end it is not; θ is NEVER
    where there is none.

    Such a step comes nearer to the change of sides at its begin and goes away from it at its end. States are looked at where the
    tangents of the distance meet (Kelley 1960), until one is on the other side, or the tangents meet before it.
    """
    run, watched = run_at(history), record_at(machine).watched
    values, side, h = run.event_values, run.event_values[SIDE, k], run.clock[LENGTH]
    low, distance_low, rate_low = 0.0, side * values[BEFORE, k], side * h * values[RATE_BEFORE, k]
    high, distance_high, rate_high = 1.0, side * values[AFTER, k], side * h * values[RATE_AFTER, k]
    for _ in range(LOOKS):
        if rate_low >= 0.0 or rate_high <= 0.0:
            break
        theta = (distance_high - distance_low + rate_low * low - rate_high * high) / (rate_low - rate_high)
        if distance_low + rate_low * (theta - low) >= 0.0:
            break
        theta = min(max(theta, low + MARGIN * (high - low)), high - MARGIN * (high - low))
        status, value = value_at(evaluate, correct, machine, history, k, theta)
        if status != OK or value * side <= 0.0:
            return status, theta, value
        rate = side * h * watched.rate[k]
        if rate < 0.0:
            low, distance_low, rate_low = theta, side * value, rate
        else:
            high, distance_high, rate_high = theta, side * value, rate
    return OK, NEVER, 0.0


@leaf
def end_at(evaluate, correct, machine, history, theta):
    """The state reached := that at the share θ of the step, with row AFTER. Returns a status."""
    run = run_at(history)
    status = probe(evaluate, correct, machine, history, theta)
    if status != OK:
        return status
    run.clock[REACHED] = run.clock[TIME] + theta * run.clock[LENGTH]
    for i in range(run.y.shape[0]):
        run.y[i] = run.trial[i]
    run.counter[KNOWN] = 1
    return read_values(machine, history, AFTER, run.clock[REACHED])


@leaf
def find_contacts(evaluate, correct, machine, history, events):
    """(status, θ) where the step has to end because a contact or stop begins or ends; 1 where none does."""
    run = run_at(history)
    values = run.event_values
    if values.shape[1] == events:
        return OK, 1.0
    status = find_crossings(evaluate, correct, machine, history, events, values.shape[1], 1.0)
    for k in range(events, values.shape[1]):
        if status == OK and values[WHEN, k] == NEVER:
            status, theta, value = look_into(evaluate, correct, machine, history, k)
            if status == OK and theta < NEVER and side_of(value, k, events) != values[SIDE, k]:
                status, values[WHEN, k] = locate(evaluate, correct, machine, history, k, theta, value)
    end = first_of(values[WHEN], events)
    if end < NEVER:
        run.counter[RESTART], run.counter[SWITCHED] = 1, 1
        if status == OK:
            status = end_at(evaluate, correct, machine, history, end)
    return status, min(end, 1.0)


@leaf
def first_stop(watched, when):
    """Number of the first event that ends the run, or -1."""
    first = -1
    for k in range(watched.event.shape[0]):
        if watched.event[k, STOP] == 1 and when[k] < NEVER and (first < 0 or when[k] < when[first]):
            first = k
    return first


@leaf
def find_events(evaluate, correct, machine, history):
    """Look at the step just done: events into row WHEN; the step ends earlier where an event ends the run, or a contact begins or ends.

    Returns a status. With counter[KNOWN] the state reached is evaluated already, its rate is run.scratch.
    """
    run, watched = run_at(history), record_at(machine).watched
    values, clock, counter = run.event_values, run.clock, run.counter
    events, count = watched.event.shape[0], run.event_values.shape[1]
    status = evaluate(machine, clock[REACHED], run.y, run.scratch)
    counter[EVALUATIONS] += 1
    counter[KNOWN] = 1
    if status == OK:
        status = read_values(machine, history, AFTER, clock[REACHED])
    if status != OK:
        return status
    if counter[DENSE] == 0:
        cubic(run, run.rate, run.scratch)
    values[WHEN, :] = NEVER
    status, end = find_contacts(evaluate, correct, machine, history, events)
    if status == OK:
        status = find_crossings(evaluate, correct, machine, history, 0, events, end)
    stop = first_stop(watched, values[WHEN])
    if status == OK and stop >= 0:
        end = values[WHEN, stop]
        status = end_at(evaluate, correct, machine, history, end)
        counter[STOPPED] = stop + 1
    for k in range(count):
        now = side_of(values[AFTER, k], k, events)
        if k >= events:
            values[SIDE, k] = now
        elif values[WHEN, k] <= end:
            values[SIDE, k] = -values[SIDE, k]
        else:
            values[WHEN, k] = NEVER
            values[SIDE, k] = now if now != 0.0 else values[SIDE, k]
        values[BEFORE, k], values[RATE_BEFORE, k] = values[AFTER, k], values[RATE_AFTER, k]
    return status


@leaf
def hand_out_events(machine, history):
    """Events of the last step in the order of time, at one time in that of the file. BUFFER_FULL where it has to be called again."""
    run, counter = run_at(history), run_at(history).counter
    when, events = run.event_values[WHEN], record_at(machine).watched.event.shape[0]
    while True:
        next_one = -1
        for k in range(events):
            if when[k] < NEVER and (next_one < 0 or when[k] < when[next_one]):
                next_one = k
        if next_one < 0:
            return OK
        if counter[EVENTS] == run.events.shape[0]:
            return BUFFER_FULL
        row = run.events[counter[EVENTS]]
        row[0] = min(run.clock[TIME] + when[next_one] * run.clock[LENGTH], run.clock[REACHED])
        row[1], row[2] = next_one, run.event_values[SIDE, next_one]
        when[next_one] = NEVER
        counter[EVENTS] += 1
