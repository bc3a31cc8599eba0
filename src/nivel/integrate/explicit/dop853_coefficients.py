"""Coefficients of the method of order 8 of Dormand & Prince with error estimates of orders 5 and 3 and a dense output of order 7.

Numbers: Hairer, Nørsett, Wanner 1993, §II.5 and §II.6, to the 20 digits of their code DOP853; they stand in `dop853_coefficients.txt`. Each
stage k_s is given by the weights of the stages before it; stage 12 is at the new state, so its weights are those of the result, and stages
13 to 15 serve the dense output only. The tests hold all of them against the conditions of their orders.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

STAGES, ALL_STAGES, DENSE = 13, 16, 7

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
