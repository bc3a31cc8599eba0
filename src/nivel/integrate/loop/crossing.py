"""Zero crossings of watched values within the last step: values, sides, location.

A value has a side, the sign of what it last was other than zero: a value that is exactly zero at an accepted state counts with the next
sign. Contacts and stops are on either side always: apart at the overlap zero.
"""

import numpy as np

from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.dense import inside
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.lanes import is_whole
from nivel.kernels.core.status import EVENT_NOT_FINITE, OK
from nivel.kernels.record.hook import call_correct, call_hook
from nivel.kernels.record.record import BOTH, DIRECTION, RISING, STOP, WATCH, record_at
from nivel.kernels.signals.watch import MARK
from nivel.native.function import leaf

# A value is located to this share of its step, or to the round-off of the time where that is larger.
SHARE, ROUND_OFF = 1e-12, 2.220446049250313e-16
# The share at which a value that does not change its side does so.
NEVER = 2.0
# The value at an end of a bracket of which the side alone is known.
UNKNOWN = 1e-300
# States beside a root, from which the rate of its value is found, are away from it by this share of the step.
ASIDE = 1e-4
# A bracket that so many regula falsi steps do not halve is bisected.
PATIENCE = 4


@leaf
def is_mark(watched, k):
    """Whether value k is none of an event, but one whose sign decides within an event's function."""
    return k < watched.event.shape[0] and watched.event[k, STOP] == MARK


@leaf
def value_of(watched, k):
    """Value k in the state last evaluated; a mark that has none is on no side."""
    value = watched.value[k]
    return 0.0 if is_mark(watched, k) and not np.abs(value) < np.inf else value


@leaf
def read_values(machine, history, row, t):
    """Row BEFORE or AFTER := the values watched in the state last evaluated, and their rates. Returns a status."""
    run, watched = of_run.run_at(history), record_at(machine).watched
    call_hook(machine, WATCH, 0, t)
    for k in range(run.event_values.shape[1]):
        value = value_of(watched, k)
        if not np.abs(value) < np.inf:
            record_at(machine).control.failure[0] = k
            return EVENT_NOT_FINITE
        run.event_values[row, k] = value
        run.event_values[of_run.RATE_BEFORE if row == of_run.BEFORE else of_run.RATE_AFTER, k] = watched.rate[k]
    return OK


@leaf
def side_of(value, k, events):
    """1, -1, or 0 where a value does not say it; those of contacts and stops, behind the `events`, always do."""
    if value > 0.0:
        return 1.0
    return -1.0 if value < 0.0 or k >= events else 0.0


@leaf
def probe(evaluate, correct, machine, history, theta):
    """trial := the state at the share θ of the last step, corrected and evaluated. Returns a status."""
    run = of_run.run_at(history)
    t = run.clock[of_run.TIME] + theta * run.clock[of_run.LENGTH]
    inside(run, theta, run.trial)
    status = call_correct(correct, machine, t, run.trial)
    if status != OK:
        return status
    run.counter[of_run.KNOWN] = 0
    return of_run.evaluate_at(evaluate, machine, run, t, run.trial, run.scratch)


@leaf
def value_at(evaluate, correct, machine, history, k, theta):
    """(status, value k) at the share θ of the last step."""
    run, watched = of_run.run_at(history), record_at(machine).watched
    status = probe(evaluate, correct, machine, history, theta)
    if status == OK:
        call_hook(machine, WATCH, 0, run.clock[of_run.TIME] + theta * run.clock[of_run.LENGTH])
        if not np.abs(value_of(watched, k)) < np.inf:
            record_at(machine).control.failure[0] = k
            status = EVENT_NOT_FINITE
    return status, value_of(watched, k)


@leaf
def locate(evaluate, correct, machine, history, k, high, above):
    """(status, θ) where value k, which has the value `above` on its other side at θ = high, changes to it."""
    values, events = of_run.run_at(history).event_values, record_at(machine).watched.event.shape[0]
    below = values[of_run.BEFORE, k]
    if below == 0.0 and k < events:
        return OK, 0.0
    return locate_between(evaluate, correct, machine, history, k, values[of_run.SIDE, k], 0.0, below, high, above)


@leaf
def locate_between(evaluate, correct, machine, history, k, side, low, below, high, above):
    """(status, θ) where value k, on this side at θ = low with the value `below`, changes to the other one, on which it is at θ = high.

    Regula falsi in the Illinois form (Dowell & Jarratt 1971), bisection where that is slow. No state is looked at nearer to an end of
    the bracket than half the tolerance, so the bracket closes when the estimate no longer moves. θ is its upper end: on the other side.
    """
    run = of_run.run_at(history)
    events, clock = record_at(machine).watched.event.shape[0], run.clock
    if below * side <= 0.0:
        below = side * UNKNOWN
    tolerance = max(SHARE, ROUND_OFF * np.abs(clock[of_run.REACHED]) / clock[of_run.LENGTH])
    last, width, slow = side, high - low, 0
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
    return root(evaluate, correct, machine, history, k, high) if is_whole(machine) else (OK, high)


@leaf
def root(evaluate, correct, machine, history, k, theta):
    """(status, θ) with the slopes of the root of value k, which is at the share θ of the step: θ - g/ġ for the value g there, of which
    slopes are left alone, and its rate ġ in a step by the states beside it."""
    theta = real(theta)
    aside = min(ASIDE, max(theta, ASIDE * ASIDE), 1.0)
    status, before = value_at(evaluate, correct, machine, history, k, theta - aside)
    if status != OK:
        return status, 0.0 * before + theta
    status, after = value_at(evaluate, correct, machine, history, k, theta + aside)
    if status != OK:
        return status, 0.0 * before + theta
    rate = 0.5 * (real(after) - real(before)) / aside
    status, value = value_at(evaluate, correct, machine, history, k, theta)
    return status, theta - (value - real(value)) / rate


@leaf
def is_wanted(direction, now):
    """Whether an event of this direction is one that changes to the side `now`."""
    return direction == BOTH or (direction == RISING) == (now > 0.0)


@leaf
def find_crossings(evaluate, correct, machine, history, first, last, high):
    """WHEN := where each of the values `first` … `last` - 1 changes its side, whose side at θ = high, in row AFTER, is another one.

    Returns a status.
    """
    run, watched = of_run.run_at(history), record_at(machine).watched
    values, events = run.event_values, watched.event.shape[0]
    for k in range(first, last):
        side, now = values[of_run.SIDE, k], side_of(values[of_run.AFTER, k], k, events)
        if side * now >= 0.0 or (k < events and not is_wanted(watched.event[k, DIRECTION], now)):
            continue
        values[of_run.TO, k] = now if k < events else values[of_run.TO, k]
        status, values[of_run.WHEN, k] = locate(evaluate, correct, machine, history, k, high, values[of_run.AFTER, k])
        if status != OK:
            return status
    return OK


@leaf
def end_at(evaluate, correct, machine, history, theta):
    """The state reached := that at the share θ of the step, with row AFTER. Returns a status."""
    run = of_run.run_at(history)
    status = probe(evaluate, correct, machine, history, theta)
    if status != OK:
        return status
    run.clock[of_run.REACHED] = run.clock[of_run.TIME] + theta * run.clock[of_run.LENGTH]
    copy(run.trial, run.y)
    run.counter[of_run.KNOWN] = 1
    return read_values(machine, history, of_run.AFTER, run.clock[of_run.REACHED])
