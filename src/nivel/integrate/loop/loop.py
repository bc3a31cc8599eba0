"""The only loop: steps until the end, a full buffer, a spent budget or a failure, and resumes exactly where it stopped."""

import numpy as np

from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.dense import cubic, frame_time, inside
from nivel.integrate.loop.events import begin_events, find_events, hand_out_events
from nivel.integrate.loop.run import TIME, UNCONSERVED, evaluate_at, run_at
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
from nivel.integrate.loop.step_control import evaluate_accepted, fastest_turn
from nivel.integrate.loop.surfaces import allow_ahead, keep_ways
from nivel.integrate.loop.switches import change_sides, has_switches, note_sides
from nivel.kernels.algebra.rows import copy
from nivel.kernels.bodies.rigid import turn_to_body_axes
from nivel.kernels.core.status import BUDGET_SPENT, BUFFER_FULL, CONTRADICTION, DONE, NOT_FINITE, OK, OPEN
from nivel.kernels.output.observe import accept, energies, observe
from nivel.kernels.record.function import NEAR
from nivel.kernels.record.hook import call_correct, call_evaluate, call_hook
from nivel.kernels.record.record import DEPART, PASS, RESUME, record_at
from nivel.kernels.solve.saddle import contradicts, exceeds
from nivel.kernels.tree.tree import has_passed
from nivel.native.entry import entry
from nivel.native.function import leaf

# The pace of a run: how long its steps are at which time, how far and how fast bodies move in them, how often their equations are
# iterated, and how long they may be.

# Steps at which energies are looked at, as a share: multiples of an irrational number, so that no period of a load hides from them.
IRRATIONAL, LOOKED_AT = 0.6180339887498949, 0.25


@leaf
def part_at(run, t):
    """The part of the duration that holds the time t."""
    share = (t - run.clock[of_run.START]) / (run.clock[of_run.END] - run.clock[of_run.START])
    return np.int64(max(0.0, min(of_run.PARTS - 1.0, np.floor(share * of_run.PARTS))))


@leaf
def allow(run):
    """clock[LARGEST] := what a step that begins now may be long: where it reaches into the next part, no longer there than one that begins
    there may be; and a window no further than by a short step."""
    clock, t = run.clock, run.clock[of_run.TIME]
    k = part_at(run, t)
    clock[of_run.LARGEST] = run.pace[of_run.ALLOWED, k]
    if k + 1 < of_run.PARTS:
        left = clock[of_run.START] + (k + 1) * (clock[of_run.END] - clock[of_run.START]) / of_run.PARTS - t
        clock[of_run.LARGEST] = min(clock[of_run.LARGEST], left + run.pace[of_run.ALLOWED, k + 1])
    for w in range(run.windows.shape[0]):
        window = run.windows[w]
        if t < window[of_run.UNTIL]:
            clock[of_run.LARGEST] = min(clock[of_run.LARGEST], max(window[of_run.FROM] - t, 0.0) + window[of_run.SHORT])


@leaf
def note_step(machine, run, speed):
    """Note the step from clock[TIME] to clock[REACHED]. speed : the largest angular speed at its begin [rad/s]; the record is that of a
    state near its end."""
    h = run.clock[of_run.REACHED] - run.clock[of_run.TIME]
    turn = h * max(speed, fastest_turn(machine))
    first = part_at(run, run.clock[of_run.TIME])
    for k in range(first, part_at(run, run.clock[of_run.REACHED]) + 1):
        run.pace[of_run.TAKEN, k] = max(run.pace[of_run.TAKEN, k], h)
        run.pace[of_run.LEAST, k] = min(run.pace[of_run.LEAST, k], h)
        run.pace[of_run.TURNED, k] = max(run.pace[of_run.TURNED, k], turn)
    done = run.counter[of_run.ITERATIONS] + np.int64(record_at(machine).control.iterations[1])
    k, iterations = part_at(run, run.clock[of_run.REACHED]), float(done - run.counter[of_run.COUNTED])
    run.counter[of_run.COUNTED] = done
    run.pace[of_run.STEPPED, k] += 1.0
    run.pace[of_run.ITERATED, k] += iterations
    run.pace[of_run.MOST_ITERATED, k] = max(run.pace[of_run.MOST_ITERATED, k], iterations)


