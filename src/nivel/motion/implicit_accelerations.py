"""Equations of motion of machines with beams of consistent mass, in any coordinates that have a residual: see
`nivel.kernels.residual.balance`."""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.record.record import CORRECT, EVALUATE, record_at
from nivel.kernels.residual.balance import balance, write_balanced_rates
from nivel.native.entry import entry
from nivel.native.function import stage


@stage
def normalise(machine, y):
    """θ := θ/|θ| for all Euler parameters."""
    newton = record_at(machine).newton
    for k in range(newton.place.shape[0]):
        if newton.place[k, 1] == 0:
            p = np.int64(newton.place[k, 0])
            square = y[p] * y[p] + y[p + 1] * y[p + 1] + y[p + 2] * y[p + 2] + y[p + 3] * y[p + 3]
            for i in range(4):
                y[p + i] /= np.sqrt(square)


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (q, v, x). Leaves everything else in the record."""
    status = balance(machine, t, y)
    if status == OK:
        write_balanced_rates(machine, y, ydot)
    tree = record_at(machine).tree
    for k in range(tree.state.shape[0]):
        tree.state[k] = y[k]
    return status


@entry(CORRECT)
def normalise_state(machine, t, y):
    """No correction; Euler parameters are brought back to length one, which moves nothing."""
    normalise(machine, y)
    return OK
