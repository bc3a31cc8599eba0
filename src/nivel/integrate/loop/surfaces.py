"""Contacts, stops and switches where steps are chosen: a step ends where a surface begins or ceases to touch, or a switch changes."""

from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.crossing import NEVER, SHARE, end_at, find_crossings, locate, side_of, value_at
from nivel.integrate.loop.switches import find_between, first_switch, has_switches, let_go
from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import WATCH, record_at
from nivel.kernels.signals.watch import AHEAD, ARRIVE, KEEP, LOOK
from nivel.native.function import leaf

# At most so many states are looked at within a step that may touch a surface and leave it; none nearer to others than this share.
LOOKS, MARGIN = 30, 0.01


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
    run, watched = of_run.run_at(history), record_at(machine).watched
    values, side, h = run.event_values, run.event_values[of_run.SIDE, k], run.clock[of_run.LENGTH]
    low, distance_low, rate_low = 0.0, side * values[of_run.BEFORE, k], side * h * values[of_run.RATE_BEFORE, k]
    high, distance_high, rate_high = 1.0, side * values[of_run.AFTER, k], side * h * values[of_run.RATE_AFTER, k]
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
def has_heights(machine):
    """Whether the ground of a contact has heights."""
    followed = record_at(machine).watched.followed
    return followed[2] > followed[1]


@leaf
def keep_ways(machine, run):
    """Ways over heights begin, or go on, at the state last evaluated, which is accepted."""
    if has_heights(machine):
        call_hook(machine, WATCH, KEEP, run.clock[of_run.TIME])


@leaf
def allow_ahead(machine, run):
    """clock[LARGEST] no longer than the heights ahead of what touches them allow."""
    if has_heights(machine):
        clock = run.clock
        h = min(
            real(clock[of_run.STEP]), real(clock[of_run.LARGEST]), real(clock[of_run.BOUND]) - real(clock[of_run.TIME])
        )
        call_hook(machine, WATCH, AHEAD, clock[of_run.TIME] + h)
        share = real(record_at(machine).watched.value[0])
        if share < 1.0:
            clock[of_run.LARGEST] = share * h


@leaf
def look_over_heights(evaluate, correct, machine, history, events):
    """WHEN := where points change their sides first over heights between the ends of the step. Returns a status.

    What the way between both ends shows is looked at in the state there."""
    run, watched = of_run.run_at(history), record_at(machine).watched
    values, end = run.event_values, run.clock[of_run.TIME] + run.clock[of_run.LENGTH]
    for k in range(events, first_switch(machine)):
        theta = 0.0
        for _ in range(LOOKS):
            watched.value[k] = theta
            call_hook(machine, WATCH, LOOK + k, end)
            theta = real(watched.value[k])
            if not theta < min(values[of_run.WHEN, k], 1.0):
                break
            status, value = value_at(evaluate, correct, machine, history, k, theta)
            if status == OK and side_of(value, k, events) != values[of_run.SIDE, k]:
                status, values[of_run.WHEN, k] = locate(evaluate, correct, machine, history, k, theta, value)
                theta = 1.0
            if status != OK:
                return status
    return OK


@leaf
def find_contacts(evaluate, correct, machine, history, events):
    """(status, θ) where the step has to end because a contact or stop begins or ends, or a switch changes; 1 where none does."""
    run = of_run.run_at(history)
    values = run.event_values
    if values.shape[1] == events:
        return OK, 1.0
    if has_heights(machine):
        call_hook(machine, WATCH, ARRIVE, run.clock[of_run.TIME] + run.clock[of_run.LENGTH])
    status = find_crossings(evaluate, correct, machine, history, events, values.shape[1], 1.0)
    for k in range(events, first_switch(machine)):
        if status == OK and values[of_run.WHEN, k] == NEVER:
            status, theta, value = look_into(evaluate, correct, machine, history, k)
            if status == OK and theta < NEVER and side_of(value, k, events) != values[of_run.SIDE, k]:
                status, values[of_run.WHEN, k] = locate(evaluate, correct, machine, history, k, theta, value)
    if status == OK and has_heights(machine):
        status = look_over_heights(evaluate, correct, machine, history, events)
    if status == OK and has_switches(machine, run):
        status = find_between(evaluate, correct, machine, history)
    end = first_of(values[of_run.WHEN], events)
    if end < NEVER:
        run.counter[of_run.RESTART], run.counter[of_run.SWITCHED] = 1, 1
        let_go(machine, run, end)
        if status == OK:
            status = end_at(evaluate, correct, machine, history, end)
    return status, min(end, 1.0)
