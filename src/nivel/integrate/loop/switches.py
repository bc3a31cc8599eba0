"""Switches where steps are chosen: differences of signals whose signs decide about values of expressions, as in `if(x > 2 m, …)`.

A switch keeps its side within a step, so that the step sees a smooth machine, and the step ends where the difference changes its sign.
Its margin is positive as long as the side is that of the difference. Where the other side is another motion by next to nothing, as of
`abs(v)` at rest, the step stands, and the side changes at its end.

A switch that goes back before its jump has moved the machine would do so without end: on either side forces push to where they jump
(sliding modes; Filippov 1988). It is let go: its difference decides at every instant, as in steps of fixed size, and the estimate of the
error alone looks after it. It is kept again when it has not changed its side for some steps, twice as many each time it is let go.
"""

import numpy as np

from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.crossing import NEVER, locate, probe, read_values, value_at
from nivel.integrate.loop.step_control import size
from nivel.kernels.algebra.rows import clear, copy, subtract
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_evaluate
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

# What a change of sides may do to the state in a step, as a share of the tolerance, without ending it: what methods give to a step.
UNSEEN = 0.1
# At most so many states are looked at within a step for one switch, none nearer to others than this share of what is between these.
LOOKS, MARGIN = 10, 0.01


@leaf
def first_switch(machine):
    """Number of the first switch among the values that are watched."""
    watched = record_at(machine).watched
    return watched.event.shape[0] + watched.surface.shape[0]


@leaf
def has_switches(machine, run):
    """Whether this run keeps sides of switches."""
    return run.event_values.shape[1] > first_switch(machine)


@leaf
def release_sides(machine):
    """Let the differences decide in what is evaluated next."""
    held = record_at(machine).watched.held
    clear(held)


@leaf
def restore_sides(machine, run):
    """The sides of the accepted state are kept again."""
    held, first = record_at(machine).watched.held, first_switch(machine)
    for k in range(held.shape[0]):
        held[k] = run.event_values[of_run.LAST, first + k] if run.event_values[of_run.WAIT, first + k] == 0.0 else 0.0


@leaf
def side_now(machine, k):
    """The side of switch k in the state last evaluated; 0 where its difference is no number."""
    record = record_at(machine)
    side = record.functions.arguments[record.watched.switch[k, 0]]
    return side if np.abs(side) == 1.0 else 0.0


@leaf
def hold_side(machine, run, k):
    """Switch k keeps the side of the state last evaluated, unless it is let go."""
    record, values, place = record_at(machine), run.event_values, first_switch(machine) + k
    side = side_now(machine, k)
    values[of_run.LAST, place] = side
    record.watched.held[k] = side if values[of_run.WAIT, place] == 0.0 else 0.0
    values[of_run.SIDE, place] = np.abs(record.watched.held[k])
    values[of_run.BEFORE, place] = (
        side * record.functions.arguments[record.watched.switch[k, 1]] if side != 0.0 else 0.0
    )
    values[of_run.PAST, place] = 0.0


@leaf
def note_sides(machine, run):
    """Look at the sides of the accepted state, just evaluated: they change where the expression has no value on the side that is kept."""
    values, first = run.event_values, first_switch(machine)
    held = record_at(machine).watched.held
    for k in range(held.shape[0]):
        place, side = first + k, side_now(machine, k)
        values[of_run.JUMP, place] = 0.0
        if values[of_run.WAIT, place] > 0.0:
            values[of_run.WAIT, place] = (
                values[of_run.WAIT, place] - 1.0
                if side == values[of_run.LAST, place]
                else values[of_run.PATIENCE, place]
            )
            hold_side(machine, run, k)
        elif side != held[k]:
            run.counter[of_run.SWITCHED] = 1


@leaf
def change_sides(evaluate, machine, history):
    """Contacts, stops and switches are on the sides of the accepted state from here on; its rate is evaluated anew. Returns a status."""
    run, watched = of_run.run_at(history), record_at(machine).watched
    run.counter[of_run.SWITCHED] = 0
    run.counter[of_run.EVALUATIONS] += 1
    if not has_switches(machine, run):
        return call_evaluate(evaluate, machine, run.clock[of_run.TIME], run.y, run.rate)
    copy(run.rate, run.scratch)
    release_sides(machine)
    status = call_evaluate(evaluate, machine, run.clock[of_run.TIME], run.y, run.rate)
    subtract(run.rate, run.scratch)
    jump, first = size(run, run.scratch), first_switch(machine)
    for k in range(watched.held.shape[0]):
        before = run.event_values[of_run.LAST, first + k]
        hold_side(machine, run, k)
        run.event_values[of_run.JUMP, first + k] = jump if run.event_values[of_run.LAST, first + k] != before else 0.0
    return status


@leaf
def may_return(machine, run):
    """Whether a switch may be beyond within the step although it is not at its end.

    A parabola through three accepted states leaves its chord by |Δslope| h²/(4 (h + past)) in the last step; a margin that bends four
    times as much may pass zero.
    """
    values, h = run.event_values, run.clock[of_run.REACHED] - run.clock[of_run.TIME]
    for k in range(first_switch(machine), values.shape[1]):
        if values[of_run.SIDE, k] > 0.0 and values[of_run.AFTER, k] > 0.0:
            past, slope = values[of_run.PAST, k], (values[of_run.AFTER, k] - values[of_run.BEFORE, k]) / h
            bend = np.abs(slope - values[of_run.SLOPE, k]) * h * h / (h + past)
            if past == 0.0 or bend > min(values[of_run.BEFORE, k], values[of_run.AFTER, k]):
                return True
    return False


