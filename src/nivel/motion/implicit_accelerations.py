"""Equations of motion of machines with beams of consistent mass, in any coordinates that have a residual: see
`nivel.kernels.residual.balance`."""

import numpy as np

from nivel.kernels.algebra.rotation import rates_of_parameters
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import CORRECT, EVALUATE, NONE, RESIDUAL, record_at
from nivel.kernels.residual.balance import balance, find_matrix, write_balanced_rates
from nivel.kernels.solve.newton_matrix import solve_entries
from nivel.motion.direct import LOST, MOST_CORRECTIONS, NOTHING, POSITIONS, VELOCITIES, name_lost, open_level
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
    copy(y, tree.state)
    return status


@entry(CORRECT)
def normalise_state(machine, t, y):
    """No correction; Euler parameters are brought back to length one, which moves nothing."""
    normalise(machine, y)
    return OK


# Direct correction of states whose accelerations are found by the residual (report 44, §5.5), for machines that no recursion factorises.
# Changes are least in the mass metric, by the matrix [M, C_qᵀ; C_q, 0] of the accelerations (`nivel.kernels.residual.balance`).


@stage
def find_change(machine, violation):
    """The change of velocities, or of positions, that removes a violation (K,) of the linearised rows, in `newton.balance.b`."""
    record = record_at(machine)
    newton, own = record.newton, record.residual
    f = newton.balance
    first = own.vdot.shape[0] + newton.state.shape[0]
    for i in range(first):
        f.b[i] = 0.0
    for k in range(own.row.shape[0]):
        f.b[first + k] = -violation[own.row[k]]
    solve_entries(newton, f)


@stage
def move_positions(newton, y, change, theta):
    """Positions after a small change; theta (4,) is work."""
    for k in range(newton.place.shape[0]):
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        if axis == NONE:
            y[p] += change[k]
        elif axis == 0:
            rates_of_parameters(y[p : p + 4], change[k : k + 3], theta)
            for i in range(4):
                y[p + i] += theta[i]


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints: positions (eq. 127), then velocities (eq. 137)."""
    record = record_at(machine)
    newton, own, saddle, constraints = record.newton, record.residual, record.saddle, record.constraints
    n = own.vdot.shape[0]
    positions = np.int64(y.shape[0]) - n - newton.state.shape[0] - 2
    normalise(machine, y)
    if saddle.row.shape[0] == 0:
        return OK
    factorised = False
    for attempt in range(MOST_CORRECTIONS + 1):
        copy(y, own.y)
        status = call_hook(machine, RESIDUAL, 0, t)
        if status != OK:
            return status
        what = open_level(machine, attempt)
        if what == NOTHING:
            return OK
        if what == LOST:
            return name_lost(machine)
        if not factorised:
            status = find_matrix(machine, t)
            if status != OK:
                return status
            newton.balanced[0], factorised = 1.0, True
        find_change(machine, constraints.C if what == POSITIONS else constraints.Cdot)
        if what == VELOCITIES:
            for k in range(n):
                y[positions + k] += newton.balance.b[k]
            return OK
        move_positions(newton, y, newton.balance.b, newton.last)
        normalise(machine, y)
    return OK
