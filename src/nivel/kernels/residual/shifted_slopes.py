"""Slopes of the solutions of (1 - s ∂f/∂y) x = r for what ∂f/∂y itself changes by: on records of which all numbers are dual.

`nivel.kernels.residual.shifted_along` finds x with the slopes of r. The equation says that the residual does not change to first order
along x, with the accelerations and multipliers that go with it; so the slopes of

    (R(y + ε x) - R(y - ε x))/2 ε

are what the slopes of x miss, and change them by the factors there are. Of the difference only slopes count, those of a smooth function:
with ε x a share FAR of the scales they are known to ten digits.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rotation import angular_velocity, rates_of_parameters
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import NONE, RESIDUAL, record_at
from nivel.kernels.solve.newton_matrix import solve
from nivel.native.function import leaf

# the largest share of a scale that a difference moves an entry by
FAR = 1e-4
# rows of the work that `settle_solution` asks for: y, accelerations and multipliers of the state; accelerations, then multipliers, that go
# with x; what both miss
Y, VDOT, LAM, FOUND, FOUND_LAM, MISSED, MISSED_LAM = 0, 1, 2, 3, 4, 5, 6
ROWS = 7


@leaf
def keep_base(newton, residual, work):
    """The state, and the solution in newton.b, into the rows of the work, which are as long as y."""
    n, most = residual.vdot.shape[0] + newton.state.shape[0], residual.y.shape[0]
    for i in range(residual.y.shape[0]):
        work[Y, i] = residual.y[i]
    for k in range(residual.vdot.shape[0]):
        work[VDOT, k] = residual.vdot[k]
    for k in range(n):
        work[FOUND, k], work[MISSED, k] = newton.b[k], 0.0
    for k in range(min(residual.lam.shape[0], most)):
        work[LAM, k], work[FOUND_LAM, k], work[MISSED_LAM, k] = residual.lam[k], newton.b[n + k], 0.0


@leaf
def bring_back(residual, work):
    """The state is what it was."""
    for i in range(residual.y.shape[0]):
        residual.y[i] = work[Y, i]
    for k in range(residual.vdot.shape[0]):
        residual.vdot[k] = work[VDOT, k]
    for k in range(min(residual.lam.shape[0], residual.y.shape[0])):
        residual.lam[k] = work[LAM, k]


@leaf
def move_along(newton, residual, work, r, s, far):
    """The state `far` along the solution for the right-hand side r."""
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(r.shape[0]) - n - states - 2
    y, base, found = residual.y, work[Y], work[FOUND]
    for k in range(n + states):
        y[positions + k] = base[positions + k] + far * (r[positions + k] + s * found[k])
    for k in range(n):
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        residual.vdot[k] = work[VDOT, k] + far * found[k]
        if axis == NONE:
            y[p] = base[p] + far * (r[p] + s * (r[positions + k] + s * found[k]))
        elif axis == 0:
            turn, change = newton.moved[k : k + 3], newton.last[0:4]
            angular_velocity(base[p : p + 4], r[p : p + 4], turn)
            for i in range(3):
                turn[i] += s * (r[positions + k + i] + s * found[k + i])
            rates_of_parameters(base[p : p + 4], turn, change)
            for i in range(4):
                y[p + i] = base[p + i] + far * change[i]
    for k in range(min(residual.lam.shape[0], r.shape[0])):
        residual.lam[k] = work[LAM, k] + far * work[FOUND_LAM, k]


@leaf
def find_missed(machine, work, share):
    """Add `share` times the residual of the state moved to what is missed."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    n, rows = residual.vdot.shape[0] + newton.state.shape[0], residual.lam.shape[0]
    for k in range(n):
        work[MISSED, k] += share * residual.value[k]
    for k in range(min(rows, residual.y.shape[0])):
        work[MISSED_LAM, k] += share * residual.value[n + 2 * rows + k]


@leaf
def load_missed(record, work):
    """newton.b := minus the slopes of what is missed."""
    newton, residual = record.newton, record.residual
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    newton.b[:] = 0.0
    for k in range(n):
        newton.b[k] = real(work[MISSED, k]) - work[MISSED, k]
    for k in range(n, n + states):
        missed = work[MISSED, k] - work[FOUND, k]
        newton.b[k] = missed - real(missed)
    for k in range(min(residual.lam.shape[0], residual.y.shape[0])):
        missed = work[MISSED_LAM, k]
        if k < newton.compliance.shape[0]:
            missed -= record.saddle.shift[k] * work[FOUND_LAM, k]
        newton.b[n + states + k] = real(missed) - missed


@leaf
def settle_solution(machine, t, r, x, s, ahead, scale, work):
    """The slopes of x, for r before `solve_shifted` and what that left. scale : of y. work : ROWS rows as long as y. Returns a status."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(x.shape[0]) - n - states - 2
    largest = 0.0
    for i in range(x.shape[0] - 2):
        largest = max(largest, np.abs(real(x[i])) / real(scale[i]))
    far, status = FAR / max(largest, FAR), OK
    keep_base(newton, residual, work)
    for sign in (1.0, -1.0):
        move_along(newton, residual, work, r, s, sign * far)
        if status == OK:
            status = call_hook(machine, RESIDUAL, 0, t + sign * far * ahead)
        find_missed(machine, work, sign / (2.0 * far))
    bring_back(residual, work)
    if status != OK:
        return status
    load_missed(record, work)
    solve(machine)
    b = newton.b
    for k in range(n + states):
        x[positions + k] += s * b[k]
    for k in range(n):
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        if axis == NONE:
            x[p] += s * s * b[k]
        elif axis == 0:
            change = newton.last[0:4]
            rates_of_parameters(residual.y[p : p + 4], b[k : k + 3], change)
            for i in range(4):
                x[p + i] += s * s * change[i]
    return OK
