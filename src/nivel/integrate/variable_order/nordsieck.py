"""The polynomial of a multistep method as the array z_k = h^k y^{(k)}/k! (Nordsieck 1962): P(x) = Σ z_k x^k with x = (t - t_n)/h."""

from __future__ import annotations

from nivel.integrate.loop.run import DENSE, ORDER, POWERS
from nivel.integrate.variable_order.variable_workspace import CORRECTION, PREDICTED, Z
from nivel.native.function import leaf


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