@leaf
def note_energy(machine, run):
    """Note the kinetic energy of the accepted state, just evaluated, at a quarter of the steps."""
    place = IRRATIONAL * run.counter[of_run.DONE_STEPS]
    if place - np.floor(place) >= LOOKED_AT:
        return
    bodies = record_at(machine).bodies
    for b in range(bodies.mass.shape[0]):
        turn_to_body_axes(bodies, b)
    kinetic = energies(machine)[0]
    k = part_at(run, run.clock[of_run.TIME])
    run.pace[of_run.MOVING, k] = max(run.pace[of_run.MOVING, k], kinetic)


# The energy constraint of geometric elimination (report 44, eqs. 121–136, in the form that works).
#
# After positions and velocities are back on their constraints, the velocities are scaled so that T + V - W + dissipated keeps its value
# at the start. Scaling keeps Ċ = C_q v = 0 where no constraint depends on time.

# The energy that is missing is a small share of the kinetic energy; near rest it is not, and no scale factor is meant by it.
LARGEST_SHARE = 0.1


@leaf
def conserve(evaluate, machine, history):
    """Scale the velocities of y, just evaluated, and evaluate again. States too near to rest are left and counted. Returns a status."""
    run = run_at(history)
    record = record_at(machine)
    bodies, y = record.bodies, run.y
    for b in range(bodies.mass.shape[0]):
        turn_to_body_axes(bodies, b)
    kinetic, potential = energies(machine)
    last = y.shape[0] - 1
    missing = record.control.energy[2] + y[last - 1] - y[last] - potential - kinetic
    if missing == 0.0:
        return OK  # at rest for good, where no factor is known
    if not np.abs(missing) <= LARGEST_SHARE * kinetic:
        run.counter[UNCONSERVED] += 1
        return OK
    factor = np.sqrt(1.0 + missing / kinetic)
    for k in range(run.plain.shape[0]):
        y[run.plain[k, 1]] *= factor
    for k in range(run.turns.shape[0]):
        for i in range(3):
            y[run.turns[k, 1] + i] *= factor
    return evaluate_at(evaluate, machine, run, run.clock[TIME], y, run.rate)


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
    if counter[of_run.STOPPED] > 0:
        return True
    if counter[of_run.ALL_STEPS] > 0:
        return counter[of_run.DONE_STEPS] == counter[of_run.ALL_STEPS]
    return run.clock[of_run.TIME] >= run.clock[of_run.END]


@leaf
def is_due(run):
    """Whether the accepted state is to be a frame. LAST_FRAME counts steps where they are fixed, frames otherwise."""
    counter = run.counter
    if counter[of_run.STOPPED] > 0:
        return run.clock[of_run.SHOWN] != run.clock[of_run.TIME]
    if counter[of_run.ALL_STEPS] > 0:
        n = counter[of_run.DONE_STEPS]
        return (n % counter[of_run.EVERY] == 0 or at_end(run)) and counter[of_run.LAST_FRAME] != n
    return is_past(run.clock[of_run.TIME], frame_time(run, counter[of_run.LAST_FRAME] + 1))


@leaf
def evaluate_without_feedback(evaluate, machine, t, y, history):
    """Evaluate again without Baumgarte's feedback where there is one: its multipliers and accelerations steer the numbers back, they
    are not those of the machine (with eq. 111 the difference is per cent and does not vanish with the step). `rate` stays."""
    run = of_run.run_at(history)
    feedback = record_at(machine).control.stabilise
    twice_alpha, beta_squared = feedback[0], feedback[1]
    if twice_alpha == 0.0 and beta_squared == 0.0:
        return OK
    feedback[0], feedback[1] = 0.0, 0.0
    status = call_evaluate(evaluate, machine, t, y, run.scratch)
    feedback[0], feedback[1] = twice_alpha, beta_squared
    run.counter[of_run.EVALUATIONS] += 1
    return status


@leaf
def write_frame(machine, history, t, y):
    """One frame from the state last evaluated, which is y."""
    run = of_run.run_at(history)
    counter = run.counter
    frame = run.frames[counter[of_run.FRAMES]]
    frame[0] = t
    run.clock[of_run.SHOWN] = t
    observe(machine, t, y, frame)
    counter[of_run.FRAMES] += 1
    counter[of_run.LAST_FRAME] = (
        counter[of_run.DONE_STEPS] if counter[of_run.ALL_STEPS] > 0 else counter[of_run.LAST_FRAME] + 1
    )


