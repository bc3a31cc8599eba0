"""The embedded pair of orders 5 and 4 of Dormand & Prince (1980), with dense output of order 4.

Coefficients: Hairer, Nørsett, Wanner 1993, table II.5.2; dense output: the weights of eq. II.6.12 in the form of its code. Steps are
controlled by the difference of the two results, and the better one is kept.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.explicit.embedded import evaluate_stages, fill_cubic, sum_stages, take_step
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.dense import wanted
from nivel.integrate.loop.run import DENSE, POWERS, STEP_SIGNATURE, run_at
from nivel.integrate.loop.step_control import size
from nivel.kernels.core.status import OK
from nivel.native.entry import entry
from nivel.native.function import leaf

STAGES = 7
ORDER = 5.0  # of the error of one step with its estimate
SHARE = 0.1

C = np.array([0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1, 1])
A = np.array(
    [
        [0, 0, 0, 0, 0, 0],
        [1 / 5, 0, 0, 0, 0, 0],
        [3 / 40, 9 / 40, 0, 0, 0, 0],
        [44 / 45, -56 / 15, 32 / 9, 0, 0, 0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0, 0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0],
        [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
# result of order 5 minus that of order 4
E = np.array([71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
# the fourth row of the dense output
D = np.array(
    [
        -12715105075 / 11282082432,
        0,
        87487479700 / 32700410799,
        -10690763975 / 1880347072,
        701980252875 / 199316789632,
        -1453857185 / 822651844,
        69997945 / 29380423,
    ]
)


@leaf
def _attempt(evaluate, machine, history, h):
    run = run_at(history)
    status = evaluate_stages(evaluate, machine, history, h, A, C, 1, STAGES)
    if status != OK:
        return status, 0.0
    sum_stages(run, h, E, STAGES, run.scratch)
    return OK, size(run, run.scratch)


@leaf
def _fill_dense(run, h):
    fill_cubic(run, h, STAGES - 1)
    sum_stages(run, h, D, STAGES, run.dense[3])
    run.counter[DENSE], run.counter[POWERS] = 4, 0


@entry(STEP_SIGNATURE)
def dopri5(evaluate, machine, history):
    """One accepted step."""
    run = run_at(history)
    status, h = take_step(evaluate, machine, history, ORDER, SHARE, _attempt)
    if h > 0.0 and wanted(run):
        _fill_dense(run, h)
    return status


FACTS = (IntegratorFacts("dopri5", dopri5, order=5, stages=STAGES, numbers=2),)
