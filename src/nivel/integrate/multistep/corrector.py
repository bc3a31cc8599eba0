"""Implicit equations y = known + share f(t, y) of one step, solved by functional iteration or by Newton's
(`nivel.integrate.multistep.newton`).

Either starts from the prediction in run.y and ends when no entry of y changes by more than clock[CORRECTOR_TOLERANCE] of its largest
value so far (or of the scale of such entries, where that is larger), after at most counter[MOST_ITERATIONS] evaluations. Slopes, where
there are any, count as values.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop.run import CORRECTOR_TOLERANCE, EVALUATIONS, ITERATIONS, MOST_ITERATIONS, NEWTON, run_at
from nivel.integrate.loop.workspace import KNOWN, RATE, larger
from nivel.integrate.multistep.newton import newton
from nivel.kernels.core.lanes import is_whole, steepest
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.kernels.record.hook import call_evaluate
from nivel.native.function import leaf

# A change this many times the first one grows without bound.
DIVERGED = 1e3


@leaf
def solve(evaluate, machine, history, t, share):
    """y := the solution of y = stages[KNOWN] + share f(t, y) next to y. Returns a status."""
    run = run_at(history)
    for i in range(run.y.shape[0]):
        run.scale[i] = max(run.scale[i], np.abs(run.previous[i]))
    if run.counter[NEWTON] == 1:
        return newton(evaluate, machine, history, t, share)
    return functional(evaluate, machine, history, t, share)


@leaf
def functional(evaluate, machine, history, t, share):
    """y := known + share f(t, y), again and again: it contracts where share ‖∂f/∂y‖ < 1."""
    run = run_at(history)
    y, known, rate = run.y, run.stages[KNOWN], run.stages[RATE]
    first = 0.0
    for m in range(run.counter[MOST_ITERATIONS]):
        status = call_evaluate(evaluate, machine, t, y, rate)
        run.counter[EVALUATIONS] += 1
        run.counter[ITERATIONS] += 1
        if status != OK:
            return status
        change = 0.0
        for i in range(y.shape[0]):
            value = known[i] + share * rate[i]
            change = larger(change, value - y[i], max(run.scale[i], np.abs(value)))
            if is_whole(machine):
                change = larger(change, steepest(value - y[i]), max(run.scale[i], np.abs(value)))
            y[i] = value
        if change <= run.clock[CORRECTOR_TOLERANCE]:
            return OK
        if m == 0:
            first = change
        if not change <= DIVERGED * first:
            return NOT_CONVERGED
    return NOT_CONVERGED
