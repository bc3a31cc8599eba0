"""Events of a step: which values change their sides in it, when, and where the step then ends.

An event is a change of sides from one accepted state to the next, or there and back within the step, of which
the first one that is wanted counts. Sides are kept from step to step, never found anew from the state, so an event is found once
whatever changes the state afterwards by round-off (corrections, energies).
"""

import numpy as np

from nivel.integrate.loop import crossing
from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.dense import cubic
from nivel.integrate.loop.samples import ends_at_switches
from nivel.integrate.loop.surfaces import find_contacts
from nivel.integrate.loop.switches import first_switch, has_switches, look_between, note_slopes, pass_unseen
from nivel.kernels.core.status import BUFFER_FULL, OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import DIRECTION, ENDS_RUN, ENDS_STEP, STOP, WATCH, record_at
from nivel.native.function import leaf

# Passes of events: those that change their side within a step and are back on it at its end.
#
# Values of events have corners and jumps where a sign within their functions changes; such signs are watched as marks, and events are
# looked at on both sides of each place where one changes. Elsewhere a value that is passed twice bends, and more than it did in the step
# before.

# A mark is located to SHARE of the step; on its near side an event is looked at so many times that before it.
BEFORE_A_MARK = 8.0


@leaf
def is_back(machine, history, k):
    """Whether value k is one of an event that is on the same side at both ends of the step."""
    values, watched = of_run.run_at(history).event_values, record_at(machine).watched
    side = values[of_run.SIDE, k]
    return (
        not crossing.is_mark(watched, k)
        and side != 0.0
        and side * values[of_run.AFTER, k] >= 0.0
        and values[of_run.WHEN, k] == crossing.NEVER
    )


@leaf
def note_pass(evaluate, correct, machine, history, k, theta, value, end):
    """WHEN := where event k, which at θ has a value on its other side and at the share `end` of the step is back, changes its side as it is
    wanted. Returns a status."""
    values, watched = of_run.run_at(history).event_values, record_at(machine).watched
    side = values[of_run.SIDE, k]
    values[of_run.TWICE, k] = 1.0
    if crossing.is_wanted(watched.event[k, DIRECTION], -side):
        values[of_run.TO, k] = -side
        status, values[of_run.WHEN, k] = crossing.locate(evaluate, correct, machine, history, k, theta, value)
    else:
        values[of_run.TO, k] = side
        status, values[of_run.WHEN, k] = crossing.locate_between(
            evaluate, correct, machine, history, k, -side, theta, value, end, values[of_run.AFTER, k]
        )
    return status


@leaf
def look_at(evaluate, correct, machine, history, theta, end):
    """Note the events that are on their other side at the share θ of the step. Returns a status."""
    run, watched = of_run.run_at(history), record_at(machine).watched
    values, events = run.event_values, watched.event.shape[0]
    status = crossing.probe(evaluate, correct, machine, history, theta)
    if status != OK:
        return status
    call_hook(machine, WATCH, 0, run.clock[of_run.TIME] + theta * run.clock[of_run.LENGTH])
    for k in range(events):
        values[of_run.BETWEEN, k] = crossing.value_of(watched, k)
    for k in range(events):
        if (
            is_back(machine, history, k)
            and crossing.side_of(values[of_run.BETWEEN, k], k, events) == -values[of_run.SIDE, k]
        ):
            status = note_pass(evaluate, correct, machine, history, k, theta, values[of_run.BETWEEN, k], end)
            if status != OK:
                return status
    return OK


@leaf
def bends(run, k, end):
    """Whether value k may be on its other side within the step up to the share `end`: it leaves its chord by more than its distance from
    zero, if it bends as much as from the step before to this one. Of the first step nothing is known."""
    values, h = run.event_values, end * run.clock[of_run.LENGTH]
    before, after, past = np.abs(values[of_run.BEFORE, k]), np.abs(values[of_run.AFTER, k]), values[of_run.PAST, k]
    bend = (
        np.abs((values[of_run.AFTER, k] - values[of_run.BEFORE, k]) / h - values[of_run.SLOPE, k]) * h * h / (h + past)
    )
    return past > 0.0 and bend > min(before, after)


@leaf
def find_passes(evaluate, correct, machine, history, end):
    """WHEN := where events change their sides that are back on them at the share `end` of the step. Returns a status."""
    run, watched = of_run.run_at(history), record_at(machine).watched
    values, events = run.event_values, watched.event.shape[0]
    for k in range(events):
        values[of_run.TWICE, k] = 0.0
    for m in range(events):
        if not crossing.is_mark(watched, m) or not 0.0 < values[of_run.WHEN, m] < end:
            continue
        theta = values[of_run.WHEN, m]
        status = look_at(evaluate, correct, machine, history, theta, end)
        if status == OK:
            near = max(theta - BEFORE_A_MARK * crossing.SHARE, 0.0)
            status = look_at(evaluate, correct, machine, history, near, end)
        if status != OK:
            return status
    for k in range(events):
        if not is_back(machine, history, k) or not bends(run, k, end):
            continue
        status, between = crossing.value_at(evaluate, correct, machine, history, k, 0.5 * end)
        theta, value = crossing.NEVER, 0.0
        if status == OK:
            status, theta, value = look_between(evaluate, correct, machine, history, k, end, between)
        if status == OK and theta < crossing.NEVER:
            status = note_pass(evaluate, correct, machine, history, k, theta, value, end)
        if status != OK:
            return status
    return OK


