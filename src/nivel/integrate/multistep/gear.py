"""Gear's methods, backward differentiation of order 1 to 4, with a fixed step (report 44, Table 4).

y_{n+1} = Σ α_j y_{n-j} + β h f_{n+1}, j = 0 … k-1: the polynomial through k + 1 states has the slope f at the new one.

With functional iteration the prediction is by Adams–Bashforth of order k - 1 (1 for k = 1), of the same local order as the start needs.
With Newton's it is the polynomial through the last k states: in a stiff system the rates of states that are not exact are large,
those states are not.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import NEWTON, ORDER, REACHED, STEP, STEP_SIGNATURE, run_at
from nivel.integrate.loop.workspace import KNOWN, NUMBERS, ROWS, STATES
from nivel.integrate.multistep.adams import predict, rates_before
from nivel.integrate.multistep.corrector import solve
from nivel.integrate.multistep.multistep import remember
from nivel.integrate.multistep.newton import begin_implicit
from nivel.native.entry import entry
from nivel.native.function import leaf

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


@leaf
def combine_states(history, weights, count, y):
    """y := Σ weights_j y_{n-j}, over `count` states."""
    run = run_at(history)
    y[:] = 0.0
    for j in range(count):
        state, weight = run.stages[STATES + j], weights[j]
        for i in range(y.shape[0]):
            y[i] += weight * state[i]


@entry(STEP_SIGNATURE)
def gear(evaluate, machine, history):
    """One step of Gear's method of counter[ORDER]."""
    run = run_at(history)
    order = run.counter[ORDER]
    if remember(history, rates_before(order), order) < order:
        return begin_implicit(evaluate, machine, history, order)
    combine_states(history, BACKWARD[order], order, run.stages[KNOWN])
    if run.counter[NEWTON] == 1:
        combine_states(history, EXTRAPOLATED[order], order, run.y)
    else:
        predict(history, order)
    return solve(evaluate, machine, history, run.clock[REACHED], run.clock[STEP] * RATE_WEIGHT[order])


FACTS = tuple(
    IntegratorFacts(f"gear{order}", gear, order, ROWS, NUMBERS, kind="corrector", multistep=True)
    for order in range(1, len(BACKWARD))
)
