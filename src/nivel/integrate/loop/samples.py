"""Samples: states that change at given times or at events, between two steps; and the times at which steps end, theirs among them."""

import numpy as np

from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.crossing import read_values
from nivel.integrate.loop.switches import change_sides, has_switches, release_sides, restore_sides
from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.record.function import NEAR
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import NONE, SAMPLE, record_at
from nivel.native.function import leaf


@leaf
def time_of(run, n):
    """Time after n fixed steps, rounded once: it carries no round-off from step to step. The last step ends at the end."""
    if n == run.counter[of_run.ALL_STEPS]:
        return run.clock[of_run.END]
    return run.clock[of_run.START] + n * run.clock[of_run.STEP_TICKS] / run.clock[of_run.TICK_RATE]


@leaf
def is_past(t, other):
    """Whether the time t is the other one, except for round-off, or later: a frame at the time of a sample shows the state after it."""
    return t >= other - NEAR * np.abs(other)


@leaf
def ends_at_switches(run):
    """Whether steps of fixed size are done in parts between contacts, stops, switches and samples, as in runs for gradients. These have a
    tolerance: what a switch may do to the state unseen."""
    return run.counter[of_run.ALL_STEPS] > 0 and run.clock[of_run.TOLERANCE] > 0.0


@leaf
def is_within(run):
    """Whether the accepted state is one inside a step of fixed size."""
    return ends_at_switches(run) and run.clock[of_run.TIME] > time_of(run, run.counter[of_run.DONE_STEPS])


@leaf
def completes(run, t):
    """Whether a step of fixed size is over at the time t, which is that of the state reached."""
    return not ends_at_switches(run) or is_past(t, time_of(run, run.counter[of_run.DONE_STEPS] + 1))


@leaf
def fit_part(run):
    """clock[REACHED] and clock[STEP] := those of the next part of a step of fixed size, which ends at clock[BOUND] at the latest. A bound
    that is the end of the step moves it, with the parameters that it depends on.

    Functions that have a corner there still are what they were before it: the part ends before the time that this returns.
    """
    clock = run.clock
    if not is_past(clock[of_run.BOUND], clock[of_run.REACHED]):
        clock[of_run.REACHED] = clock[of_run.BOUND]
    elif is_past(clock[of_run.REACHED], clock[of_run.BOUND]):
        clock[of_run.REACHED] += clock[of_run.BOUND] - real(clock[of_run.BOUND])
    left, reached, k = clock[of_run.REACHED] - clock[of_run.TIME], clock[of_run.REACHED], run.counter[of_run.CORNER]
    whole = completes(run, reached) and not is_within(run)
    clock[of_run.STEP] = clock[of_run.STEP] + (left - real(left)) if whole else left
    if k < run.corners.shape[0] and is_past(reached, run.corners[k]):
        early = 2.0 * NEAR * np.abs(real(reached))
        clock[of_run.REACHED], clock[of_run.STEP] = reached - early, clock[of_run.STEP] - early
    return reached


@leaf
def find_bound(machine, run):
    """clock[BOUND] := the time of the next sample or corner, or the end of the run where that is earlier: no step goes beyond it."""
    sampled = record_at(machine).sampled
    run.clock[of_run.BOUND] = run.clock[of_run.END]
    for k in range(sampled.ticks.shape[0]):
        if sampled.ticks[k] > 0.0:
            run.clock[of_run.BOUND] = min(run.clock[of_run.BOUND], next_sample(sampled, run, k))
    corners, t = run.corners, run.clock[of_run.TIME]
    while run.counter[of_run.CORNER] < corners.shape[0] and corners[run.counter[of_run.CORNER]] <= t + NEAR * np.abs(t):
        run.counter[of_run.CORNER] += 1
    if run.counter[of_run.CORNER] < corners.shape[0]:
        run.clock[of_run.BOUND] = min(run.clock[of_run.BOUND], corners[run.counter[of_run.CORNER]])


@leaf
def next_sample(sampled, run, k):
    """Time of the next sample of entry k [s]: the decimal number that a user writes for it, so that `time >= 0.9` holds at 3 · 0.3 s."""
    return (sampled.first[k] + run.samples[k] * sampled.ticks[k]) / sampled.rate[k]


@leaf
def find_due(sampled, run):
    """Which samples are due at the accepted state, and whether any is."""
    t, found = run.clock[of_run.TIME], False
    for k in range(sampled.state.shape[0]):
        sampled.due[k] = 0
        if sampled.ticks[k] > 0.0:
            at = next_sample(sampled, run, k)
            if t >= at - NEAR * np.abs(at):
                sampled.due[k] = 1
                run.samples[k] += 1
        if sampled.event[k] != NONE and sampled.came[sampled.event[k]] == 1:
            sampled.due[k] = 1
        found = found or sampled.due[k] == 1
    for k in range(sampled.came.shape[0]):
        sampled.came[k] = 0
    return found


@leaf
def take_samples(evaluate, machine, history):
    """Give sampled states that are due their new values, in the order of `Sampled`, at the accepted state just evaluated.

    Where one changes, the state is evaluated again, and the method begins anew. Returns a status.
    """
    run, sampled = of_run.run_at(history), record_at(machine).sampled
    if not find_due(sampled, run):
        return OK
    if has_switches(machine, run):
        release_sides(machine)
    status = call_hook(machine, SAMPLE, 0, run.clock[of_run.TIME])
    first = np.int64(run.y.shape[0]) - 2 - record_at(machine).elements.state.shape[0]
    changed = False
    for k in range(sampled.state.shape[0]):
        if sampled.due[k] == 0:
            continue
        place = first + np.int64(sampled.state[k])
        if run.y[place] != sampled.value[k]:
            run.y[place] = run.previous[place] = sampled.value[k]
            changed = True
    if not changed and has_switches(machine, run):
        restore_sides(machine, run)
    if status != OK or not changed:
        return status
    status = change_sides(evaluate, machine, history)
    if run.counter[of_run.DONE_STEPS] > 0 or is_within(run):
        run.counter[of_run.RESTART] = 1
        if status == OK and run.event_values.shape[1] > 0:
            status = read_values(machine, history, of_run.BEFORE, run.clock[of_run.TIME])
    return status
