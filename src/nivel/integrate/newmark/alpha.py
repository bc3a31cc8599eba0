"""Newmark's method, HHT-α and generalised-α, on rotations as a Lie group (Brüls, Cardona, Arnold 2012), as index 3, as stabilised
index 2, as index 1 or in independent coordinates; constants: `nivel.integrate.newmark.alpha_constants`.

The positions of a step are base ∘ exp(h v₀ + h² (…)), so Euler parameters stay of unit length and no frame is special. Rotation coordinates
of the Lagrange equations, and joint coordinates, move as vectors. Where a function of time has a known corner a step is done in two parts
that meet there, each with accelerations of its own side; the steps between frames stay what they are.
"""

import numpy as np

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop import step_control
from nivel.integrate.loop.corners import before, is_near, next_corner, pass_corner
from nivel.integrate.loop.dense import cubic, wanted
from nivel.integrate.loop.run import (
    ALL_STEPS,
    LENGTH,
    REACHED,
    RESTART,
    STEP,
    STEP_SIGNATURE,
    TIME,
    TOLERANCE,
    evaluate_at,
    run_at,
)
from nivel.integrate.newmark import alpha_step
from nivel.integrate.newmark.alpha_start import go_on_beyond, start
from nivel.integrate.newmark.correction_slopes import NUMBERS, ROWS
from nivel.integrate.newmark.residual_newton import TOLERANCE as NEWTON_TOLERANCE
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import record_at
from nivel.native.entry import entry
from nivel.native.function import leaf

# A step grows only by so much at least; after an iteration that found nothing it is halved.
WORTH, AFTER_FAILURE = 1.3, 0.5
# Below the first share of the allowed error a step may grow as it is; a filtered error helps below the second share of the plain one.
FREE, HELPS, MOST_PATIENCE = (step_control.SAFETY / WORTH) ** 2, 0.5, 1024.0
# A step held for so long is tried with LEAP, its square and its cube times its length, each time after twice as long.
LEAST_HELD, LEAP, MOST_LEAPS = 16.0, 10.0, 30.0
# entries of run.numbers: steps since errors were filtered, after how many they are again; steps of the same length, leaps tried
UNFILTERED, PATIENCE, HELD, LEAPS = 9, 10, 11, 12
# [s] no step, but the begin of one: see `nivel.analysis.curves.corners`
AT_ONCE = 2e-12
# What the iteration leaves, as a share of what a step may be wrong by: it must not look like an error of the step.
CLOSE = 0.01


@leaf
def end_at_corner(evaluate, machine, history, t, fresh):
    """Let what is inside the step end before the corner at time t, where it ends the step, and the state be beyond it. Where speeds jump
    there, or the step was the first one (`fresh`), run.counter[RESTART] says that the method begins anew. Returns a status."""
    run, clock = run_at(history), run_at(history).clock
    status = OK
    inside = run.event_values.shape[1] > 0 or (run.counter[ALL_STEPS] == 0 and wanted(run))
    if t == clock[REACHED] and inside:
        status = evaluate_at(evaluate, machine, run, before(t), run.y, run.scratch)
        clock[LENGTH] = t - clock[TIME]
        cubic(run, clock[LENGTH], run.rate, run.scratch)
    if status == OK:
        status, jumps = pass_corner(machine, history, t)
        if jumps or fresh:
            run.counter[RESTART] = 1
        elif status == OK:
            status = go_on_beyond(evaluate, machine, history, t)
    return status


@leaf
def fixed_step(evaluate, machine, history):
    """From clock[TIME] to clock[REACHED], in parts between the corners on the way. Returns a status."""
    run = run_at(history)
    t, target = run.clock[TIME], run.clock[REACHED]
    copy(run.rate, run.stages[alpha_step.RATE])
    while True:
        corner = next_corner(machine, t, target)
        at_corner = corner < np.inf
        # a corner within the round-off of the end is the end: what would be left is no step
        end = corner if at_corner and not is_near(corner, target) else target
        fresh = step_control.is_fresh(run)
        if fresh:
            start(evaluate, machine, history, t, end - t)
        elif record_at(machine).newton.level[0] > 0:
            alpha_step.refresh(machine, run)
        h = run.clock[STEP] if not at_corner and t == run.clock[TIME] else end - t
        end_side = before(end) if at_corner else end
        status = alpha_step.attempt(machine, history, h, end_side, record_at(machine).newton.settings[NEWTON_TOLERANCE])
        if status != OK:
            break
        alpha_step.keep_step(machine, run, h, at_corner or t > run.clock[TIME])
        t = end
        if at_corner:
            status = end_at_corner(evaluate, machine, history, t, fresh)
        if status != OK or t >= target:
            break
        # another part follows
        status = evaluate_at(evaluate, machine, run, t, run.y, run.rate)
        if status != OK:
            break
    copy(run.stages[alpha_step.RATE], run.rate)
    return status