@leaf
def write_inside(evaluate, correct, machine, history):
    """Frames at times inside the last step. Returns a status; BUFFER_FULL where it has to be called again."""
    run = of_run.run_at(history)
    clock, counter = run.clock, run.counter
    while counter[of_run.ALL_STEPS] == 0:
        t = frame_time(run, counter[of_run.LAST_FRAME] + 1)
        if is_past(t, clock[of_run.REACHED]):
            break
        if counter[of_run.FRAMES] == run.frames.shape[0]:
            return BUFFER_FULL
        if counter[of_run.DENSE] == 0:
            status = evaluate_at(evaluate, machine, run, clock[of_run.REACHED], run.y, run.scratch)
            if status != OK:
                return status
            cubic(run, clock[of_run.LENGTH], run.rate, run.scratch)
        counter[of_run.KNOWN] = 0
        inside(run, (t - clock[of_run.TIME]) / clock[of_run.LENGTH], run.trial)
        status = call_correct(correct, machine, t, run.trial)
        if status == OK:
            status = evaluate_at(evaluate, machine, run, t, run.trial, run.scratch)
        if status == OK:
            status = evaluate_without_feedback(evaluate, machine, t, run.trial, history)
        if status != OK:
            return status
        write_frame(machine, history, t, run.trial)
    return OK


@leaf
def accept_state(evaluate, machine, history, due):
    """Evaluate at the state reached, keep what has to be kept, write a frame if one is due. Returns a status."""
    run = of_run.run_at(history)
    clock, counter = run.clock, run.counter
    record = record_at(machine)
    constraints = record.constraints
    status = evaluate_accepted(evaluate, machine, history)
    if status == OK and exceeds(record.saddle, constraints.C, constraints.scale, clock[of_run.OPEN_LIMIT]):
        return OPEN
    if status == OK and counter[of_run.CONSERVE] == 1 and counter[of_run.DONE_STEPS] > 0:
        status = conserve(evaluate, machine, history)
    copy(run.y, run.previous)
    clock[of_run.ACCEPTED] = clock[of_run.TIME]
    if status != OK:
        return status
    if not finite(run.rate):
        return NOT_FINITE
    if contradicts(record.saddle, constraints, record.control.failure):
        return CONTRADICTION
    counter[of_run.EVALUATED] = 1
    keep_ways(machine, run)
    accept(machine, clock[of_run.TIME])
    note_energy(machine, run)
    if has_switches(machine, run):
        note_sides(machine, run)
    if counter[of_run.SWITCHED] == 1:
        status = change_sides(evaluate, machine, history)
        if status == OK and not finite(run.rate):
            status = NOT_FINITE
    if status == OK and record.sampled.state.shape[0] > 0:
        status = take_samples(evaluate, machine, history)
        if status == OK and not finite(run.rate):
            status = NOT_FINITE
    if status == OK and counter[of_run.DONE_STEPS] == 0 and run.event_values.shape[1] > 0 and not is_within(run):
        status = begin_events(machine, history)
    if status != OK:
        return status
    if due:
        status = evaluate_without_feedback(evaluate, machine, clock[of_run.TIME], run.y, history)
        if status != OK:
            return status
        write_frame(machine, history, clock[of_run.TIME], run.y)
    return OK


@leaf
def pass_nodes(machine, run):
    """Let a body that has passed a node of the beam that carries it move on as the beam does there. Returns a status."""
    record = record_at(machine)
    if record.hooks.address[PASS] == 0:
        return OK
    y, own = run.y, record.residual.y
    copy(y, own)
    status = call_hook(machine, PASS, DEPART, run.clock[of_run.REACHED])
    if status != OK or not has_passed(record.tree):
        return status
    status = call_hook(machine, PASS, RESUME, run.clock[of_run.REACHED])
    copy(own, y)
    # what came before says nothing of what comes after
    run.counter[of_run.RESTART] = 1
    return status


