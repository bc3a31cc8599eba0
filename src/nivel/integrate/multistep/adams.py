"""Adams methods with a fixed step: Bashforth's, the pairs that predict, evaluate and correct once (report 44, Fig. 15), and Moulton's."""

from __future__ import annotations

import numpy as np

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import EVALUATIONS, ITERATIONS, ORDER, REACHED, STEP, STEP_SIGNATURE, run_at
from nivel.integrate.loop.workspace import KNOWN, NUMBERS, RATE, RATES, ROWS
from nivel.integrate.multistep.corrector import solve
from nivel.integrate.multistep.multistep import begin, remember
from nivel.integrate.multistep.newton import begin_implicit
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_evaluate
from nivel.native.entry import entry
from nivel.native.function import leaf

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
def add_rates(history, weights, count, y):
    """y += h Σ weights_j f_{n-j}, over `count` rates."""
    run = run_at(history)
    for j in range(count):
        rate, weight = run.stages[RATES + j], run.clock[STEP] * weights[j]
        for i in range(y.shape[0]):
            y[i] += weight * rate[i]


@leaf
def rates_before(order):
    """How many rates the prediction for an implicit method of this order looks back on, and Moulton's method with it."""
    return max(order - 1, 1)


@leaf
def predict(history, order):
    """run.y += h Σ β_j f_{n-j}: the prediction for an implicit method of this order."""
    count = rates_before(order)
    add_rates(history, BASHFORTH[count], count, run_at(history).y)


@leaf
def predict_moulton(history, order):
    """run.y := the prediction, stages[KNOWN] := y_n and the old rates of Moulton's method of this order."""
    run = run_at(history)
    known = run.stages[KNOWN]
    for i in range(known.shape[0]):
        known[i] = run.y[i]
    add_rates(history, MOULTON[order, 1:], order - 1, known)
    predict(history, order)


@entry(STEP_SIGNATURE)
def bashforth(evaluate, machine, history):
    """One step of Adams–Bashforth of counter[ORDER]."""
    run = run_at(history)
    order = run.counter[ORDER]
    if remember(history, order, 0) < order:
        return begin(evaluate, machine, history, order)
    add_rates(history, BASHFORTH[order], order, run.y)
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
    status = call_evaluate(evaluate, machine, run.clock[REACHED], run.y, rate)
    run.counter[EVALUATIONS] += 1
    run.counter[ITERATIONS] += 1
    if status != OK:
        return status
    for i in range(known.shape[0]):
        run.y[i] = known[i] + share * rate[i]
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
)
