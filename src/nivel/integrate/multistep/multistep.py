"""Multistep methods with a fixed step: those of Adams, which are Bashforth's, the pairs that predict, evaluate and correct once (report 44,
Fig. 15), and Moulton's; and Gear's."""

import numpy as np

from nivel.integrate.explicit.runge_kutta import explicit
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import (
    CORRECTOR_TOLERANCE,
    ITERATIONS,
    MOST_ITERATIONS,
    NEWTON,
    ORDER,
    REACHED,
    RESTART,
    STEP,
    STEP_SIGNATURE,
    TIME,
    add_rows,
    evaluate_at,
    run_at,
    sum_rows,
)
from nivel.integrate.loop.step_control import larger
from nivel.kernels.algebra.lu import factorise_lu, solve_lu
from nivel.kernels.algebra.rows import advance, copy
from nivel.kernels.core.lanes import is_whole, steepest
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.native.entry import entry
from nivel.native.function import leaf

# Shared parts of multistep methods: rates and states of the last steps, and the one-step method that provides the first of them.
#
# The history is of equally long steps. The shorter last step of a run, and an event, break it: Kutta's method of order 4 takes over until
# there is enough history again. Its local error falls with h⁵, as the global one of a method of order 5, and the steps without history
# are few; for order 5 two half steps make their error a sixteenth, so that it is not the one that counts.

# Rows of run.stages and entries of run.numbers of the multistep methods.

# Rows of run.stages, all (ny,): the known part of an implicit equation, the rate of its iterate, its prediction; five stages of a
# one-step method; rates and states accepted, newest first.
KNOWN, RATE, PREDICTED, WORK, RATES, STATES = 0, 1, 2, 3, 8, 13
ROWS = 17
# Entries of run.numbers: share of the rate in the equations that run.matrix is for [s] (0: none), accepted states in the history, the
# step between them [s].
SHARE, PAST, SPACING = 0, 1, 2
NUMBERS = 3


# Steps that differ by less are equal: their times carry round-off of up to 1e-16 of the time since the start.
SAME = 1e-6


@leaf
def shift(rows, count, y):
    """Move the first `count` - 1 of these rows by one and put y in front."""
    for k in range(count - 1):
        newer, older = rows[count - 2 - k], rows[count - 1 - k]
        copy(newer, older)
    copy(y, rows[0])


@leaf
def remember(history, rates, states):
    """Put the accepted state into the history of so many rates and states. Returns how many accepted states are there."""
    run = run_at(history)
    h, numbers = run.clock[STEP], run.numbers
    if run.counter[RESTART] == 1 or np.abs(h - numbers[SPACING]) > SAME * h:
        run.counter[RESTART] = 0
        numbers[:] = 0.0
        numbers[SPACING] = h
    shift(run.stages[RATES:STATES], rates, run.rate)
    shift(run.stages[STATES:], states, run.y)
    numbers[PAST] += 1.0
    return numbers[PAST]


@leaf
def begin(evaluate, machine, history, order):
    """A step without history, for a method of `order`. Returns a status."""
    run = run_at(history)
    t, h = run.clock[TIME], run.clock[STEP]
    copy(run.rate, run.stages[WORK])
    if order <= 4:
        return explicit(evaluate, machine, history, 4, t, h, WORK)
    status = explicit(evaluate, machine, history, 4, t, 0.5 * h, WORK)
    if status != OK:
        return status
    status = evaluate_at(evaluate, machine, run, t + 0.5 * h, run.y, run.stages[WORK])
    if status != OK:
        return status
    return explicit(evaluate, machine, history, 4, t + 0.5 * h, 0.5 * h, WORK)


# Newton's iteration for y = known + share f(t, y), with a matrix that serves for many steps.
#
# (1 - share ∂f/∂y) Δy = known + share f(t, y) - y, where ∂f/∂y is found by differences: as many evaluations as y has entries. The
# matrix is kept as long as the share is the same (the same method and step) and every change is below a share `SLOW` of the one before.
# Where it is not, the matrix is found anew: at the prediction if it was an old one, and then the iteration starts again from there;
# at the iterate if it was found in this step.

SLOW = 0.25
# Differences of this share of a scale: half the digits are left for the change of the rate.
DIFFERENCE = 1.5e-8


