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
from nivel.integrate.loop.run import (
    DENSE,
    DONE_STEPS,
    FACTORISATIONS,
    ITERATIONS,
    MOST_ITERATIONS,
    NEWTON,
    ORDER,
    POWERS,
    REACHED,
    RESTART,
    STEP,
    STEP_SIGNATURE,
    evaluate_at,
    run_at,
)
from nivel.integrate.loop.step_control import size
from nivel.integrate.multistep.multistep import renew as renew_by_differences
from nivel.integrate.variable_order.multistep_polynomials import ADAMS, BDF, correction, monic
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.lu import solve_lu
from nivel.kernels.algebra.rows import add, add_times, clear, copy, subtract
from nivel.kernels.core.lanes import is_whole, steepest
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.kernels.record.hook import call_evaluate
from nivel.kernels.residual.shifted_along import prepare_shifted, solve_shifted
from nivel.native.entry import entry
from nivel.native.function import leaf

# The corrector of the multistep methods that choose their steps: the correction e of the predicted state.
#
# The corrected polynomial P + e c has to satisfy the equations of motion at the new time, h f(t, P(0) + e) = P'(0) + c_1 e. Either e is
# evaluated again and again from f (functional iteration, for motions that are not stiff), or Newton's method is used:
# (1 - (h/c_1) ∂f/∂y) Δe = (h f - P'(0) - c_1 e)/c_1, with a matrix that serves for many steps. It is one
# of those below; for each a corrector of its own is compiled.

# The polynomial of a multistep method as the array z_k = h^k y^{(k)}/k! (Nordsieck 1962): P(x) = Σ z_k x^k with x = (t - t_n)/h.

# Rows of run.stages and entries of run.numbers of the multistep methods that choose their steps and orders.

MOST_ORDER = 12
# Rows of run.stages, all (ny,): the Nordsieck array, the same predicted; the correction e of this step, D_q of the last one, the rate of
# the iterate, its change; h ẏ of the last corrected polynomial; what of e counts as an error.
Z, PREDICTED = 0, MOST_ORDER + 1
CORRECTION, LAST, RATE, CHANGE, SLOPE, ESTIMATE = 26, 27, 28, 29, 30, 31
ROWS = 32
# Entries of run.numbers: the step that Z is scaled with [s]; how much an iteration reduces the error; the h/c_1 that run.matrix is for [s]
# (0: none); accepted steps until the order is looked at again; the step of LAST [s] (0: none).
SCALED, CONTRACTION, SHARE, WAIT, LAST_STEP = 0, 1, 2, 3, 4
# … and where vectors begin there: the last steps, newest first [s]; ξ; the coefficients c; work for polynomials
STEPS, XI, C, WORK = 5, 20, 35, 50
NUMBERS = 66


@leaf
def predict(run, ratio):
    """PREDICTED := Z about the end of a step that is `ratio` times the one that Z is scaled with."""
    q, n, stages = run.counter[ORDER], run.y.shape[0], run.stages
    power = 1.0
    for k in range(q + 1):
        for i in range(n):
            stages[PREDICTED + k, i] = power * stages[Z + k, i]
        power *= ratio
    for k in range(q):
        for m in range(q - k):
            j = q - 1 - m
            add(stages[PREDICTED + j + 1], stages[PREDICTED + j])


@leaf
def accept(run, c):
    """Z := PREDICTED + c CORRECTION."""
    for k in range(run.counter[ORDER] + 1):
        for i in range(run.y.shape[0]):
            run.stages[Z + k, i] = run.stages[PREDICTED + k, i] + c[k] * run.stages[CORRECTION, i]


@leaf
def add_polynomial(run, p, degree, row, factor):
    """Z += factor p(x) times row `row` of the stages, for a polynomial of this degree without a constant."""
    for k in range(1, degree + 1):
        add_times(factor * p[k], run.stages[row], run.stages[Z + k])


@leaf
def fill_dense(run):
    """The dense output of the step that Z has just reached: the same polynomial about the begin of the step, where it is `previous`."""
    q, dense = run.counter[ORDER], run.dense
    for k in range(1, q + 1):
        copy(run.stages[Z + k], dense[k - 1])
    for k in range(q):
        for m in range(q - max(k, 1)):
            j = q - 1 - m
            subtract(dense[j], dense[j - 1])
    run.counter[DENSE], run.counter[POWERS] = q, 1


# More iterations than this are dearer than a shorter step.
MOST = 4
# The iteration ends where what is left of it is this share of what a step may be wrong by.
CLOSE = 0.1
# Slopes change no more where they change by less than this share of the scales; passes for that at most.
SETTLED, MOST_SETTLING = 1e-10, 30
# A contraction is forgotten at this rate; an iteration whose change grows by DIVERGES has failed.
FORGET, DIVERGES = 0.3, 2.0
# Newton's matrix is found again where h/c_1 has changed by more than this share.
SAME_SHARE = 0.3


