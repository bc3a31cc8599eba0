"""The corrector of the multistep methods that choose their steps: the correction e of the predicted state.

The corrected polynomial P + e c has to satisfy the equations of motion at the new time, h f(t, P(0) + e) = P'(0) + c_1 e. Either e is
evaluated again and again from f (functional iteration, for motions that are not stiff), or Newton's method is used:
(1 - (h/c_1) ∂f/∂y) Δe = (h f - P'(0) - c_1 e)/c_1, with a matrix that serves for many steps. It is one
of those below; for each a corrector of its own is compiled.
"""

import numpy as np

from nivel.integrate.loop.run import (
    DENSE,
    FACTORISATIONS,
    ITERATIONS,
    MOST_ITERATIONS,
    NEWTON,
    ORDER,
    POWERS,
    REACHED,
    evaluate_at,
    run_at,
)
from nivel.integrate.loop.step_control import size
from nivel.integrate.multistep.multistep import renew
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.lu import solve_lu
from nivel.kernels.algebra.rows import add, add_times, copy, subtract
from nivel.kernels.core.lanes import is_whole, steepest
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.kernels.record.hook import call_evaluate
from nivel.kernels.residual.shifted_along import prepare_shifted, solve_shifted
from nivel.native.function import leaf

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
SAME = 0.3


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
        if np.abs(share - run.numbers[SHARE]) <= SAME * run.numbers[SHARE]:
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
    return renew(evaluate, machine, history, run.clock[REACHED], share, run.trial, rate)


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
