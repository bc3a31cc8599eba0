"""Events of a step: which values change their sides in it, when, and where the step then ends.

An event is a change of sides from one accepted state to the next, or there and back within the step (`nivel.integrate.loop.passes`), of
which the first one that is wanted counts. Sides are kept from step to step, never found anew from the state, so an event is found once
whatever changes the state afterwards by round-off (corrections, energies).
"""

from __future__ import annotations

from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.crossing import NEVER, end_at, find_crossings, is_mark, read_values, side_of
from nivel.integrate.loop.dense import cubic
from nivel.integrate.loop.passes import find_passes
from nivel.integrate.loop.samples import ends_at_switches
from nivel.integrate.loop.surfaces import find_contacts
from nivel.integrate.loop.switches import first_switch, has_switches, note_slopes, pass_unseen
from nivel.kernels.core.status import BUFFER_FULL, OK
from nivel.kernels.record.hook import call_evaluate
from nivel.kernels.record.record import ENDS_RUN, ENDS_STEP, STOP, record_at
from nivel.native.function import leaf


@leaf
def begin_events(machine, history):
    """The sides at the start of a run, in the state just evaluated. Returns a status."""
    run, values = of_run.run_at(history), of_run.run_at(history).event_values
    events = record_at(machine).watched.event.shape[0]
    status = read_values(machine, history, of_run.BEFORE, run.clock[of_run.TIME])
    values[of_run.WHEN, :] = NEVER
    for k in range(min(values.shape[1], first_switch(machine))):
        values[of_run.SIDE, k] = side_of(values[of_run.BEFORE, k], k, events)
    return status


@leaf
def first_stop(watched, when, fixed):
    """Number of the first event that ends the run, or the step, or -1. Steps that are `fixed` are ended by the end of the run alone."""
    first = -1
    for k in range(watched.event.shape[0]):
        stop = watched.event[k, STOP]
        ends = stop == ENDS_RUN or (stop == ENDS_STEP and not fixed)
        if ends and when[k] < NEVER and (first < 0 or when[k] < when[first]):
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
    status = call_evaluate(evaluate, machine, clock[of_run.REACHED], run.y, run.scratch)
    counter[of_run.EVALUATIONS] += 1
    counter[of_run.KNOWN] = 1
    if status == OK:
        status = read_values(machine, history, of_run.AFTER, clock[of_run.REACHED])
    if status != OK:
        return status
    if counter[of_run.DENSE] == 0:
        cubic(run, run.rate, run.scratch)
    values[of_run.WHEN, :] = NEVER
    if has_switches(machine, run):
        pass_unseen(evaluate, machine, history)
    status, end = find_contacts(evaluate, correct, machine, history, events)
    if status == OK:
        status = find_crossings(evaluate, correct, machine, history, 0, events, end)
    if status == OK and events > 0:
        status = find_passes(evaluate, correct, machine, history, end)
    stop = first_stop(watched, values[of_run.WHEN], counter[of_run.ALL_STEPS] > 0 and not ends_at_switches(run))
    if status == OK and stop >= 0:
        end = values[of_run.WHEN, stop]
        status = end_at(evaluate, correct, machine, history, end)
        if watched.event[stop, STOP] == ENDS_RUN:
            counter[of_run.STOPPED] = stop + 1
    note_slopes(run)
    for k in range(count):
        now = side_of(values[of_run.AFTER, k], k, events)
        if k >= events:
            values[of_run.SIDE, k] = now if k < first_switch(machine) else values[of_run.SIDE, k]
        elif values[of_run.WHEN, k] <= end:
            values[of_run.SIDE, k] = now if values[of_run.TWICE, k] == 1.0 and now != 0.0 else -values[of_run.SIDE, k]
            if is_mark(watched, k):
                values[of_run.WHEN, k] = NEVER
            else:
                record_at(machine).sampled.came[k] = 1
        else:
            values[of_run.WHEN, k] = NEVER
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
            if when[k] < NEVER and (next_one < 0 or when[k] < when[next_one]):
                next_one = k
        if next_one < 0:
            return OK
        if counter[of_run.EVENTS] == run.events.shape[0]:
            return BUFFER_FULL
        row = run.events[counter[of_run.EVENTS]]
        row[0] = min(run.clock[of_run.TIME] + when[next_one] * run.clock[of_run.LENGTH], run.clock[of_run.REACHED])
        row[1], row[2] = next_one, run.event_values[of_run.TO, next_one]
        when[next_one] = NEVER
        counter[of_run.EVENTS] += 1