@leaf
def renew(evaluate, machine, history, t, share, y, rate):
    """matrix := factors of 1 - share ∂f/∂y at y, where rate = f(t, y); `scratch` is work. Returns a status."""
    run = run_at(history)
    matrix = run.matrix
    n = y.shape[0]
    matrix[:, :] = 0.0
    # nothing depends on the two energies at the end of y
    for j in range(n - 2):
        value = y[j]
        y[j] += DIFFERENCE * max(run.scale[j], np.abs(value))
        width = y[j] - value
        status = evaluate_at(evaluate, machine, run, t, y, run.scratch)
        y[j] = value
        if status != OK:
            return status
        for i in range(n):
            matrix[i, j] = share * (rate[i] - run.scratch[i]) / width
    for i in range(n):
        matrix[i, i] += 1.0
    return OK if factorise_lu(matrix, run.pivot) else NOT_CONVERGED


@leaf
def newton(evaluate, machine, history, t, share):
    """y := the solution of y = stages[KNOWN] + share f(t, y) next to y. Returns a status."""
    run = run_at(history)
    y, known, rate, predicted = run.y, run.stages[KNOWN], run.stages[RATE], run.stages[PREDICTED]
    n = y.shape[0]
    copy(y, predicted)
    stale, own, last = run.numbers[SHARE] != share, False, np.inf
    for _ in range(run.counter[MOST_ITERATIONS]):
        status = evaluate_at(evaluate, machine, run, t, y, rate)
        run.counter[ITERATIONS] += 1
        if status == OK and stale:
            status = renew(evaluate, machine, history, t, share, y, rate)
            run.numbers[SHARE] = share
            stale, own, last = False, True, np.inf
        if status != OK:
            run.numbers[SHARE] = 0.0
            return status
        for i in range(n):
            rate[i] = known[i] + share * rate[i] - y[i]
        solve_lu(run.matrix, run.pivot, rate)
        change = 0.0
        for i in range(n):
            y[i] += rate[i]
            change = larger(change, rate[i], max(run.scale[i], np.abs(y[i])))
            if is_whole(machine):
                change = larger(change, steepest(rate[i]), max(run.scale[i], np.abs(y[i])))
        if change <= run.clock[CORRECTOR_TOLERANCE]:
            return OK
        if not change <= SLOW * last:
            stale = True
            if not own:
                copy(predicted, y)
        last = change
    run.numbers[SHARE] = 0.0
    return NOT_CONVERGED


# The start of implicit multistep methods: with functional iteration as that of explicit ones; with Newton's the step may be far beyond
# what an explicit method stands, and the start is a diagonally implicit Runge–Kutta method of order 4, L-stable.
#
# Coefficients: Hairer, Wanner 1996, table IV.6.5. All stages share γ = 1/4, hence one matrix; the last one is the new state.

STAGES = 5
GAMMA = 0.25
NODES = np.array([1 / 4, 3 / 4, 11 / 20, 1 / 2, 1.0])
MATRIX = np.array(
    [
        [0.0, 0.0, 0.0, 0.0],
        [1 / 2, 0.0, 0.0, 0.0],
        [17 / 50, -1 / 25, 0.0, 0.0],
        [371 / 1360, -137 / 2720, 15 / 544, 0.0],
        [25 / 24, -49 / 48, 125 / 16, -85 / 12],
    ]
)


@leaf
def diagonal(evaluate, machine, history):
    """y := the state after one step. Returns a status."""
    run = run_at(history)
    t, h, y, known = run.clock[TIME], run.clock[STEP], run.y, run.stages[KNOWN]
    n = y.shape[0]
    for stage in range(STAGES):
        copy(run.previous, known)
        add_rows(run.stages[WORK:], h, MATRIX[stage], stage, known)
        # y, the stage before (at first the start of the step), is the prediction
        status = newton(evaluate, machine, history, t + NODES[stage] * h, GAMMA * h)
        if status != OK:
            return status
        for i in range(n):
            run.stages[WORK + stage, i] = (y[i] - known[i]) / (GAMMA * h)
    return OK


@leaf
def begin_implicit(evaluate, machine, history, order):
    """A step without history, for a method of `order`. Returns a status."""
    if run_at(history).counter[NEWTON] == 1:
        return diagonal(evaluate, machine, history)
    return begin(evaluate, machine, history, order)


# Implicit equations y = known + share f(t, y) of one step, solved by functional iteration or by Newton's.
#
# Either starts from the prediction in run.y and ends when no entry of y changes by more than clock[CORRECTOR_TOLERANCE] of its largest
# value so far (or of the scale of such entries, where that is larger), after at most counter[MOST_ITERATIONS] evaluations. Slopes, where
# there are any, count as values.

