"""The choice of the step from an estimate of the error, common to all integrators that choose theirs.

Errors are measured entry by entry against the larger of `run.scale` and |y|, and the worst entry counts: in a large machine of which one
part moves fast, a mean would hide that part. `run.scale` follows the largest |y| seen, so a velocity that passes zero does not ask for
more than the tolerance of its usual size.

What the user calls the tolerance is the error of the motion at the end, so a step gets a share of it (`share`, one number an
integrator, measured on mechanisms over some ten periods): then runs end within ten times the tolerance as long as the motion itself
does not magnify errors.
"""

import numpy as np

from nivel.integrate.loop.run import (
    BOUND,
    DONE_STEPS,
    END,
    KNOWN,
    LARGEST,
    REACHED,
    REJECTED,
    RESTART,
    START,
    STEP,
    TIME,
    TOLERANCE,
    evaluate_at,
    run_at,
)
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rows import advance, copy, subtract
from nivel.kernels.core.status import NOT_FINITE, OK, STEP_TOO_SMALL
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

ROUND_OFF = 2.220446049250313e-16
# A step below this many units in the last place of the time gets nowhere.
SMALLEST = 16.0
# No body turns by more in one step [rad], so that two bodies turn by less than half a turn against each other and the angles of joints,
# which are followed from step to step, count their turns: with the speed at its begin, and with that at its end a little more.
LARGEST_TURN, TURN_GAIN = 1.4, 0.1
# A step is never asked to be more exact than this.
EXACT = 10.0 * ROUND_OFF
# A step that could not be evaluated is tried again with this share of it.
AFTER_FAILURE = 0.25
# The step that a tolerance asks for is not taken to its edge (Hairer, Nørsett, Wanner 1993, §II.4).
SAFETY, LEAST_CHANGE, MOST_CHANGE = 0.9, 0.2, 5.0
# A step may be longer by this share where it then ends the run.
STRETCH = 1.05


@leaf
def allowed(run, share):
    """What one step may be wrong by, as a share of the scales, for an integrator that gives a step this share of the tolerance."""
    return max(share * run.clock[TOLERANCE], EXACT)


@leaf
def size(run, x):
    """Largest |x| as a share of the scale of its entry; not a number where an entry is none."""
    largest = 0.0
    for i in range(x.shape[0]):
        share = np.abs(x[i]) / run.scale[i]
        if not share <= largest:
            largest = share
            if np.isnan(share):
                return share
    return largest


@leaf
def larger(largest, change, weight):
    """The larger one of `largest` and |change|/weight; NaN once anything is NaN."""
    share = np.abs(change)
    if share > 0.0:
        share /= weight
    return largest if share <= largest else share + 0.0 * largest


@leaf
def raise_scale(run):
    """The scale of every entry follows the largest |y| so far, but for those that are not raised."""
    for i in range(run.y.shape[0]):
        if run.raised[i] == 1:
            run.scale[i] = max(run.scale[i], np.abs(run.y[i]))


@leaf
def is_fresh(run):
    """Whether there is no history: at the start, and after an event."""
    return run.counter[DONE_STEPS] == 0 or run.counter[RESTART] == 1