@leaf
def choose_error(machine, history, end, h):
    """The error of the step just attempted, to time `end`, as a share of the allowed one: filtered where that is worth its matrix."""
    run = run_at(history)
    c, plain = run.numbers, alpha_step.plain_error(machine, history, h)
    c[UNFILTERED] += 1.0
    if plain <= FREE or (plain <= 1.0 and c[UNFILTERED] < c[PATIENCE]):
        return plain
    slow, vibrating = alpha_step.filtered_error(machine, history, end, h)
    error = min(plain, max(slow, vibrating))
    c[UNFILTERED] = 0.0
    c[PATIENCE] = 1.0 if error < HELPS * plain else min(2.0 * c[PATIENCE], MOST_PATIENCE)
    return error


@leaf
def controlled_step(evaluate, machine, history):
    """One accepted step of which the error is allowed, see `nivel.integrate.newmark.alpha_step`. Returns a status.

    The step stays as it is until it may grow by WORTH: the matrix serves as long as it does.
    """
    run, record = run_at(history), record_at(machine)
    newton, c, clock = record.newton, run.numbers, run.clock
    fresh = step_control.is_fresh(run)
    step_control.enter_boldly(machine, history, 2.0, alpha_step.SHARE * clock[TOLERANCE])
    if fresh:
        c[UNFILTERED], c[PATIENCE], c[HELD], c[LEAPS] = 0.0, 1.0, 0.0, 0.0
    # a step that has been held for long is tried with a multiple of it
    leap = c[HELD] >= LEAST_HELD * 2.0 ** (c[LEAPS])
    usual = clock[STEP]
    if leap:
        clock[STEP] *= LEAP ** (1.0 + c[LEAPS] % 3.0)
        step_control.bound_step(machine, run)
        c[HELD] = 0.0
        c[LEAPS] = min(c[LEAPS] + 1.0, MOST_LEAPS)
    if not fresh and newton.level[0] > 0:
        # once: after an attempt that failed the record has its multipliers, which may be no numbers
        alpha_step.refresh(machine, run)
    status, error = OK, 0.0
    while True:
        h = step_control.reach(run)
        if h == 0.0:
            return step_control.too_small(run, status, error)
        t = clock[TIME]
        corner = next_corner(machine, t, clock[REACHED])
        if corner < np.inf:
            # a corner may lie beyond what it is taken for by round-off
            clock[REACHED] = min(corner, clock[REACHED])
            h = clock[REACHED] - t
        if fresh:
            start(evaluate, machine, history, t, h)
        end = before(clock[REACHED]) if corner < np.inf else clock[REACHED]
        close = max(CLOSE * alpha_step.part_of(run, h), step_control.EXACT)
        status = alpha_step.attempt(machine, history, h, end, min(newton.settings[NEWTON_TOLERANCE], close))
        factor = AFTER_FAILURE
        if status == OK:
            # what is done up to a corner right behind the start is no error: a load that jumps there acts from the start on
            error = 0.0 if fresh and corner < np.inf and h <= AT_ONCE else choose_error(machine, history, end, h)
            factor = step_control.exceeds_rotation_limit(machine, h)
            if error <= 1.0 and factor == 1.0:
                break
            if error > 1.0:
                factor = step_control.factor_after_rejection(OK, error, 2.0)
        step_control.reject(run, h, factor)
        if fresh:
            # `start` takes the multipliers of the accepted state from the record
            evaluate_at(evaluate, machine, run, t, run.y, run.scratch)
        if leap:
            clock[STEP], leap = usual, False
        newton.kept[0] = 0.0
    if leap and h > usual:
        c[LEAPS] = 0.0
    alpha_step.keep_step(machine, run, h, corner < np.inf)
    growth = step_control.SAFETY * max(error, 1e-4) ** -0.5
    c[HELD] += 1.0
    if corner < np.inf:
        status = end_at_corner(evaluate, machine, history, clock[REACHED], fresh)
    elif growth >= WORTH:
        clock[STEP] = h * min(growth, step_control.MOST_CHANGE)
        c[HELD] = 0.0
    return status


@entry(STEP_SIGNATURE)
def alpha(evaluate, machine, history):
    """One step."""
    run = run_at(history)
    if run.counter[ALL_STEPS] > 0:
        return fixed_step(evaluate, machine, history)
    return controlled_step(evaluate, machine, history)


FACTS = tuple(
    IntegratorFacts(
        name, alpha, order=2, stages=ROWS, numbers=NUMBERS, kind="corrector", needs="accelerations", ends="jumps"
    )
    for name in ("newmark", "hht", "generalised-alpha")
)
