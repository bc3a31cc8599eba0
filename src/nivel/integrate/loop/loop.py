"""The only loop: steps until the end, a full buffer, a spent budget or a failure, and resumes exactly where it stopped."""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop.dense import cubic, frame_time, inside
from nivel.integrate.loop.energy import conserve
from nivel.integrate.loop.events import begin_events, find_events, hand_out_events
from nivel.integrate.loop.pace import allow, note_energy, note_step
from nivel.integrate.loop.run import (
    ACCEPTED,
    ADVANCE,
    ALL_STEPS,
    BUDGET,
    CONSERVE,
    DENSE,
    DONE_STEPS,
    END,
    EVALUATED,
    EVALUATIONS,
    EVERY,
    FRAMES,
    HORIZON,
    INSIDE,
    KNOWN,
    LAST_FRAME,
    LENGTH,
    OPEN_LIMIT,
    REACHED,
    RESTART,
    SHOWN,
    STEP,
    STOPPED,
    SWITCHED,
    TIME,
    call_step,
    run_at,
)
from nivel.integrate.loop.samples import (
    completes,
    ends_at_switches,
    find_bound,
    fit_part,
    is_past,
    is_within,
    take_samples,
    time_of,
)
from nivel.integrate.loop.step_control import fastest_turn
from nivel.integrate.loop.surfaces import allow_ahead, keep_ways
from nivel.integrate.loop.switches import change_sides, has_switches, note_sides
from nivel.kernels.core.status import BUDGET_SPENT, BUFFER_FULL, CONTRADICTION, DONE, NOT_FINITE, OK, OPEN
from nivel.kernels.output.observe import accept, observe
from nivel.kernels.record.function import NEAR
from nivel.kernels.record.hook import call_correct, call_evaluate, call_hook
from nivel.kernels.record.record import DEPART, PASS, RESUME, record_at
from nivel.kernels.solve.saddle import contradicts, exceeds
from nivel.kernels.tree.tree import has_passed
from nivel.native.entry import entry
from nivel.native.function import leaf


@leaf
def finite(y):
    """Whether every entry is a number (a NaN or an infinity makes the difference a NaN)."""
    total = 0.0
    for i in range(y.shape[0]):
        total += y[i] - y[i]
    return total == 0.0


@leaf
def at_end(run):
    """Whether the accepted state is the last one of the run."""
    counter = run.counter
    if counter[STOPPED] > 0:
        return True
    if counter[ALL_STEPS] > 0:
        return counter[DONE_STEPS] == counter[ALL_STEPS]
    return run.clock[TIME] >= run.clock[END]


@leaf
def is_due(run):
    """Whether the accepted state is to be a frame. LAST_FRAME counts steps where they are fixed, frames otherwise."""
    counter = run.counter
    if counter[STOPPED] > 0:
        return run.clock[SHOWN] != run.clock[TIME]
    if counter[ALL_STEPS] > 0:
        n = counter[DONE_STEPS]
        return (n % counter[EVERY] == 0 or at_end(run)) and counter[LAST_FRAME] != n
    return is_past(run.clock[TIME], frame_time(run, counter[LAST_FRAME] + 1))


@leaf
def evaluate_without_feedback(evaluate, machine, t, y, history):
    """Evaluate again without Baumgarte's feedback where there is one: its multipliers and accelerations steer the numbers back, they
    are not those of the machine (with eq. 111 the difference is per cent and does not vanish with the step). `rate` stays."""
    run = run_at(history)
    feedback = record_at(machine).control.stabilise
    twice_alpha, beta_squared = feedback[0], feedback[1]
    if twice_alpha == 0.0 and beta_squared == 0.0:
        return OK
    feedback[0], feedback[1] = 0.0, 0.0
    status = call_evaluate(evaluate, machine, t, y, run.scratch)
    feedback[0], feedback[1] = twice_alpha, beta_squared
    run.counter[EVALUATIONS] += 1
    return status


@leaf
def write_frame(machine, history, t, y):
    """One frame from the state last evaluated, which is y."""
    run = run_at(history)
    counter = run.counter
    frame = run.frames[counter[FRAMES]]
    frame[0] = t
    run.clock[SHOWN] = t
    observe(machine, t, y, frame)
    counter[FRAMES] += 1
    counter[LAST_FRAME] = counter[DONE_STEPS] if counter[ALL_STEPS] > 0 else counter[LAST_FRAME] + 1


