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
from nivel.march.corners import before, next_corner, pass_corner
from nivel.march.dense import cubic, wanted
from nivel.march.residual_newton import TOLERANCE as NEWTON_TOLERANCE
from nivel.march.residual_newton import iterate
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

# entries of run.numbers: the constants; the step before, 0 after a start
ALPHA_M, ALPHA_F, BETA, GAMMA, DELTA_M, DELTA_F, THETA = 0, 1, 2, 3, 4, 5, 6
LAST_STEP = 7
# rows of run.stages: a and v̇ of the accepted state, w and ẋ; v̇ and ẋ of the state before; work; rate at the begin of the step
A, VDOT, W, XDOT, BEFORE, AHEAD, RATE = 0, 1, 2, 3, 4, 5, 6
# a difference over this share of a step gives v̈ of the start to half the digits
DIFFERENCE = 1e-4
# Of the tolerance; a step grows only by so much at least; after an iteration that found nothing it is halved.
SHARE, WORTH, AFTER_FAILURE = 0.3, 1.3, 0.5
# What the iteration leaves, as a share of what a step may be wrong by: it must not look like an error of the step.
CLOSE = 0.01


@leaf
def start(evaluate, machine, history, t, h):
    """Accelerations, rates and multipliers of the state run.y at time t, whose rate is run.rate.

    a approximates v̇ at t + (α_m - α_f) h (Arnold, Brüls, Cardona 2015): a start with v̇ itself would cost the multipliers of the first
    steps an order.
    """
    run, record = run_at(history), record_at(machine)
    newton, residual, c, stages = record.newton, record.residual, run.numbers, run.stages
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(run.y.shape[0]) - n - states - 2
    for k in range(residual.row.shape[0]):
        newton.lam[k] = record.constraints.lam[residual.row[k]]
    ahead = DIFFERENCE * h
    for i in range(run.y.shape[0]):
        run.trial[i] = run.y[i] + ahead * run.rate[i]
    status = evaluate(machine, t + ahead, run.trial, stages[AHEAD])
    run.counter[EVALUATIONS] += 1
    for k in range(n + states):
        rate = run.rate[positions + k]
        slope = (stages[AHEAD, positions + k] - rate) * h / ahead if status == OK else 0.0
        if k < n:
            stages[VDOT, k], stages[A, k] = rate, rate + (c[ALPHA_M] - c[ALPHA_F]) * slope
        else:
            stages[XDOT, k - n], stages[W, k - n] = rate, rate + (c[DELTA_M] - c[DELTA_F]) * slope
    newton.kept[0], c[LAST_STEP] = 0.0, 0.0
    run.counter[RESTART] = 0


@stage
def refresh(machine, run):
    """As stabilised index 2, take accelerations, rates and multipliers of the accepted state from its evaluation by the loop.

    In a step only the mean of the accelerations at both ends counts for an undamped method: what it got wrong once along the constraints
    would alternate for ever. a becomes what `keep_step` would have made of these accelerations.
    """
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(run.y.shape[0]) - n - states - 2
    c, stages, rate = run.numbers, run.stages, run.rate
    share, share_x = (1.0 - c[ALPHA_F]) / (1.0 - c[ALPHA_M]), (1.0 - c[DELTA_F]) / (1.0 - c[DELTA_M])
    for k in range(n):
        stages[A, k] += share * (rate[positions + k] - stages[VDOT, k])
        stages[VDOT, k] = rate[positions + k]
    for k in range(states):
        stages[W, k] += share_x * (rate[positions + n + k] - stages[XDOT, k])
        stages[XDOT, k] = rate[positions + n + k]
    for k in range(residual.row.shape[0]):
        newton.lam[k] = record.constraints.lam[residual.row[k]]


@stage
def predict(run, newton, residual, h):
    """The unknowns at the end of the step as if they went on to change as in the step before."""
    stages, n, last = run.stages, residual.vdot.shape[0], run.numbers[LAST_STEP]
    ratio = h / last if last > 0.0 else 0.0
    for k in range(n):
        residual.vdot[k] = stages[VDOT, k] + ratio * (stages[VDOT, k] - stages[BEFORE, k])
    for k in range(newton.state.shape[0]):
        newton.rate[k] = stages[XDOT, k] + ratio * (stages[XDOT, k] - stages[BEFORE, n + k])
    for k in range(residual.lam.shape[0]):
        residual.lam[k] = newton.lam[k] + ratio * (newton.lam[k] - newton.lam_before[k])


