"""Multistep methods that choose their steps and their orders: what Adams–Moulton and BDF have in common.

A step predicts with the polynomial that it has, corrects, and compares the correction with the tolerance. Of the orders q - 1, q and
q + 1 the one that promises the longest step is taken, q + 1 once q + 1 steps of order q were done (Gear 1971; Byrne, Hindmarsh 1975).

The direct correction of the loop moves y a little after every step. The polynomial follows: its value at t_n is replaced by the
corrected one, and for Adams–Moulton with functional iteration its rate by that of the corrected state, which is what that method
remembers. BDF remembers values: they are all moved alike, and their differences, which are what counts, stay. With Newton's method the
rate is kept, since in stiff directions a small change of y would change it beyond measure.

With functional iteration the Adams methods go on from the next order: the estimated error of the corrected state is subtracted, which
makes it that of the method of order q + 1 (Shampine, Gordon 1975), and what a step errs by is well below its estimate.

With Newton's method errors are measured after (1 - (h/c_1) ∂f/∂y)⁻¹ (Shampine, Baca 1984), which leaves the slow ones as they are. In the
direction of a stiff spring velocities are derivatives of positions that hardly change, as they are in a rigid joint: with every change
of the step or the order they jump by as much as h^q, whatever the next step is, and unfiltered that would be rejected again and again.
"""

import numpy as np

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop import step_control
from nivel.integrate.loop.dense import wanted
from nivel.integrate.loop.run import DONE_STEPS, NEWTON, ORDER, RESTART, STEP, STEP_SIGNATURE, run_at
from nivel.integrate.variable_order.multistep_polynomials import ADAMS, BDF, correction, monic
from nivel.integrate.variable_order.variable_corrector import (
    CHANGE,
    CONTRACTION,
    CORRECTION,
    ESTIMATE,
    FORGET,
    LAST,
    LAST_STEP,
    MOST_ORDER,
    NUMBERS,
    ROWS,
    SCALED,
    SHARE,
    SLOPE,
    STEPS,
    WAIT,
    WORK,
    XI,
    C,
    Z,
    accept,
    add_polynomial,
    corrector,
    fill_dense,
    find_exact_matrix,
    find_matrix,
    predict,
    solve_exact_matrix,
    solve_matrix,
)
from nivel.kernels.algebra.rows import clear, copy
from nivel.kernels.core.status import OK
from nivel.native.entry import entry
from nivel.native.function import leaf

# Errors are expected to be that much larger than estimated: with the order less one, the same, one more.
LOWER, SAME, HIGHER = 6.0, 4.0, 8.0
# A step is made longer only if it gets longer by this factor, and by no more than the second (the third at the start).
WORTH, MOST_GROWTH, FIRST_GROWTH = 1.2, 2.0, 10.0
# After so many rejections of one step its past says nothing about it, and the polynomial begins anew with order one.
MOST_REJECTIONS = 3


@leaf
def start(run):
    """The polynomial of order one from the accepted state and its rate, as if steps of this length had been done before."""
    h = run.clock[STEP]
    for i in range(run.y.shape[0]):
        run.stages[Z, i] = run.y[i]
        run.stages[Z + 1, i] = h * run.rate[i]
    run.counter[ORDER] = 1
    numbers = run.numbers
    numbers[SCALED], numbers[CONTRACTION], numbers[SHARE], numbers[WAIT], numbers[LAST_STEP] = h, 1.0, 0.0, 2.0, 0.0
    for i in range(MOST_ORDER + 1):
        numbers[STEPS + i] = 0.0


@leaf
def measure_contraction(run):
    """What one more evaluation in the last step would have changed, as a share of what the first one changed: the loop evaluates at the
    accepted state anyway."""
    change, first = run.stages[CHANGE], step_control.size(run, run.stages[CORRECTION])
    for i in range(run.y.shape[0]):
        change[i] = (run.numbers[SCALED] * run.rate[i] - run.stages[SLOPE, i]) / run.numbers[C + 1]
    if first > 0.0:
        run.numbers[CONTRACTION] = max(FORGET * run.numbers[CONTRACTION], step_control.size(run, change) / first)


@leaf
def renew(run, family):
    """The polynomial through the accepted state as the loop corrected it."""
    copy(run.y, run.stages[Z])
    if family == ADAMS and run.counter[NEWTON] == 0:
        for i in range(run.y.shape[0]):
            run.stages[Z + 1, i] = run.numbers[SCALED] * run.rate[i]