@leaf
def write_inside(evaluate, correct, machine, history):
    """Frames at times inside the last step. Returns a status; BUFFER_FULL where it has to be called again."""
    run = run_at(history)
    clock, counter = run.clock, run.counter
    while counter[ALL_STEPS] == 0:
        t = frame_time(run, counter[LAST_FRAME] + 1)
        if is_past(t, clock[REACHED]):
            break
        if counter[FRAMES] == run.frames.shape[0]:
            return BUFFER_FULL
        if counter[DENSE] == 0:
            status = call_evaluate(evaluate, machine, clock[REACHED], run.y, run.scratch)
            counter[EVALUATIONS] += 1
            if status != OK:
                return status
            cubic(run, run.rate, run.scratch)
        counter[KNOWN] = 0
        inside(run, (t - clock[TIME]) / clock[LENGTH], run.trial)
        status = call_correct(correct, machine, t, run.trial)
        if status == OK:
            status = call_evaluate(evaluate, machine, t, run.trial, run.scratch)
            counter[EVALUATIONS] += 1
        if status == OK:
            status = evaluate_without_feedback(evaluate, machine, t, run.trial, history)
        if status != OK:
            return status
        write_frame(machine, history, t, run.trial)
    return OK


@leaf
def evaluate_accepted(evaluate, machine, history):
    """rate := that of the state reached, which the search for events may have evaluated already. Returns a status."""
    run = run_at(history)
    if run.counter[KNOWN] == 1:
        run.counter[KNOWN] = 0
        for i in range(run.y.shape[0]):
            run.rate[i] = run.scratch[i]
        return OK
    run.counter[EVALUATIONS] += 1
    return call_evaluate(evaluate, machine, run.clock[TIME], run.y, run.rate)


@leaf
def accept_state(evaluate, machine, history, due):
    """Evaluate at the state reached, keep what has to be kept, write a frame if one is due. Returns a status."""
    run = run_at(history)
    clock, counter = run.clock, run.counter
    record = record_at(machine)
    constraints = record.constraints
    status = evaluate_accepted(evaluate, machine, history)
    if status == OK and exceeds(record.saddle, constraints.C, constraints.scale, clock[OPEN_LIMIT]):
        return OPEN
    if status == OK and counter[CONSERVE] == 1 and counter[DONE_STEPS] > 0:
        status = conserve(evaluate, machine, history)
    for i in range(run.y.shape[0]):
        run.previous[i] = run.y[i]
    clock[ACCEPTED] = clock[TIME]
    if status != OK:
        return status
    if not finite(run.rate):
        return NOT_FINITE
    if contradicts(record.saddle, constraints, record.control.failure):
        return CONTRADICTION
    counter[EVALUATED] = 1
    keep_ways(machine, run)
    accept(machine, clock[TIME])
    note_energy(machine, run)
    if has_switches(machine, run):
        note_sides(machine, run)
    if counter[SWITCHED] == 1:
        status = change_sides(evaluate, machine, history)
        if status == OK and not finite(run.rate):
            status = NOT_FINITE
    if status == OK and record.sampled.state.shape[0] > 0:
        status = take_samples(evaluate, machine, history)
        if status == OK and not finite(run.rate):
            status = NOT_FINITE
    if status == OK and counter[DONE_STEPS] == 0 and run.event_values.shape[1] > 0 and not is_within(run):
        status = begin_events(machine, history)
    if status != OK:
        return status
    if due:
        status = evaluate_without_feedback(evaluate, machine, clock[TIME], run.y, history)
        if status != OK:
            return status
        write_frame(machine, history, clock[TIME], run.y)
    return OK


@leaf
def pass_nodes(machine, run):
    """Let a body that has passed a node of the beam that carries it move on as the beam does there. Returns a status."""
    record = record_at(machine)
    if record.hooks.address[PASS] == 0:
        return OK
    y, own = run.y, record.residual.y
    for i in range(y.shape[0]):
        own[i] = y[i]
    status = call_hook(machine, PASS, DEPART, run.clock[REACHED])
    if status != OK or not has_passed(record.tree):
        return status
    status = call_hook(machine, PASS, RESUME, run.clock[REACHED])
    for i in range(y.shape[0]):
        y[i] = own[i]
    # what came before says nothing of what comes after
    run.counter[RESTART] = 1
    return status