@leaf
def fastest_turn(machine):
    """Largest angular velocity of a body in the state last evaluated [rad/s]."""
    bodies = record_at(machine).bodies
    largest = 0.0
    for b in range(bodies.mass.shape[0]):
        w = bodies.omega[b]
        largest = max(largest, w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
    return np.sqrt(largest)


@leaf
def exceeds_rotation_limit(machine, h):
    """How much shorter a step h that ends in the state last evaluated has to be for no body to turn too far; 1 where none does."""
    turn = fastest_turn(machine) * h
    return max(LEAST_CHANGE, 0.9 * LARGEST_TURN / turn) if turn > LARGEST_TURN + TURN_GAIN else 1.0


@leaf
def evaluate_accepted(evaluate, machine, history):
    """rate := that of the state reached, which the search for events may have evaluated already. Returns a status."""
    run = run_at(history)
    if run.counter[KNOWN] == 1:
        run.counter[KNOWN] = 0
        copy(run.scratch, run.rate)
        return OK
    return evaluate_at(evaluate, machine, run, run.clock[TIME], run.y, run.rate)


@leaf
def first_step(evaluate, machine, history, order, tolerance):
    """A step that a method of this order is likely to manage: no longer than clock[STEP], and (h D)^(order + 1) ≤ tolerance where D is
    the rate of change that the first two derivatives show, the second by a small step of Euler (after Hairer, Nørsett, Wanner 1993, §II.4).
    """
    run = run_at(history)
    h, first = run.clock[STEP], size(run, run.rate)
    ahead = min(h, run.clock[BOUND] - run.clock[TIME])
    if first > 0.0:
        ahead = min(ahead, 0.01 * np.sqrt(tolerance) / first)
    advance(run.y, ahead, run.rate, run.trial)
    if evaluate_at(evaluate, machine, run, run.clock[TIME] + ahead, run.trial, run.scratch) != OK:
        return min(h, ahead)
    subtract(run.rate, run.scratch)
    second = size(run, run.scratch) / ahead
    fastest = max(first, np.sqrt(second))
    if not fastest < np.inf:
        return min(h, ahead)
    return min(h, tolerance ** (1.0 / (order + 1.0)) / fastest) if fastest > 0.0 else h


@leaf
def bold_first_step(run, order, tolerance):
    """The same from the first derivative alone, for methods that may step over what is stiff: they try, and fall back."""
    first = size(run, run.rate)
    return min(run.clock[STEP], tolerance ** (1.0 / (order + 1.0)) / first) if first > 0.0 else run.clock[STEP]


@leaf
def bound_step(machine, run):
    """clock[STEP] within its bounds at the accepted state, of which the record is."""
    turn = fastest_turn(machine)
    longest = min(run.clock[LARGEST], LARGEST_TURN / turn) if turn > 0.0 else run.clock[LARGEST]
    run.clock[STEP] = min(run.clock[STEP], longest)


@leaf
def enter(evaluate, machine, history, order, tolerance):
    """At the begin of a step: the scales, and a step within its bounds in clock[STEP]. The record is that of the accepted state."""
    run = run_at(history)
    raise_scale(run)
    if is_fresh(run):
        run.clock[STEP] = first_step(evaluate, machine, history, order, tolerance)
    bound_step(machine, run)


@leaf
def enter_boldly(machine, history, order, tolerance):
    """`enter` for methods that may step over what is stiff."""
    run = run_at(history)
    raise_scale(run)
    if is_fresh(run):
        run.clock[STEP] = bold_first_step(run, order, tolerance)
    bound_step(machine, run)


@leaf
def reach(run):
    """clock[REACHED] for a step of about clock[STEP]; returns the step, or 0 where it is lost in the round-off of the time.

    The last step before clock[BOUND] ends there exactly; the last but one leaves it half of what is left, instead of a crumb. Slopes of
    runs are those of the steps that there are: how these would be chosen otherwise is no part of them.
    """
    clock = run.clock
    t, h, left = clock[TIME], real(clock[STEP]), clock[BOUND] - clock[TIME]
    if not h > SMALLEST * ROUND_OFF * max(np.abs(t), clock[END] - clock[START]):
        return 0.0
    if h * STRETCH >= left:
        clock[REACHED] = clock[BOUND]
        return left
    clock[REACHED] = t + (0.5 * left if 2.0 * h > left else h)
    return clock[REACHED] - t


@leaf
def too_small(run, status, error):
    """The status of a run whose steps became too small: what the last attempt failed with. Its step is left in clock[STEP]."""
    run.clock[STEP] = run.clock[REACHED] - run.clock[TIME]
    if status != OK:
        return status
    return NOT_FINITE if np.isnan(error) else STEP_TOO_SMALL


@leaf
def reject(run, h, factor):
    """Count a rejected step; the next attempt is shorter by `factor`."""
    run.counter[REJECTED] += 1
    run.clock[STEP] = h * factor


@leaf
def factor_after_rejection(status, error, order):
    """How much shorter a step has to be whose error is `error` times the allowed one, or that could not be evaluated."""
    if status != OK or not error < np.inf:
        return AFTER_FAILURE
    return max(LEAST_CHANGE, SAFETY * error ** (-1.0 / order))


@leaf
def factor_after_success(error, before, order, rejected):
    """How much longer the next step may be: proportional–integral control (Gustafsson 1991; Hairer, Wanner 1996, §IV.2) with
    α = 0.7/order, β = 0.4/order. `before` is the error of the step before; no growth right after a rejection."""
    error, before = max(error, 1e-10), max(before, 1e-10)
    factor = SAFETY * error ** (-0.7 / order) * before ** (0.4 / order)
    return max(LEAST_CHANGE, min(1.0 if rejected else MOST_CHANGE, factor))