@leaf
def begin_events(machine, history):
    """The sides at the start of a run, in the state just evaluated. Returns a status."""
    run, values = of_run.run_at(history), of_run.run_at(history).event_values
    events = record_at(machine).watched.event.shape[0]
    status = crossing.read_values(machine, history, of_run.BEFORE, run.clock[of_run.TIME])
    values[of_run.WHEN, :] = crossing.NEVER
    for k in range(min(values.shape[1], first_switch(machine))):
        values[of_run.SIDE, k] = crossing.side_of(values[of_run.BEFORE, k], k, events)
    return status


@leaf
def first_stop(watched, when, fixed):
    """Number of the first event that ends the run, or the step, or -1. Steps that are `fixed` are ended by the end of the run alone."""
    first = -1
    for k in range(watched.event.shape[0]):
        stop = watched.event[k, STOP]
        ends = stop == ENDS_RUN or (stop == ENDS_STEP and not fixed)
        if ends and when[k] < crossing.NEVER and (first < 0 or when[k] < when[first]):
            first = k
    return first


@leaf
def find_events(evaluate, correct, machine, history):
    """Look at the step just done: events into row WHEN. The step ends earlier where an event ends the run or takes a sample, or a contact
    begins or ends, or a switch changes.

    Returns a status. With counter[KNOWN] the state reached is evaluated already, its rate is run.scratch.
    """
    run, watched = of_run.run_at(history), record_at(machine).watched
    values, clock, counter = run.event_values, run.clock, run.counter
    events, count = watched.event.shape[0], run.event_values.shape[1]
    status = of_run.evaluate_at(evaluate, machine, run, clock[of_run.REACHED], run.y, run.scratch)
    counter[of_run.KNOWN] = 1
    if status == OK:
        status = crossing.read_values(machine, history, of_run.AFTER, clock[of_run.REACHED])
    if status != OK:
        return status
    if counter[of_run.DENSE] == 0:
        cubic(run, clock[of_run.LENGTH], run.rate, run.scratch)
    values[of_run.WHEN, :] = crossing.NEVER
    if has_switches(machine, run):
        pass_unseen(evaluate, machine, history)
    status, end = find_contacts(evaluate, correct, machine, history, events)
    if status == OK:
        status = crossing.find_crossings(evaluate, correct, machine, history, 0, events, end)
    if status == OK and events > 0:
        status = find_passes(evaluate, correct, machine, history, end)
    stop = first_stop(watched, values[of_run.WHEN], counter[of_run.ALL_STEPS] > 0 and not ends_at_switches(run))
    if status == OK and stop >= 0:
        end = values[of_run.WHEN, stop]
        status = crossing.end_at(evaluate, correct, machine, history, end)
        if watched.event[stop, STOP] == ENDS_RUN:
            counter[of_run.STOPPED] = stop + 1
    note_slopes(run)
    for k in range(count):
        now = crossing.side_of(values[of_run.AFTER, k], k, events)
        if k >= events:
            values[of_run.SIDE, k] = now if k < first_switch(machine) else values[of_run.SIDE, k]
        elif values[of_run.WHEN, k] <= end:
            values[of_run.SIDE, k] = now if values[of_run.TWICE, k] == 1.0 and now != 0.0 else -values[of_run.SIDE, k]
            if crossing.is_mark(watched, k):
                values[of_run.WHEN, k] = crossing.NEVER
            else:
                record_at(machine).sampled.came[k] = 1
        else:
            values[of_run.WHEN, k] = crossing.NEVER
            values[of_run.SIDE, k] = now if now != 0.0 else values[of_run.SIDE, k]
        values[of_run.BEFORE, k], values[of_run.RATE_BEFORE, k] = values[of_run.AFTER, k], values[of_run.RATE_AFTER, k]
    return status


@leaf
def hand_out_events(machine, history):
    """Events of the last step in the order of time, at one time in that of the file. BUFFER_FULL where it has to be called again."""
    run, counter = of_run.run_at(history), of_run.run_at(history).counter
    when, events = run.event_values[of_run.WHEN], record_at(machine).watched.event.shape[0]
    while True:
        next_one = -1
        for k in range(events):
            if when[k] < crossing.NEVER and (next_one < 0 or when[k] < when[next_one]):
                next_one = k
        if next_one < 0:
            return OK
        if counter[of_run.EVENTS] == run.events.shape[0]:
            return BUFFER_FULL
        row = run.events[counter[of_run.EVENTS]]
        row[0] = min(run.clock[of_run.TIME] + when[next_one] * run.clock[of_run.LENGTH], run.clock[of_run.REACHED])
        row[1], row[2] = next_one, run.event_values[of_run.TO, next_one]
        when[next_one] = crossing.NEVER
        counter[of_run.EVENTS] += 1
