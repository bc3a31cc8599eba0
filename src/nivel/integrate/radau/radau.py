"""Radau IIA with three stages, of order 5, for stiff machines (Hairer, Wanner 1996, "Solving Ordinary Differential Equations II", §IV.8).

The error is estimated by the slope at the begin of the step, which the collocation polynomial does not know: γ₀ h (f(t, y) - u̇(t)), of
order h⁴, smoothed by (1 - γ₀ h ∂f/∂y)⁻¹ for stiff entries. The estimate is that of order 3, the result that of order 5. The tolerance
of a step falls with the power 4/5 of that of the run, then the error of the result falls with the tolerance itself.

The same vector bends the polynomial to order 4 inside the step, which frames, events and the prediction of the next step make use of.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.corners import before, next_corner, pass_corner
from nivel.integrate.loop.dense import wanted
from nivel.integrate.loop.run import (
    BOUND,
    DENSE,
    EVALUATIONS,
    POWERS,
    REACHED,
    RESTART,
    STEP,
    STEP_SIGNATURE,
    TIME,
    TOLERANCE,
    run_at,
)
from nivel.integrate.loop.step_control import (
    AFTER_FAILURE,
    EXACT,
    SAFETY,
    enter_boldly,
    exceeds_rotation_limit,
    factor_after_rejection,
    is_fresh,
    reach,
    reject,
    size,
    too_small,
)
from nivel.integrate.radau.radau_constants import BEND, GAMMA
from nivel.integrate.radau.radau_stages import (
    AGE,
    CONTRACTION,
    COUPLED,
    ERROR,
    FOUND,
    LAST,
    LAST_ERROR,
    LAST_STEP,
    LEFT_OVER,
    LONGEST,
    MADE,
    PATIENCE,
    RATES,
    REPEATED,
    Z,
    iterate,
    iterate_coupled,
    make_factors,
    predict,
    write_polynomial,
)
from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.kernels.record.hook import call_evaluate
from nivel.kernels.record.record import record_at
from nivel.kernels.residual.shifted_matrix import keep_multipliers, solve_shifted_parts
from nivel.native.entry import entry
from nivel.native.function import leaf

# of the error of one step with its estimate
ORDER = 4.0
# A step may err, by its estimate, by SHARE tolerance^(4/5); its stages are found to CLOSE of the tolerance.
SHARE, CLOSE = 0.06, 1e-3
# what counts of an error that settles within a step
SETTLING = 0.2
# Derivatives are found anew where a change is more than this share of the one before.
GOOD = 0.02
LEAST_CHANGE, MOST_CHANGE = 0.2, 8.0
# A step whose iteration fails is halved; the steps after it grow to its length by this factor each.
HALF, REGAIN = 0.5, 1.1
# After a step whose iteration contracts only with derivatives at its stages so many steps have these, twice as many each time.
FEWEST, MOST_PATIENCE = 4.0, 64.0
# A step is kept, and its factors, where it might be longer by less than this.
WORTH = 1.2


@leaf
def forget(run):
    """No polynomial, no derivatives."""
    numbers = run.numbers
    numbers[MADE], numbers[FOUND], numbers[AGE], numbers[LEFT_OVER] = 0.0, 0.0, 0.0, 1.0
    numbers[LAST_STEP], numbers[LAST_ERROR], numbers[LONGEST] = 0.0, 1.0, np.inf
    numbers[COUPLED], numbers[PATIENCE] = 0.0, 0.0
    run.counter[RESTART] = 0


@leaf
def smooth(machine, history, h, slope):
    """ERROR := (1 - γ₀ h ∂f/∂y)⁻¹ γ₀ (h slope - d_1)."""
    run, factors = run_at(history), record_at(machine).newton.shifted.real
    for i in range(run.y.shape[0]):
        factors.r[i] = (h * slope[i] - run.stages[RATES, i]) / GAMMA
    solve_shifted_parts(machine, factors, real(h) / GAMMA)
    for i in range(run.y.shape[0]):
        run.stages[ERROR, i] = factors.r[i]


@leaf
def estimate(evaluate, machine, history, h, tolerance):
    """Fill ERROR and the rows of the polynomial; returns the error as a share of the allowed one. Where it is too large, stiff entries
    and energies may be to blame that are far from what they settle to within the step: they are looked at once more after they have.

    What settles is a speed of stiff springs that the step before left wrong, by its length to the power 3 (index 3); while it does, it
    pushes what is slow as far as the springs turn. So SETTLING of it counts, though not where the step was rejected: a shorter one
    begins as wrong.
    """
    run = run_at(history)
    write_polynomial(run)
    smooth(machine, history, h, run.rate)
    error = size(run, run.stages[ERROR]) / tolerance
    if not error <= 1.0 and error < np.inf:
        settling = 0.0 if run.numbers[REPEATED] == 1.0 or run.numbers[LAST_STEP] == 0.0 else SETTLING * error
        for i in range(run.y.shape[0]):
            run.trial[i] = run.y[i] + run.stages[ERROR, i]
        run.counter[EVALUATIONS] += 1
        if call_evaluate(evaluate, machine, run.clock[TIME], run.trial, run.scratch) == OK:
            smooth(machine, history, h, run.scratch)
            settled = size(run, run.stages[ERROR]) / tolerance
            error = settling if settled < settling else settled
    return error


@leaf
def accept(run, h):
    """The new state, and the polynomial of the step for what comes after it."""
    stages = run.stages
    for i in range(run.y.shape[0]):
        bend = GAMMA * stages[ERROR, i]
        for k in range(3):
            stages[LAST + k, i] = stages[RATES + k, i] + BEND[k] * bend
        stages[LAST + 3, i] = BEND[3] * bend
        run.y[i] += stages[Z + 2, i]
    run.numbers[LAST_STEP] = h
    if wanted(run):
        for k in range(4):
            for i in range(run.y.shape[0]):
                run.dense[k, i] = stages[LAST + k, i]
        run.counter[DENSE], run.counter[POWERS] = 4, 1


@leaf
def next_step(run, h, error, last):
    """The step after a step h of this error, before it one of length `last`: it follows the trend of the error (Gustafsson 1994)."""
    numbers, error = run.numbers, max(error, 1e-10)
    factor = SAFETY * error ** (-1.0 / ORDER)
    if last > 0.0:
        factor = min(factor, SAFETY * h / last * (numbers[LAST_ERROR] / (error * error)) ** (1.0 / ORDER))
    factor = max(LEAST_CHANGE, min(1.0 if numbers[REPEATED] == 1.0 else MOST_CHANGE, factor))
    numbers[LAST_ERROR] = max(error, 1e-2)
    if numbers[CONTRACTION] > GOOD or numbers[COUPLED] > 0.0:
        numbers[FOUND] = 0.0
    elif 1.0 <= factor < WORTH:
        factor = 1.0
    return h * factor


@leaf
def attempt(evaluate, machine, history, h, end, tolerance):
    """A status, the error of a step h to the time `end` as a share of the allowed one, and how much shorter the step has to be for no body
    to turn too far. Its stages are in Z."""
    run = run_at(history)
    close = max(CLOSE * run.clock[TOLERANCE], EXACT)
    status = make_factors(machine, history, h)
    if status != OK:
        return status, 0.0, 1.0
    predict(run, h)
    if run.numbers[COUPLED] == 0.0:
        status = iterate(evaluate, machine, history, h, end, close)
    else:
        status = iterate_coupled(evaluate, machine, history, h, end, close)
    if status != OK:
        return status, 0.0, 1.0
    shorter = exceeds_rotation_limit(machine, h)
    return OK, estimate(evaluate, machine, history, h, tolerance), shorter


@entry(STEP_SIGNATURE)
def radau(evaluate, machine, history):
    """One accepted step."""
    run = run_at(history)
    numbers, tolerance = run.numbers, max(SHARE * run.clock[TOLERANCE] ** 0.8, EXACT)
    keep_multipliers(machine)
    enter_boldly(machine, history, ORDER - 1.0, tolerance)
    if is_fresh(run):
        forget(run)
    numbers[REPEATED] = 0.0
    run.clock[STEP] = min(run.clock[STEP], numbers[LONGEST])
    status, error = OK, 0.0
    while True:
        h = reach(run)
        if h == 0.0:
            return too_small(run, status, error)
        corner, end, wish = next_corner(machine, run.clock[TIME], run.clock[REACHED]), run.clock[REACHED], h
        if corner < np.inf:
            # just beyond it, where functions are what follows, even those that are no number at the corner
            end = before(corner)
            run.clock[REACHED] = min(corner + (corner - end), run.clock[BOUND])
            h = run.clock[REACHED] - run.clock[TIME]
        status, error, shorter = attempt(evaluate, machine, history, h, end, tolerance)
        if status != OK:
            if numbers[AGE] > 0.0 and numbers[FOUND] == 1.0:
                # the same step with the derivatives of this state
                numbers[FOUND] = 0.0
                continue
            if status == NOT_CONVERGED and numbers[COUPLED] == 0.0:
                # and with those at its stages, as the steps after it
                numbers[PATIENCE] = min(max(FEWEST, 2.0 * numbers[PATIENCE]), MOST_PATIENCE)
                numbers[COUPLED] = numbers[PATIENCE]
                continue
            numbers[FOUND] = 0.0
            reject(run, h, HALF if status == NOT_CONVERGED else AFTER_FAILURE)
            numbers[LONGEST] = run.clock[STEP]
        elif error <= 1.0 and shorter == 1.0:
            break
        else:
            reject(run, h, min(shorter, factor_after_rejection(OK, error, ORDER) if not error <= 1.0 else 1.0))
        numbers[REPEATED] = 1.0
    last = numbers[LAST_STEP]
    accept(run, h)
    numbers[AGE] += 1.0
    numbers[LONGEST] *= REGAIN
    run.clock[STEP] = next_step(run, h, error, last)
    if numbers[COUPLED] > 0.0:
        numbers[COUPLED] -= 1.0
    else:
        numbers[PATIENCE] = max(0.0, numbers[PATIENCE] - 1.0)
    if corner < np.inf:
        # what was before it says nothing about what comes
        run.clock[STEP], run.counter[RESTART] = max(run.clock[STEP], wish), 1
        return pass_corner(machine, history, run.clock[REACHED])[0]
    return OK


FACTS = (
    IntegratorFacts(
        "radau", radau, order=5, stages=14, numbers=11, kind="implicit", needs="complex shifts", ends="corners"
    ),
)