# A change this many times the first one grows without bound.
DIVERGED = 1e3


@leaf
def solve(evaluate, machine, history, t, share):
    """y := the solution of y = stages[KNOWN] + share f(t, y) next to y. Returns a status."""
    run = run_at(history)
    for i in range(run.y.shape[0]):
        run.scale[i] = max(run.scale[i], np.abs(run.previous[i]))
    if run.counter[NEWTON] == 1:
        return newton(evaluate, machine, history, t, share)
    return functional(evaluate, machine, history, t, share)


@leaf
def functional(evaluate, machine, history, t, share):
    """y := known + share f(t, y), again and again: it contracts where share ‖∂f/∂y‖ < 1."""
    run = run_at(history)
    y, known, rate = run.y, run.stages[KNOWN], run.stages[RATE]
    first = 0.0
    for m in range(run.counter[MOST_ITERATIONS]):
        status = evaluate_at(evaluate, machine, run, t, y, rate)
        run.counter[ITERATIONS] += 1
        if status != OK:
            return status
        change = 0.0
        for i in range(y.shape[0]):
            value = known[i] + share * rate[i]
            change = larger(change, value - y[i], max(run.scale[i], np.abs(value)))
            if is_whole(machine):
                change = larger(change, steepest(value - y[i]), max(run.scale[i], np.abs(value)))
            y[i] = value
        if change <= run.clock[CORRECTOR_TOLERANCE]:
            return OK
        if m == 0:
            first = change
        if not change <= DIVERGED * first:
            return NOT_CONVERGED
    return NOT_CONVERGED


# Weights of the Adams methods (report 44, eqs. 107–109, Tables 2 and 3 with the signs of y and of AB1 corrected).
#
# Bashforth, explicit    y_{n+1} = y_n + h Σ β_j f_{n-j},   j = 0 … k-1
# Moulton, implicit      y_{n+1} = y_n + h Σ β_j f_{n+1-j}, j = 0 … k-1
#
# Moulton's method of order k goes with the prediction of Bashforth's of order k - 1 (1 for k = 1), which looks back on the same rates;
# the report finds such pairs the cheapest.

# [order, j]
BASHFORTH = np.zeros((6, 5))
BASHFORTH[1, :1] = 1.0
BASHFORTH[2, :2] = 3 / 2, -1 / 2
BASHFORTH[3, :3] = 23 / 12, -16 / 12, 5 / 12
BASHFORTH[4, :4] = 55 / 24, -59 / 24, 37 / 24, -9 / 24
BASHFORTH[5, :5] = 1901 / 720, -2774 / 720, 2616 / 720, -1274 / 720, 251 / 720
MOULTON = np.zeros((6, 5))
MOULTON[1, :1] = 1.0
MOULTON[2, :2] = 1 / 2, 1 / 2
MOULTON[3, :3] = 5 / 12, 8 / 12, -1 / 12
MOULTON[4, :4] = 9 / 24, 19 / 24, -5 / 24, 1 / 24
MOULTON[5, :5] = 251 / 720, 646 / 720, -264 / 720, 106 / 720, -19 / 720


@leaf
def rates_before(order):
    """How many rates the prediction for an implicit method of this order looks back on, and Moulton's method with it."""
    return max(order - 1, 1)


@leaf
def predict(history, order):
    """run.y += h Σ β_j f_{n-j}: the prediction for an implicit method of this order."""
    run, count = run_at(history), rates_before(order)
    add_rows(run.stages[RATES:], run.clock[STEP], BASHFORTH[count], count, run.y)


@leaf
def predict_moulton(history, order):
    """run.y := the prediction, stages[KNOWN] := y_n and the old rates of Moulton's method of this order."""
    run = run_at(history)
    known = run.stages[KNOWN]
    copy(run.y, known)
    add_rows(run.stages[RATES:], run.clock[STEP], MOULTON[order, 1:], order - 1, known)
    predict(history, order)


@entry(STEP_SIGNATURE)
def bashforth(evaluate, machine, history):
    """One step of Adams–Bashforth of counter[ORDER]."""
    run = run_at(history)
    order = run.counter[ORDER]
    if remember(history, order, 0) < order:
        return begin(evaluate, machine, history, order)
    add_rows(run.stages[RATES:], run.clock[STEP], BASHFORTH[order], order, run.y)
    return OK


