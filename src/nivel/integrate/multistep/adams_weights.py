"""Weights of the Adams methods (report 44, eqs. 107–109, Tables 2 and 3 with the signs of y and of AB1 corrected).

Bashforth, explicit    y_{n+1} = y_n + h Σ β_j f_{n-j},   j = 0 … k-1
Moulton, implicit      y_{n+1} = y_n + h Σ β_j f_{n+1-j}, j = 0 … k-1

Moulton's method of order k goes with the prediction of Bashforth's of order k - 1 (1 for k = 1), which looks back on the same rates;
the report finds such pairs the cheapest.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop.run import STEP, run_at
from nivel.integrate.loop.workspace import KNOWN, RATES
from nivel.native.function import leaf

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