@leaf
def place_points(run, h):
    """ξ_i for a step h; before the start steps like it are imagined."""
    xi = run.numbers[XI : XI + MOST_ORDER + 3]
    xi[0], xi[1] = 0.0, 1.0
    for i in range(1, run.counter[ORDER] + 1):
        before = run.numbers[STEPS + i - 1]
        xi[i + 1] = xi[i] + (before / h if before > 0.0 else 1.0)


@leaf
def advance_order(run, family, change, K):
    """The polynomial of the order that is larger or smaller by one; CORRECTION is that of the step just done."""
    q, numbers = run.counter[ORDER], run.numbers
    p = numbers[WORK : WORK + MOST_ORDER + 4]
    xi = numbers[XI : XI + MOST_ORDER + 3]
    if change > 0:
        clear(run.stages[Z + q + 1])
        monic(family, q + 1, xi, p)
        add_polynomial(run, p, q + 1, CORRECTION, 1.0 / K)
    else:
        monic(family, q, xi, p)
        add_polynomial(run, p, q - 1, Z + q, -1.0)
    run.counter[ORDER] = q + change
    numbers[WAIT], numbers[LAST_STEP] = q + change + 1.0, 0.0


@leaf
def higher_error(run, h, K, above):
    """Error of the step just done, had its order been one more: from the change of D_q since the last step."""
    q = run.counter[ORDER]
    ratio, largest = (h / run.numbers[LAST_STEP]) ** (q + 1), 0.0
    for i in range(run.y.shape[0]):
        difference = run.stages[ESTIMATE, i] / K - ratio * run.stages[LAST, i]
        largest = max(largest, np.abs(difference) / run.scale[i])
    return above * largest / (q + 2.0)


@leaf
def longer(error, order, margin):
    """The factor by which a step of error `error` (a share of the allowed one) may be longer with a method of this order."""
    return (margin * max(error, 1e-12)) ** (-1.0 / (order + 1.0))


@leaf
def choose(run, family, most, h, tolerance, error, lower, factors):
    """The next order and step. error : of the step just done, a share of the allowed one; lower : size of z_q; factors : (K, C_{q-1}, C_q,
    C_{q+1})."""
    K, below, _, above = factors
    q, numbers = run.counter[ORDER], run.numbers
    growth, change = longer(error, q, SAME), 0
    numbers[WAIT] -= 1.0
    if numbers[WAIT] <= 0.0:
        numbers[WAIT] = 2.0
        if q > 1:
            factor = longer(below * lower / tolerance, q - 1, LOWER)
            if factor > growth:
                growth, change = factor, -1
        if q < most and numbers[LAST_STEP] > 0.0:
            factor = longer(higher_error(run, h, K, above) / tolerance, q + 1, HIGHER)
            if factor > growth:
                growth, change = factor, 1
    for i in range(run.y.shape[0]):
        run.stages[LAST, i] = run.stages[ESTIMATE, i] / K
    numbers[LAST_STEP] = h
    if growth > 1.0 and growth < WORTH:
        growth = 1.0
    if change != 0:
        advance_order(run, family, change, K)
    return growth


