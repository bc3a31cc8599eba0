"""Newmark's method, HHT-α and generalised-α, on rotations as a Lie group (Brüls, Cardona, Arnold 2012), as index 3 or as stabilised
index 2; constants: `nivel.march.alpha_constants`.

The positions of a step are base ∘ exp(h v₀ + h² (…)), so Euler parameters stay of unit length and no frame is special. Where a function
of time has a known corner a step is done in two parts that meet there, each with accelerations of its own side; the steps between frames
stay what they are.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import entry, leaf, stage
from nivel.kernels.record import record_at
from nivel.kernels.status import OK
from nivel.march.alpha_step import (
    ALPHA_F,
    ALPHA_M,
    BEFORE,
    BETA,
    GAMMA,
    LAST_STEP,
    RATE,
    VDOT,
    XDOT,
    attempt,
    keep_step,
    refresh,
    start,
)
from nivel.march.corners import before, is_near, next_corner, pass_corner
from nivel.march.dense import cubic, wanted
from nivel.march.residual_newton import TOLERANCE as NEWTON_TOLERANCE
from nivel.march.run import (
    ALL_STEPS,
    END,
    EVALUATIONS,
    LENGTH,
    REACHED,
    RESTART,
    START,
    STEP,
    TIME,
    TOLERANCE,
    run_at,
    step_signature,
)
from nivel.march.step_control import (
    EXACT,
    MOST_CHANGE,
    SAFETY,
    enter,
    factor_after_rejection,
    is_fresh,
    reach,
    reject,
    too_small,
    turned_too_far,
)

# Of the tolerance; a step grows only by so much at least; after an iteration that found nothing it is halved.
SHARE, WORTH, AFTER_FAILURE = 0.3, 1.3, 0.5
# A step over a jump of the accelerations errs in proportion to its length, as its part of the tolerance gets smaller. The part is no
# smaller than that of a step of this share of the time of the run: with less than a million such steps that is no more than SHARE.
LEAST_PART = 1e-6
# What the iteration leaves, as a share of what a step may be wrong by: it must not look like an error of the step.
CLOSE = 0.01


@leaf
def end_at_corner(evaluate, machine, history, t):
    """Let what is inside the step end before the corner at time t, where it ends the step, and the state be beyond it. Returns a status."""
    run, clock = run_at(history), run_at(history).clock
    status = OK
    inside = run.event_values.shape[1] > 0 or (run.counter[ALL_STEPS] == 0 and wanted(run))
    if t == clock[REACHED] and inside:
        status = evaluate(machine, before(t), run.y, run.scratch)
        run.counter[EVALUATIONS] += 1
        clock[LENGTH] = t - clock[TIME]
        cubic(run, run.rate, run.scratch)
    return pass_corner(machine, history, t) if status == OK else status


@leaf
def fixed_step(evaluate, machine, history):
    """From clock[TIME] to clock[REACHED], in parts between the corners on the way. Returns a status."""
    run = run_at(history)
    t, target = run.clock[TIME], run.clock[REACHED]
    for i in range(run.y.shape[0]):
        run.stages[RATE, i] = run.rate[i]
    while True:
        corner = next_corner(machine, t, target)
        at_corner = corner < np.inf
        # a corner within the round-off of the end is the end: what would be left is no step
        end = corner if at_corner and not is_near(corner, target) else target
        if is_fresh(run) or run.numbers[LAST_STEP] == 0.0:
            start(evaluate, machine, history, t, end - t)
        elif record_at(machine).newton.level[0] == 2:
            refresh(machine, run)
        h = run.clock[STEP] if not at_corner and t == run.clock[TIME] else end - t
        end_side = before(end) if at_corner else end
        status = attempt(machine, history, h, end_side, record_at(machine).newton.settings[NEWTON_TOLERANCE])
        if status != OK:
            break
        keep_step(machine, run, h)
        t = end
        if at_corner:
            status = end_at_corner(evaluate, machine, history, t)
            run.numbers[LAST_STEP] = 0.0
        if status != OK or t >= target:
            break
        # another part follows
        status = evaluate(machine, t, run.y, run.rate)
        run.counter[EVALUATIONS] += 1
        if status != OK:
            break
    for i in range(run.y.shape[0]):
        run.rate[i] = run.stages[RATE, i]
    return status


@stage
def error_of_step(run, residual, newton, h):
    """Largest error of the step just attempted, as a share of the scales.

    With v̈ and v⃛ from differences of v̇, the step errs by (⅙ - β - ½ Δ) h³ v̈ in q and by -(1/12 + ½ Δ²) h³ v⃛ in v, Δ = α_m - α_f.
    """
    c, stages, scale = run.numbers, run.stages, run.scale
    n, states, last = residual.vdot.shape[0], newton.state.shape[0], c[LAST_STEP]
    positions = np.int64(scale.shape[0]) - n - states - 2
    shift = c[ALPHA_M] - c[ALPHA_F]
    of_position = np.abs(1.0 / 6.0 - c[BETA] - 0.5 * shift)
    of_velocity = 1.0 / 12.0 + 0.5 * shift * shift + np.abs(0.5 - c[GAMMA] - shift)
    largest = 0.0
    for k in range(n + states):
        now = residual.vdot[k] if k < n else newton.rate[k - n]
        start = stages[VDOT, k] if k < n else stages[XDOT, k - n]
        change = now - start
        # h² times the second derivative; without a past all of the change counts
        bend = 2.0 * (change - h / last * (start - stages[BEFORE, k])) / (1.0 + last / h) if last > 0.0 else change
        share = of_velocity * np.abs(h * bend) / scale[positions + k]
        if k < n:
            place = newton.place[k, 0]
            share = max(share, of_position * np.abs(h * h * change) / scale[place])
        if not share <= largest:
            largest = share
    return largest


@leaf
def controlled_step(evaluate, machine, history):
    """One accepted step whose error is its part, of the time of the run, of SHARE of the tolerance. Returns a status.

    The step stays as it is until it may grow by WORTH: the matrix serves as long as it does.
    """
    run, record = run_at(history), record_at(machine)
    newton, residual, clock = record.newton, record.residual, run.clock
    span = clock[END] - clock[START]
    fresh = is_fresh(run)
    enter(evaluate, machine, history, 2.0, SHARE * clock[TOLERANCE])
    status, error = OK, 0.0
    while True:
        h = reach(run)
        if h == 0.0:
            return too_small(run, status, error)
        t = clock[TIME]
        corner = next_corner(machine, t, clock[REACHED])
        if corner < np.inf:
            # a corner may lie beyond what it is taken for by round-off
            clock[REACHED] = min(corner, clock[REACHED])
            h = clock[REACHED] - t
        if fresh:
            start(evaluate, machine, history, t, h)
        elif newton.level[0] == 2:
            refresh(machine, run)
        allowed = max(SHARE * clock[TOLERANCE] * max(h / span, LEAST_PART), EXACT)
        end = before(clock[REACHED]) if corner < np.inf else clock[REACHED]
        status = attempt(machine, history, h, end, min(newton.settings[NEWTON_TOLERANCE], max(CLOSE * allowed, EXACT)))
        if status == OK:
            error = error_of_step(run, residual, newton, h) / allowed
            shorter = turned_too_far(machine, h)
            if error <= 1.0 and shorter == 1.0:
                break
            reject(run, h, factor_after_rejection(OK, error, 2.0) if error > 1.0 else shorter)
        else:
            reject(run, h, AFTER_FAILURE)
        newton.kept[0] = 0.0
    keep_step(machine, run, h)
    growth = SAFETY * max(error, 1e-4) ** -0.5
    if corner < np.inf:
        status = end_at_corner(evaluate, machine, history, clock[REACHED])
        run.counter[RESTART] = 1
    elif growth >= WORTH:
        clock[STEP] = h * min(growth, MOST_CHANGE)
    return status


@entry(step_signature)
def alpha(evaluate, machine, history):
    """One step."""
    run = run_at(history)
    if run.counter[ALL_STEPS] > 0:
        return fixed_step(evaluate, machine, history)
    return controlled_step(evaluate, machine, history)
