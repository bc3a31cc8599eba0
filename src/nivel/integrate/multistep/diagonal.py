"""The start of implicit multistep methods: with functional iteration as that of explicit ones; with Newton's the step may be far beyond
what an explicit method stands, and the start is a diagonally implicit Runge–Kutta method of order 4, L-stable.

Coefficients: Hairer, Wanner 1996, table IV.6.5. All stages share γ = 1/4, hence one matrix; the last one is the new state.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop.run import NEWTON, STEP, TIME, run_at
from nivel.integrate.loop.workspace import KNOWN, WORK
from nivel.integrate.multistep.multistep import begin
from nivel.integrate.multistep.newton import newton
from nivel.kernels.core.status import OK
from nivel.native.function import leaf

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
        for i in range(n):
            known[i] = run.previous[i]
        for k in range(stage):
            slope, share = run.stages[WORK + k], h * MATRIX[stage, k]
            for i in range(n):
                known[i] += share * slope[i]
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
