"""The polynomial of a multistep method as the array z_k = h^k y^{(k)}/k! (Nordsieck 1962): P(x) = Σ z_k x^k with x = (t - t_n)/h."""

from __future__ import annotations

from nivel.integrate.loop.run import DENSE, ORDER, POWERS
from nivel.native.function import leaf

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
            for i in range(n):
                stages[PREDICTED + j, i] += stages[PREDICTED + j + 1, i]


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
        for i in range(run.y.shape[0]):
            run.stages[Z + k, i] += factor * p[k] * run.stages[row, i]


@leaf
def fill_dense(run):
    """The dense output of the step that Z has just reached: the same polynomial about the begin of the step, where it is `previous`."""
    q, n, dense = run.counter[ORDER], run.y.shape[0], run.dense
    for k in range(1, q + 1):
        for i in range(n):
            dense[k - 1, i] = run.stages[Z + k, i]
    for k in range(q):
        for m in range(q - max(k, 1)):
            j = q - 1 - m
            for i in range(n):
                dense[j - 1, i] -= dense[j, i]
    run.counter[DENSE], run.counter[POWERS] = q, 1