@leaf
def correct_reached(correct, machine, history):
    """Correct the state reached; where there are rows of the state inside the step, they end there too. Returns a status."""
    run = run_at(history)
    dense = run.counter[DENSE] > 0
    if dense:
        for i in range(run.y.shape[0]):
            run.trial[i] = run.y[i]
    status = pass_nodes(machine, run)
    if status == OK:
        status = call_correct(correct, machine, run.clock[REACHED], run.y)
    if dense:
        for i in range(run.y.shape[0]):
            run.dense[0, i] += run.y[i] - run.trial[i]
    return status


@leaf
def size_of_last(run, h):
    """The last step of fixed size, of what is left: h itself where that is round-off of it, so that a run of n steps is n steps."""
    left = run.clock[REACHED] - run.clock[TIME]
    return h if np.abs(left - h) <= NEAR * run.clock[REACHED] else left


@leaf
def take_step(evaluate, correct, step, machine, history):
    """One step from the accepted state to clock[REACHED], with the correction; then its events. Returns a status."""
    run = run_at(history)
    clock, counter = run.clock, run.counter
    n, h = counter[DONE_STEPS], clock[STEP]
    fixed = counter[ALL_STEPS] > 0
    if fixed:
        clock[REACHED] = time_of(run, n + 1)
        clock[STEP] = size_of_last(run, h) if n + 1 == counter[ALL_STEPS] else h
    else:
        allow(run)
    find_bound(machine, run)
    if not fixed:
        allow_ahead(machine, run)
    reached = fit_part(run) if ends_at_switches(run) else clock[REACHED]
    part = is_within(run) or not completes(run, reached)
    counter[DENSE] = 0
    speed = fastest_turn(machine)
    status = call_step(step, evaluate, machine, history)
    if fixed:
        clock[STEP] = h
    counter[EVALUATED] = 0
    if fixed:
        clock[REACHED] = reached
    clock[LENGTH] = clock[REACHED] - clock[TIME]
    if status == OK:
        status = correct_reached(correct, machine, history)
    if status == OK and not finite(run.y):
        status = NOT_FINITE
    if part:
        # what comes before a part says nothing of steps of another size
        counter[RESTART] = 1
    if status == OK:
        note_step(machine, run, speed)
    if status == OK and run.event_values.shape[1] > 0:
        status = find_events(evaluate, correct, machine, history)
    return status


@entry(ADVANCE)
def advance(evaluate, correct, step, machine, history):
    """Advance until Python must act: buffer full, budget spent, horizon reached, end, or failure. Returns a status of
    `nivel.kernels.core.status`.

    Each step: evaluate at the accepted state, accept it, write a frame if one is due, step, correct, find the events of the step, hand
    them out with the frames inside the step.
    Where a step fails, `run.y` is not that of an accepted state; `run.previous` and `run.clock` are.
    """
    run = run_at(history)
    clock, counter = run.clock, run.counter
    budget = counter[BUDGET]
    while True:
        if counter[INSIDE] == 1:
            status = hand_out_events(machine, history)
            if status == OK:
                status = write_inside(evaluate, correct, machine, history)
            if status != OK:
                return status
            counter[INSIDE] = 0
            done = completes(run, clock[REACHED]) or counter[STOPPED] > 0
            clock[TIME] = clock[REACHED]
            counter[DONE_STEPS] += int(done)
            if run.ends.shape[0] > 0:
                run.ends[counter[DONE_STEPS] % np.int64(run.ends.shape[0])] = clock[TIME]
        due = is_due(run)
        if due and counter[FRAMES] == run.frames.shape[0]:
            return BUFFER_FULL
        if counter[EVALUATED] == 0:
            status = accept_state(evaluate, machine, history, due)
            if status != OK:
                return status
        if at_end(run):
            return DONE
        if budget == 0 or clock[TIME] >= clock[HORIZON]:
            return BUDGET_SPENT
        budget -= 1
        status = take_step(evaluate, correct, step, machine, history)
        if status != OK:
            return status
        counter[INSIDE] = 1
