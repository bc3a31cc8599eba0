"""Newton's iteration for y = known + share f(t, y), with a matrix that serves for many steps.

(1 - share ∂f/∂y) Δy = known + share f(t, y) - y, where ∂f/∂y is found by differences: as many evaluations as y has entries. The
matrix is kept as long as the share is the same (the same method and step) and every change is below a share `SLOW` of the one before.
Where it is not, the matrix is found anew: at the prediction if it was an old one, and then the iteration starts again from there;
at the iterate if it was found in this step.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop.run import (
    CORRECTOR_TOLERANCE,
    EVALUATIONS,
    ITERATIONS,
    MOST_ITERATIONS,
    NEWTON,
    STEP,
    TIME,
    run_at,
)
from nivel.integrate.loop.workspace import KNOWN, PREDICTED, RATE, SHARE, WORK, larger
from nivel.integrate.multistep.multistep import begin
from nivel.kernels.algebra.lu import factorise_lu, solve_lu
from nivel.kernels.core.lanes import is_whole, steepest
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.kernels.record.hook import call_evaluate
from nivel.native.function import leaf

SLOW = 0.25
# Differences of this share of a scale: half the digits are left for the change of the rate.
DIFFERENCE = 1.5e-8


@leaf
def renew(evaluate, machine, history, t, share, y, rate):
    """matrix := factors of 1 - share ∂f/∂y at y, where rate = f(t, y); `scratch` is work. Returns a status."""
    run = run_at(history)
    matrix = run.matrix
    n = y.shape[0]
    matrix[:, :] = 0.0
    # nothing depends on the two energies at the end of y
    for j in range(n - 2):
        value = y[j]
        y[j] += DIFFERENCE * max(run.scale[j], np.abs(value))
        width = y[j] - value
        status = call_evaluate(evaluate, machine, t, y, run.scratch)
        run.counter[EVALUATIONS] += 1
        y[j] = value
        if status != OK:
            return status
        for i in range(n):
            matrix[i, j] = share * (rate[i] - run.scratch[i]) / width
    for i in range(n):
        matrix[i, i] += 1.0
    return OK if factorise_lu(matrix, run.pivot) else NOT_CONVERGED


@leaf
def newton(evaluate, machine, history, t, share):
    """y := the solution of y = stages[KNOWN] + share f(t, y) next to y. Returns a status."""
    run = run_at(history)
    y, known, rate, predicted = run.y, run.stages[KNOWN], run.stages[RATE], run.stages[PREDICTED]
    n = y.shape[0]
    for i in range(n):
        predicted[i] = y[i]
    stale, own, last = run.numbers[SHARE] != share, False, np.inf
    for _ in range(run.counter[MOST_ITERATIONS]):
        status = call_evaluate(evaluate, machine, t, y, rate)
        run.counter[EVALUATIONS] += 1
        run.counter[ITERATIONS] += 1
        if status == OK and stale:
            status = renew(evaluate, machine, history, t, share, y, rate)
            run.numbers[SHARE] = share
            stale, own, last = False, True, np.inf
        if status != OK:
            run.numbers[SHARE] = 0.0
            return status
        for i in range(n):
            rate[i] = known[i] + share * rate[i] - y[i]
        solve_lu(run.matrix, run.pivot, rate)
        change = 0.0
        for i in range(n):
            y[i] += rate[i]
            change = larger(change, rate[i], max(run.scale[i], np.abs(y[i])))
            if is_whole(machine):
                change = larger(change, steepest(rate[i]), max(run.scale[i], np.abs(y[i])))
        if change <= run.clock[CORRECTOR_TOLERANCE]:
            return OK
        if not change <= SLOW * last:
            stale = True
            if not own:
                for i in range(n):
                    y[i] = predicted[i]
        last = change
    run.numbers[SHARE] = 0.0
    return NOT_CONVERGED


# The start of implicit multistep methods: with functional iteration as that of explicit ones; with Newton's the step may be far beyond
# what an explicit method stands, and the start is a diagonally implicit Runge–Kutta method of order 4, L-stable.
#
# Coefficients: Hairer, Wanner 1996, table IV.6.5. All stages share γ = 1/4, hence one matrix; the last one is the new state.

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