@entry(STEP_SIGNATURE)
def predict_correct(evaluate, machine, history):
    """One step of Adams–Bashforth–Moulton of counter[ORDER]: predict, evaluate, correct; the loop evaluates at the accepted state."""
    run = run_at(history)
    order = run.counter[ORDER]
    count = rates_before(order)
    if remember(history, count, 0) < count:
        return begin(evaluate, machine, history, order)
    predict_moulton(history, order)
    known, rate, share = run.stages[KNOWN], run.stages[RATE], run.clock[STEP] * MOULTON[order, 0]
    status = evaluate_at(evaluate, machine, run, run.clock[REACHED], run.y, rate)
    run.counter[ITERATIONS] += 1
    if status != OK:
        return status
    advance(known, share, rate, run.y)
    return OK


# by order: the largest |rate| times step that Bashforth's methods hold
HELD = {1: 2.0, 2: 1.0, 3: 0.5, 4: 0.3, 5: 0.16}


# Adams–Moulton methods with a fixed step, their equations solved by iteration; order 1 is the implicit Euler method, 2 the
# trapezoidal rule.


@entry(STEP_SIGNATURE)
def moulton(evaluate, machine, history):
    """One step of Adams–Moulton of counter[ORDER]."""
    run = run_at(history)
    order = run.counter[ORDER]
    count = rates_before(order)
    if remember(history, count, 0) < count:
        return begin_implicit(evaluate, machine, history, order)
    predict_moulton(history, order)
    return solve(evaluate, machine, history, run.clock[REACHED], run.clock[STEP] * MOULTON[order, 0])


# Gear's methods, backward differentiation of order 1 to 4, with a fixed step (report 44, Table 4).
#
# y_{n+1} = Σ α_j y_{n-j} + β h f_{n+1}, j = 0 … k-1: the polynomial through k + 1 states has the slope f at the new one.
#
# With functional iteration the prediction is by Adams–Bashforth of order k - 1 (1 for k = 1), of the same local order as the start needs.
# With Newton's it is the polynomial through the last k states: in a stiff system the rates of states that are not exact are large,
# those states are not.

# [order, j]
BACKWARD = np.zeros((5, 4))
BACKWARD[1, :1] = 1.0
BACKWARD[2, :2] = 4 / 3, -1 / 3
BACKWARD[3, :3] = 18 / 11, -9 / 11, 2 / 11
BACKWARD[4, :4] = 48 / 25, -36 / 25, 16 / 25, -3 / 25
RATE_WEIGHT = np.array([0.0, 1.0, 2 / 3, 6 / 11, 12 / 25])
EXTRAPOLATED = np.zeros((5, 4))
EXTRAPOLATED[1, :1] = 1.0
EXTRAPOLATED[2, :2] = 2.0, -1.0
EXTRAPOLATED[3, :3] = 3.0, -3.0, 1.0
EXTRAPOLATED[4, :4] = 4.0, -6.0, 4.0, -1.0


@entry(STEP_SIGNATURE)
def gear(evaluate, machine, history):
    """One step of Gear's method of counter[ORDER]."""
    run = run_at(history)
    order = run.counter[ORDER]
    if remember(history, rates_before(order), order) < order:
        return begin_implicit(evaluate, machine, history, order)
    sum_rows(run.stages[STATES:], 1.0, BACKWARD[order], order, run.stages[KNOWN])
    if run.counter[NEWTON] == 1:
        sum_rows(run.stages[STATES:], 1.0, EXTRAPOLATED[order], order, run.y)
    else:
        predict(history, order)
    return solve(evaluate, machine, history, run.clock[REACHED], run.clock[STEP] * RATE_WEIGHT[order])


FACTS = (
    *(
        IntegratorFacts(f"ab{order}", bashforth, order, ROWS, NUMBERS, multistep=True, held=held)
        for order, held in HELD.items()
    ),
    *(IntegratorFacts(f"abm{order}", predict_correct, order, ROWS, NUMBERS, multistep=True) for order in HELD),
    *(
        IntegratorFacts(f"am{order}", moulton, order, ROWS, NUMBERS, kind="corrector", multistep=True)
        for order in range(1, len(MOULTON))
    ),
    *(
        IntegratorFacts(f"gear{order}", gear, order, ROWS, NUMBERS, kind="corrector", multistep=True)
        for order in range(1, len(BACKWARD))
    ),
)