@stage
def prepare(run, newton, n, h):
    """The state as a function of the unknowns. Returns cq, cv, cx.

    a and w stand a share of their step away from the accepted state: for another step they are moved to the same share of that.
    """
    c, stages, y = run.numbers, run.stages, run.y
    states = newton.state.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    ratio = h / c[LAST_STEP] if c[LAST_STEP] > 0.0 else 1.0
    share = (1.0 - c[ALPHA_F]) / (1.0 - c[ALPHA_M])
    share_x = (1.0 - c[DELTA_F]) / (1.0 - c[DELTA_M])
    for i in range(y.shape[0]):
        newton.base[i] = y[i]
    for k in range(n):
        v, vdot = y[positions + k], stages[VDOT, k]
        a = vdot + ratio * (stages[A, k] - vdot)
        # a₁ = share v̇₁ + known
        known = (c[ALPHA_F] * vdot - c[ALPHA_M] * a) / (1.0 - c[ALPHA_M])
        newton.speed[k] = v + h * ((1.0 - c[GAMMA]) * a + c[GAMMA] * known)
        newton.turn[k] = h * v + h * h * ((0.5 - c[BETA]) * a + c[BETA] * known)
        newton.correction[k] = 0.0
    for k in range(states):
        xdot = stages[XDOT, k]
        w = xdot + ratio * (stages[W, k] - xdot)
        known = (c[DELTA_F] * xdot - c[DELTA_M] * w) / (1.0 - c[DELTA_M])
        newton.state[k] = y[positions + n + k] + h * ((1.0 - c[THETA]) * w + c[THETA] * known)
    return h * h * c[BETA] * share, h * c[GAMMA] * share, h * c[THETA] * share_x


@leaf
def attempt(machine, history, h, end, tolerance):
    """The state after a step h, which ends at time `end`, in `residual.y`. tolerance : see `iterate`. Returns a status."""
    run, record = run_at(history), record_at(machine)
    predict(run, record.newton, record.residual, h)
    cq, cv, cx = prepare(run, record.newton, record.residual.vdot.shape[0], h)
    return iterate(machine, history, end, cq, cv, cx, tolerance)


@stage
def keep_step(machine, run, h):
    """The state reached, and what the next step needs to know of it."""
    record = record_at(machine)
    newton, residual, c, stages = record.newton, record.residual, run.numbers, run.stages
    n, states, last = residual.vdot.shape[0], newton.state.shape[0], run.y.shape[0] - 2
    ratio = h / c[LAST_STEP] if c[LAST_STEP] > 0.0 else 1.0
    for k in range(n):
        new, old = residual.vdot[k], stages[VDOT, k]
        a = old + ratio * (stages[A, k] - old)
        stages[A, k] = ((1.0 - c[ALPHA_F]) * new + c[ALPHA_F] * old - c[ALPHA_M] * a) / (1.0 - c[ALPHA_M])
        stages[BEFORE, k], stages[VDOT, k] = old, new
    for k in range(states):
        new, old = newton.rate[k], stages[XDOT, k]
        w = old + ratio * (stages[W, k] - old)
        stages[W, k] = ((1.0 - c[DELTA_F]) * new + c[DELTA_F] * old - c[DELTA_M] * w) / (1.0 - c[DELTA_M])
        stages[BEFORE, n + k], stages[XDOT, k] = old, new
    for k in range(residual.lam.shape[0]):
        newton.lam_before[k], newton.lam[k] = newton.lam[k], residual.lam[k]
    for i in range(last):
        run.y[i] = residual.y[i]
    # energies: the trapezoidal rule
    for i in range(2):
        run.y[last + i] += 0.5 * h * (run.rate[last + i] + record.control.power[i])
    c[LAST_STEP] = h


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
        end = min(corner, target)
        if is_fresh(run) or run.numbers[LAST_STEP] == 0.0:
            start(evaluate, machine, history, t, end - t)
        elif record_at(machine).newton.level[0] == 2:
            refresh(machine, run)
        h = run.clock[STEP] if corner > target and t == run.clock[TIME] else end - t
        end_side = before(end) if corner <= target else end
        status = attempt(machine, history, h, end_side, record_at(machine).newton.settings[NEWTON_TOLERANCE])
        if status != OK:
            break
        keep_step(machine, run, h)
        t = end
        if corner <= target:
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
        allowed = max(SHARE * clock[TOLERANCE] * h / span, EXACT)
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
