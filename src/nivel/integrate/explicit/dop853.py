"""The method of order 8 of Dormand & Prince with error estimates of orders 5 and 3 and a dense output of order 7.

Hairer, Nørsett, Wanner 1993, §II.5, §II.6. Twelve evaluations a step, and four more where a frame or an event is looked for inside it.
"""

from pathlib import Path

import numpy as np

from nivel.integrate.explicit.embedded import evaluate_stages, take_step
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.dense import cubic, wanted
from nivel.integrate.loop.run import DENSE, POWERS, STEP_SIGNATURE, add_rows, run_at, sum_rows
from nivel.integrate.loop.step_control import size
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.status import OK
from nivel.native.entry import entry
from nivel.native.function import leaf

# Coefficients of the method of order 8 of Dormand & Prince with error estimates of orders 5 and 3 and a dense output of order 7.
#
# Numbers: Hairer, Nørsett, Wanner 1993, §II.5 and §II.6, to the 20 digits of their code DOP853; they stand in `dop853.txt`. Each
# stage k_s is given by the weights of the stages before it; stage 12 is at the new state, so its weights are those of the result, and
# stages 13 to 15 serve the dense output only. The tests hold all of them against the conditions of their orders.

STAGES, ALL_STAGES = 13, 16

_NODES = {
    5: 1 / 3,
    6: 1 / 4,
    7: 4 / 13,
    8: 127 / 195,
    9: 3 / 5,
    10: 6 / 7,
    11: 1,
    12: 1,
    13: 1 / 10,
    14: 1 / 5,
    15: 7 / 9,
}
_LINES = Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").splitlines()


def _table(what, rows, columns):
    table = np.zeros((rows, columns))
    for name, row, stage, weight in map(str.split, _LINES[2:]):
        if name == what:
            table[int(row), int(stage)] = float(weight)
    return table


A = _table("stage", ALL_STAGES, ALL_STAGES)
C = A.sum(axis=1)
for _stage, _node in _NODES.items():
    C[_stage] = _node
B = A[12, :STAGES].copy()
E5 = _table("fifth", 1, STAGES)[0]
E3 = B - _table("third", 1, STAGES)[0]  # of a result of order 3 from stages 0, 8 and 11
D = _table("dense", 4, ALL_STAGES)


ORDER = 8.0  # of the error of one step with its estimate
SHARE = 0.3
NEW = STAGES - 1  # the stage at the new state


@leaf
def _attempt(evaluate, machine, history, h):
    run = run_at(history)
    status = evaluate_stages(evaluate, machine, history, h, A, C, 1, NEW)
    if status != OK:
        return status, 0.0
    sum_rows(run.stages, h, E3, NEW, run.scratch)
    third = size(run, run.scratch)
    sum_rows(run.stages, h, E5, NEW, run.scratch)
    fifth = size(run, run.scratch)
    copy(run.previous, run.trial)
    add_rows(run.stages, h, A[NEW], NEW, run.trial)
    # the two estimates, h⁶ and h⁴, together behave as h⁸ (§II.10, eq. 10.17)
    # no squares: those of errors below 1e-162 are zero, and their ratio no number
    return OK, 0.0 if fifth == 0.0 else fifth * (fifth / np.hypot(fifth, 0.1 * third))


@leaf
def _fill_dense(evaluate, machine, history, h):
    run = run_at(history)
    status = evaluate_stages(evaluate, machine, history, h, A, C, NEW, ALL_STAGES)
    if status != OK:
        return status
    cubic(run, h, run.stages[0], run.stages[NEW])
    for k in range(D.shape[0]):
        sum_rows(run.stages, h, D[k], ALL_STAGES, run.dense[3 + k])
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