def corrector(find_matrix, solve_matrix):
    """The functions `correct` and `damp` with Newton's matrix from these."""

    @leaf
    def settle_slopes(evaluate, machine, history, h):
        """Slopes of the correction found, by further changes, until they change no more. Returns a status."""
        run = run_at(history)
        e, predicted, slope = run.stages[CORRECTION], run.stages[PREDICTED], run.stages[PREDICTED + 1]
        rate, change, leading = run.stages[RATE], run.stages[CHANGE], run.numbers[C + 1]
        for _ in range(MOST_SETTLING):
            status = call_evaluate(evaluate, machine, run.clock[REACHED], run.trial, rate)
            for i in range(e.shape[0]):
                change[i] = (h * rate[i] - slope[i]) / leading - e[i]
            if status == OK and run.counter[NEWTON] == 1:
                status = solve_matrix(machine, history, change)
            if status != OK:
                return status
            largest = 0.0
            for i in range(e.shape[0]):
                e[i] += change[i]
                run.trial[i] = predicted[i] + e[i]
                largest = max(largest, steepest(change[i]) / real(run.scale[i]))
            if largest <= SETTLED:
                break
        return OK

    @leaf
    def iterate(evaluate, machine, history, h, tolerance):
        run = run_at(history)
        e, predicted, slope = run.stages[CORRECTION], run.stages[PREDICTED], run.stages[PREDICTED + 1]
        rate, change, leading = run.stages[RATE], run.stages[CHANGE], run.numbers[C + 1]
        for i in range(e.shape[0]):
            e[i] = 0.0
            run.trial[i] = predicted[i]
        before = 0.0
        for m in range(min(MOST, run.counter[MOST_ITERATIONS])):
            status = evaluate_at(evaluate, machine, run, run.clock[REACHED], run.trial, rate)
            run.counter[ITERATIONS] += 1
            if status != OK:
                return status
            for i in range(e.shape[0]):
                change[i] = (h * rate[i] - slope[i]) / leading - e[i]
            if run.counter[NEWTON] == 1:
                status = solve_matrix(machine, history, change)
                if status != OK:
                    return status
                # for the h/c_1 that the matrix was not made for (Byrne, Hindmarsh 1975): right for the stiff and the soft on average
                factor = 2.0 / (1.0 + h / leading / run.numbers[SHARE])
                for i in range(e.shape[0]):
                    change[i] *= factor
            for i in range(e.shape[0]):
                e[i] += change[i]
                run.trial[i] = predicted[i] + e[i]
            now = size(run, change)
            if m > 0:
                run.numbers[CONTRACTION] = max(FORGET * run.numbers[CONTRACTION], now / before)
            if now * min(1.0, run.numbers[CONTRACTION]) <= CLOSE * tolerance:
                return settle_slopes(evaluate, machine, history, h) if is_whole(machine) else OK
            if not now < np.inf or (m > 0 and now > DIVERGES * before):
                break
            before = now
        run.numbers[CONTRACTION] = 1.0
        return NOT_CONVERGED

    @leaf
    def renew(evaluate, machine, history, share):
        """The factors of 1 - share ∂f/∂y at the predicted state. Returns a status."""
        run = run_at(history)
        copy(run.stages[PREDICTED], run.trial)
        run.numbers[SHARE] = 0.0
        status = evaluate_at(evaluate, machine, run, run.clock[REACHED], run.trial, run.stages[RATE])
        if status == OK:
            status = find_matrix(evaluate, machine, history, share, run.stages[RATE])
            run.counter[FACTORISATIONS] += 1
        if status == OK:
            run.numbers[SHARE] = share
        return status

    @leaf
    def correct(evaluate, machine, history, h, tolerance):
        """Fill CORRECTION, and run.trial with the new state; `tolerance` is what a step may be wrong by. Returns a status."""
        run = run_at(history)
        if run.counter[NEWTON] == 0:
            return iterate(evaluate, machine, history, h, tolerance)
        share = h / run.numbers[C + 1]
        if np.abs(share - run.numbers[SHARE]) <= SAME_SHARE * run.numbers[SHARE]:
            status = iterate(evaluate, machine, history, h, tolerance)
            if status == OK:
                return OK
        run.numbers[CONTRACTION] = 1.0
        status = renew(evaluate, machine, history, share)
        return iterate(evaluate, machine, history, h, tolerance) if status == OK else status

    @leaf
    def damp(machine, history, source, x):
        """x := `source`, with Newton's method less of the vibrations that are stiff: (1 - (h/c_1) ∂f/∂y)⁻¹ of it. Returns a status."""
        run = run_at(history)
        copy(source, x)
        return solve_matrix(machine, history, x) if run.counter[NEWTON] == 1 else OK

    return correct, damp


# Newton's matrices of multistep methods that choose their steps: from differences of f, for any equations of motion; and from exact
# derivatives of the equations of motion, sparse.


@leaf
def find_matrix(evaluate, machine, history, share, rate):
    """run.matrix := factors of 1 - share ∂f/∂y at run.trial, where `rate` is f. Returns a status."""
    run = run_at(history)
    return renew_by_differences(evaluate, machine, history, run.clock[REACHED], share, run.trial, rate)


@leaf
def solve_matrix(machine, history, x):
    """Overwrite x (ny,) with the solution. Returns a status."""
    run = run_at(history)
    solve_lu(run.matrix, run.pivot, x)
    return OK


@leaf
def find_exact_matrix(evaluate, machine, history, share, rate):
    """The factors that 1 - share ∂f/∂y takes at run.trial, last evaluated with f = `rate`. Returns a status."""
    run = run_at(history)
    return prepare_shifted(machine, run.clock[REACHED], run.trial, rate, share)


@leaf
def solve_exact_matrix(machine, history, x):
    """Overwrite x (ny,) with the solution. Returns a status."""
    run = run_at(history)
    return solve_shifted(machine, run.clock[REACHED], x, run.numbers[SHARE], 0.0)


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
    `nivel.integrate.variable_order.variable_order`."""

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