def multistep(family, most, correct, damp):
    """The function `variable_step` of a family, for orders up to `most`, with a corrector of
    `nivel.integrate.variable_order.variable_corrector`."""

    @leaf
    def variable_step(evaluate, machine, history, tolerance):
        """One accepted step that may be wrong by `tolerance`. Returns a status."""
        run = run_at(history)
        numbers = run.numbers
        step_control.enter(evaluate, machine, history, 1.0, tolerance)
        if step_control.is_fresh(run):
            start(run)
            run.counter[RESTART] = 0
        elif run.counter[NEWTON] == 0:
            measure_contraction(run)
        renew(run, family)
        status, error, rejections = OK, 0.0, 0
        while True:
            h = step_control.reach(run)
            if h == 0.0:
                return step_control.too_small(run, status, error)
            q = run.counter[ORDER]
            place_points(run, h)
            c = numbers[C : C + MOST_ORDER + 1]
            factors = correction(family, q, numbers[XI : XI + MOST_ORDER + 3], numbers[WORK : WORK + MOST_ORDER + 4], c)
            predict(run, h / numbers[SCALED])
            status = correct(evaluate, machine, history, h, tolerance)
            if status == OK:
                status = damp(machine, history, run.stages[CORRECTION], run.stages[ESTIMATE])
            if status != OK:
                step_control.reject(run, h, step_control.AFTER_FAILURE)
            else:
                error = factors[2] / factors[0] * step_control.size(run, run.stages[ESTIMATE]) / tolerance
                shorter = step_control.exceeds_rotation_limit(machine, h)
                if error <= 1.0 and shorter == 1.0:
                    break
                if error > 1.0:
                    shorter = min(shorter, max(step_control.LEAST_CHANGE, longer(error, q, SAME)))
                step_control.reject(run, h, shorter)
            rejections += 1
            if rejections % MOST_REJECTIONS == 0:
                start(run)
        accept(run, c)
        extrapolated = factors[2] / factors[0] if family == ADAMS and run.counter[NEWTON] == 0 else 0.0
        for i in range(run.y.shape[0]):
            run.y[i] = run.stages[Z, i] - extrapolated * run.stages[CORRECTION, i]
            run.stages[SLOPE, i] = run.stages[Z + 1, i]
        if wanted(run):
            fill_dense(run)
        numbers[SCALED] = h
        for m in range(MOST_ORDER):
            numbers[STEPS + MOST_ORDER - m] = numbers[STEPS + MOST_ORDER - m - 1]
        first = numbers[STEPS + 1] == 0.0
        numbers[STEPS] = h
        lower = 0.0
        if numbers[WAIT] <= 1.0:
            status = damp(machine, history, run.stages[Z + q], run.stages[CHANGE])
            lower = step_control.size(run, run.stages[CHANGE])
        growth = choose(run, family, most, h, tolerance, error, lower, factors)
        run.clock[STEP] = h * min(growth, 1.0 if rejections > 0 else (FIRST_GROWTH if first else MOST_GROWTH))
        return status

    return variable_step


# Multistep methods of variable step and order: Adams–Moulton of orders 1 to 11, which with functional iteration goes on from the next
# order, and BDF of orders 1 to 5, with matrices from differences or with exact tangents.

MOST_ADAMS_ORDER = 11
ADAMS_SHARE = 0.03

variable_step = multistep(ADAMS, MOST_ADAMS_ORDER, *corrector(find_matrix, solve_matrix))


@entry(STEP_SIGNATURE)
def adams(evaluate, machine, history):
    """One accepted step."""
    return variable_step(evaluate, machine, history, step_control.allowed(run_at(history), ADAMS_SHARE))


# BDF (Gear's methods) of orders 1 to 5, of variable step.
#
# It damps and delays every period a little, so its errors add up: a step gets BDF_SHARE of the tolerance, or when that would be more than
# BDF_TOTAL for all the steps so far, a share of BDF_TOTAL. After many periods the errors have then grown as the logarithm of the number of
# steps.

MOST_BDF_ORDER = 5
BDF_SHARE, BDF_TOTAL = 0.001, 0.3

gear_step = multistep(BDF, MOST_BDF_ORDER, *corrector(find_matrix, solve_matrix))


@leaf
def of_step(history):
    """What the next step may be wrong by, as a share of the scales."""
    run = run_at(history)
    return step_control.allowed(run, min(BDF_SHARE, BDF_TOTAL / (1.0 + run.counter[DONE_STEPS])))


@entry(STEP_SIGNATURE)
def gear(evaluate, machine, history):
    """One accepted step."""
    return gear_step(evaluate, machine, history, of_step(history))


# BDF of orders 1 to 5, of variable step, for stiff machines: Newton's iteration with exact tangents
# (`nivel.kernels.residual.shifted_along`).

bdf_step = multistep(BDF, MOST_BDF_ORDER, *corrector(find_exact_matrix, solve_exact_matrix))


@entry(STEP_SIGNATURE)
def bdf(evaluate, machine, history):
    """One accepted step."""
    return bdf_step(evaluate, machine, history, of_step(history))


FACTS = (
    IntegratorFacts("adams", adams, MOST_ADAMS_ORDER + 1, ROWS, NUMBERS, kind="corrector", multistep=True),
    IntegratorFacts("gear", gear, MOST_BDF_ORDER, ROWS, NUMBERS, kind="corrector", multistep=True),
    IntegratorFacts("bdf", bdf, MOST_BDF_ORDER, ROWS, NUMBERS, kind="corrector", needs="directions", multistep=True),
)