@leaf
def correct_reached(correct, machine, history):
    """Correct the state reached; where there are rows of the state inside the step, they end there too. Returns a status."""
    run = of_run.run_at(history)
    dense = run.counter[of_run.DENSE] > 0
    if dense:
        copy(run.y, run.trial)
    status = pass_nodes(machine, run)
    if status == OK:
        status = call_correct(correct, machine, run.clock[of_run.REACHED], run.y)
    if dense:
        for i in range(run.y.shape[0]):
            run.dense[0, i] += run.y[i] - run.trial[i]
    return status


@leaf
def size_of_last(run, h):
    """The last step of fixed size, of what is left: h itself where that is round-off of it, so that a run of n steps is n steps."""
    left = run.clock[of_run.REACHED] - run.clock[of_run.TIME]
    return h if np.abs(left - h) <= NEAR * run.clock[of_run.REACHED] else left


@leaf
def take_step(evaluate, correct, step, machine, history):
    """One step from the accepted state to clock[REACHED], with the correction; then its events. Returns a status."""
    run = of_run.run_at(history)
    clock, counter = run.clock, run.counter
    n, h = counter[of_run.DONE_STEPS], clock[of_run.STEP]
    fixed = counter[of_run.ALL_STEPS] > 0
    if fixed:
        clock[of_run.REACHED] = time_of(run, n + 1)
        clock[of_run.STEP] = size_of_last(run, h) if n + 1 == counter[of_run.ALL_STEPS] else h
    else:
        allow(run)
    find_bound(machine, run)
    if not fixed:
        allow_ahead(machine, run)
    reached = fit_part(run) if ends_at_switches(run) else clock[of_run.REACHED]
    part = is_within(run) or not completes(run, reached)
    counter[of_run.DENSE] = 0
    speed = fastest_turn(machine)
    status = of_run.call_step(step, evaluate, machine, history)
    if fixed:
        clock[of_run.STEP] = h
    counter[of_run.EVALUATED] = 0
    if fixed:
        clock[of_run.REACHED] = reached
    clock[of_run.LENGTH] = clock[of_run.REACHED] - clock[of_run.TIME]
    if status == OK:
        status = correct_reached(correct, machine, history)
    if status == OK and not finite(run.y):
        status = NOT_FINITE
    if part:
        # what comes before a part says nothing of steps of another size
        counter[of_run.RESTART] = 1
    if status == OK:
        note_step(machine, run, speed)
    if status == OK and run.event_values.shape[1] > 0:
        status = find_events(evaluate, correct, machine, history)
    return status


@entry(of_run.ADVANCE)
def advance(evaluate, correct, step, machine, history):
    """Advance until Python must act: buffer full, budget spent, horizon reached, end, or failure. Returns a status of
    `nivel.kernels.core.status`.

    Each step: evaluate at the accepted state, accept it, write a frame if one is due, step, correct, find the events of the step, hand
    them out with the frames inside the step.
    Where a step fails, `run.y` is not that of an accepted state; `run.previous` and `run.clock` are.
    """
    run = of_run.run_at(history)
    clock, counter = run.clock, run.counter
    budget = counter[of_run.BUDGET]
    while True:
        if counter[of_run.INSIDE] == 1:
            status = hand_out_events(machine, history)
            if status == OK:
                status = write_inside(evaluate, correct, machine, history)
            if status != OK:
                return status
            counter[of_run.INSIDE] = 0
            done = completes(run, clock[of_run.REACHED]) or counter[of_run.STOPPED] > 0
            clock[of_run.TIME] = clock[of_run.REACHED]
            counter[of_run.DONE_STEPS] += int(done)
            if run.ends.shape[0] > 0:
                run.ends[counter[of_run.DONE_STEPS] % np.int64(run.ends.shape[0])] = clock[of_run.TIME]
        due = is_due(run)
        if due and counter[of_run.FRAMES] == run.frames.shape[0]:
            return BUFFER_FULL
        if counter[of_run.EVALUATED] == 0:
            status = accept_state(evaluate, machine, history, due)
            if status != OK:
                return status
        if at_end(run):
            return DONE
        if budget == 0 or clock[of_run.TIME] >= clock[of_run.HORIZON]:
            return BUDGET_SPENT
        budget -= 1
        status = take_step(evaluate, correct, step, machine, history)
        if status != OK:
            return status
        counter[of_run.INSIDE] = 1
