"""The method of order 8 of Dormand & Prince with error estimates of orders 5 and 3 and a dense output of order 7.

Hairer, Nørsett, Wanner 1993, §II.5, §II.6. Twelve evaluations a step, and four more where a frame or an event is looked for inside it.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.explicit.dop853_coefficients import ALL_STAGES, E3, E5, STAGES, A, C, D
from nivel.integrate.explicit.embedded import add_stages, evaluate_stages, fill_cubic, sum_stages, take_step
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.dense import wanted
from nivel.integrate.loop.run import DENSE, POWERS, STEP_SIGNATURE, run_at
from nivel.integrate.loop.step_control import size
from nivel.kernels.core.status import OK
from nivel.native.entry import entry
from nivel.native.function import leaf

ORDER = 8.0  # of the error of one step with its estimate
SHARE = 0.3
NEW = STAGES - 1  # the stage at the new state


@leaf
def _attempt(evaluate, machine, history, h):
    run = run_at(history)
    status = evaluate_stages(evaluate, machine, history, h, A, C, 1, NEW)
    if status != OK:
        return status, 0.0
    sum_stages(run, h, E3, NEW, run.scratch)
    third = size(run, run.scratch)
    sum_stages(run, h, E5, NEW, run.scratch)
    fifth = size(run, run.scratch)
    for i in range(run.y.shape[0]):
        run.trial[i] = run.previous[i]
    add_stages(run, h, A[NEW], NEW, run.trial)
    # the two estimates, h⁶ and h⁴, together behave as h⁸ (§II.10, eq. 10.17)
    # no squares: those of errors below 1e-162 are zero, and their ratio no number
    return OK, 0.0 if fifth == 0.0 else fifth * (fifth / np.hypot(fifth, 0.1 * third))


@leaf
def _fill_dense(evaluate, machine, history, h):
    run = run_at(history)
    status = evaluate_stages(evaluate, machine, history, h, A, C, NEW, ALL_STAGES)
    if status != OK:
        return status
    fill_cubic(run, h, NEW)
    for k in range(D.shape[0]):
        sum_stages(run, h, D[k], ALL_STAGES, run.dense[3 + k])
    run.counter[DENSE], run.counter[POWERS] = 3 + D.shape[0], 0
    return OK


@entry(STEP_SIGNATURE)
def dop853(evaluate, machine, history):
    """One accepted step."""
    run = run_at(history)
    status, h = take_step(evaluate, machine, history, ORDER, SHARE, _attempt)
    if h > 0.0 and wanted(run):
        status = _fill_dense(evaluate, machine, history, h)
    return status


FACTS = (IntegratorFacts("dop853", dop853, order=8, stages=ALL_STAGES, numbers=2),)