@leaf
def note_slopes(run):
    """Keep the mean slopes of all values in the step just done, for the next one."""
    values, h = run.event_values, run.clock[of_run.REACHED] - run.clock[of_run.TIME]
    for k in range(values.shape[1]):
        values[of_run.SLOPE, k], values[of_run.PAST, k] = (values[of_run.AFTER, k] - values[of_run.BEFORE, k]) / h, h


@leaf
def look_half_way(evaluate, correct, machine, history):
    """Row MIDDLE := the margins half way through the last step. Returns a status."""
    run = of_run.run_at(history)
    status = probe(evaluate, correct, machine, history, 0.5)
    if status == OK:
        status = read_values(machine, history, of_run.MIDDLE, run.clock[of_run.TIME] + 0.5 * run.clock[of_run.LENGTH])
    return status


@leaf
def pass_unseen(evaluate, machine, history):
    """Let the step stand that ends beyond switches if the motion on their other sides differs by next to nothing.

    scratch is the rate at the end of the step on the sides kept.
    """
    run = of_run.run_at(history)
    values, first, crossed = run.event_values, first_switch(machine), False
    for k in range(first, values.shape[1]):
        crossed = crossed or (values[of_run.SIDE, k] > 0.0 and values[of_run.AFTER, k] < 0.0)
    if not crossed:
        return
    release_sides(machine)
    run.counter[of_run.KNOWN] = 0
    status = of_run.evaluate_at(evaluate, machine, run, run.clock[of_run.REACHED], run.y, run.trial)
    restore_sides(machine, run)
    subtract(run.scratch, run.trial)
    if status == OK and run.clock[of_run.LENGTH] * size(run, run.trial) <= UNSEEN * run.clock[of_run.TOLERANCE]:
        run.counter[of_run.SWITCHED] = 1
        for k in range(first, values.shape[1]):
            values[of_run.AFTER, k] = np.abs(values[of_run.AFTER, k])


@leaf
def look_between(evaluate, correct, machine, history, k, end, between):
    """(status, θ, value) of a state within the step up to the share `end` in which value k, which is `between` half way there, is on its
    other side, although at the end it is not; θ is NEVER where there is none.

    States are looked at where the parabola through the nearest three values known is least, as long as that is beyond (Brent 1973, §5.3).
    """
    values = of_run.run_at(history).event_values
    side = values[of_run.SIDE, k]
    low, middle, high = 0.0, 0.5 * end, end
    f, g, h = max(side * values[of_run.BEFORE, k], 0.0), side * between, side * values[of_run.AFTER, k]
    if g < 0.0:
        return OK, middle, between
    for _ in range(LOOKS):
        first, second = (g - f) / (middle - low), (h - g) / (high - middle)
        bend = (second - first) / (high - low)
        if bend <= 0.0:
            break
        theta = 0.5 * (low + middle - first / bend)
        near = MARGIN * (high - low)
        if not low + near < theta < high - near or np.abs(theta - middle) < near:
            break
        if f + (theta - low) * (first + bend * (theta - middle)) >= 0.0:
            break
        status, value = value_at(evaluate, correct, machine, history, k, theta)
        if status != OK or side * value < 0.0:
            return status, theta, value
        value *= side
        if value >= g and theta < middle:
            low, f = theta, value
        elif value >= g:
            high, h = theta, value
        elif theta < middle:
            high, h, middle, g = middle, g, theta, value
        else:
            low, f, middle, g = middle, g, theta, value
    return OK, NEVER, 0.0


@leaf
def find_between(evaluate, correct, machine, history):
    """WHEN := where switches change their sides that are back on them at the end of the step. Returns a status."""
    run = of_run.run_at(history)
    values = run.event_values
    if not may_return(machine, run):
        return OK
    status = look_half_way(evaluate, correct, machine, history)
    if status != OK:
        return status
    for k in range(first_switch(machine), values.shape[1]):
        if values[of_run.SIDE, k] == 0.0 or values[of_run.WHEN, k] < NEVER:
            continue
        status, theta, margin = look_between(evaluate, correct, machine, history, k, 1.0, values[of_run.MIDDLE, k])
        if status == OK and theta < NEVER:
            status, values[of_run.WHEN, k] = locate(evaluate, correct, machine, history, k, theta, margin)
        if status != OK:
            return status
    return OK


@leaf
def let_go(machine, run, end):
    """Let switches go that change at the share `end` of the step, and did at its begin, if their jump has moved next to nothing since."""
    values, least = run.event_values, UNSEEN * run.clock[of_run.TOLERANCE]
    for k in range(first_switch(machine), values.shape[1]):
        whole = run.clock[of_run.LENGTH] * values[of_run.JUMP, k]
        if values[of_run.WHEN, k] <= end and end * whole <= least < whole:
            values[of_run.PATIENCE, k] = max(2.0 * values[of_run.PATIENCE, k], 1.0)
            values[of_run.WAIT, k] = values[of_run.PATIENCE, k]
