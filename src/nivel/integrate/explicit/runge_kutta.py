"""Explicit Runge–Kutta methods with a fixed step: Euler, Heun, Kutta (report 44, eqs. 98–106).

Each of them has as many stages as its order, so the order names the table.
"""

import numpy as np

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import ORDER, STEP, STEP_SIGNATURE, TIME, add_rows, evaluate_at, run_at
from nivel.kernels.algebra.rows import advance, copy
from nivel.kernels.core.status import OK
from nivel.native.entry import entry
from nivel.native.function import leaf

HIGHEST = 4
# [order]: node of each stage, its share of the slope of the stage before it, and weights
NODES = np.zeros((HIGHEST + 1, HIGHEST))
WEIGHTS = np.zeros((HIGHEST + 1, HIGHEST))
# Euler
WEIGHTS[1, :1] = 1.0
# Heun: the trapezoidal rule (eq. 99 with its second weight corrected)
NODES[2, :2] = 0.0, 1.0
WEIGHTS[2, :2] = 0.5, 0.5
# Kutta 1901, the classical method: Simpson's rule
NODES[4] = 0.0, 0.5, 0.5, 1.0
WEIGHTS[4] = 1 / 6, 1 / 3, 1 / 3, 1 / 6


@leaf
def explicit(evaluate, machine, history, order, t, h, row):
    """y := y(t + h) from y at t, whose rate is stages[row]; the next `order` - 1 rows are for the other stages. Returns a status.

    In these methods each stage starts from the slope of the one before it alone.
    """
    run = run_at(history)
    y, trial = run.y, run.trial
    for stage in range(1, order):
        node, before = NODES[order, stage], run.stages[row + stage - 1]
        advance(y, node * h, before, trial)
        status = evaluate_at(evaluate, machine, run, t + node * h, trial, run.stages[row + stage])
        if status != OK:
            return status
    add_rows(run.stages[row:], h, WEIGHTS[order], order, y)
    return OK


@entry(STEP_SIGNATURE)
def step(evaluate, machine, history):
    """One step of the method of counter[ORDER]."""
    run = run_at(history)
    copy(run.rate, run.stages[0])
    return explicit(evaluate, machine, history, run.counter[ORDER], run.clock[TIME], run.clock[STEP], 0)


FACTS = (
    IntegratorFacts("euler", step, order=1, stages=HIGHEST, held=2.0),
    IntegratorFacts("heun", step, order=2, stages=HIGHEST, held=2.0),
    IntegratorFacts("rk4", step, order=4, stages=HIGHEST, held=2.7),
)
