"""Slopes of the corrections of positions of index 2 by what Newton's matrix changes by, on records of which all numbers are dual.

A correction x is one along the matrix A: A x = (0, ρ), with ρ such that the constraints are closed. A is that of a state a few steps ago,
and depends on the parameters as that state does. Differentiated: A δx = (0, δρ) - δA x. Newton's passes for slopes find the first part;
the second, δA x, is the mixed derivative of the residual along x and the parameters, at the state where A was made:

    δ(R(u + ε x) - R(u - ε x))/2 ε
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rotation import rates_of_parameters
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import NONE, RESIDUAL, record_at
from nivel.kernels.residual.tangent import inverse_tangent
from nivel.kernels.solve.newton_matrix import solve
from nivel.native.function import leaf

# the largest share of a scale that a difference moves an entry by; corrections below the second share have no slopes worth the difference
FAR, NOTHING = 1e-4, 1e-14
# Rows of run.stages: y, accelerations and multipliers where the matrix was made; the correction, its multipliers; accelerations and
# multipliers now; δA x. Entry of run.numbers: the time where the matrix was made.
Y, VDOT, LAM, MOVED, MOVED_LAM, KEPT_VDOT, KEPT_LAM, MISSED = 12, 13, 14, 15, 16, 17, 18, 19
# turns within the step where the matrix was made
CHANGE = 20
ROWS = 21
MADE_AT = 14
NUMBERS = 15


@leaf
def forget_moved(run):
    """No correction yet."""
    for i in range(run.y.shape[0]):
        run.stages[MOVED, i], run.stages[MOVED_LAM, i] = 0.0, 0.0


@leaf
def copy_unknowns(residual, run, vdot, lam):
    """Accelerations and multipliers into two rows; of multipliers as many as have room."""
    for k in range(residual.vdot.shape[0]):
        run.stages[vdot, k] = residual.vdot[k]
    for k in range(min(residual.lam.shape[0], run.y.shape[0])):
        run.stages[lam, k] = residual.lam[k]


@leaf
def keep_made_at(machine, run, t):
    """The matrix is made at the state in `residual`, at time t."""
    newton, residual = record_at(machine).newton, record_at(machine).residual
    for i in range(run.y.shape[0]):
        run.stages[Y, i] = residual.y[i]
    for k in range(residual.vdot.shape[0]):
        run.stages[CHANGE, k] = newton.change[k]
    copy_unknowns(residual, run, VDOT, LAM)
    run.numbers[MADE_AT] = t


@leaf
def add_moved(machine, run):
    """Add the change of positions in newton.last to the correction of the step."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    n = residual.vdot.shape[0] + newton.state.shape[0]
    if residual.row.shape[0] > 0:
        for k in range(n):
            run.stages[MOVED, k] += newton.last[k]
        for k in range(min(residual.lam.shape[0], run.y.shape[0])):
            run.stages[MOVED_LAM, k] += newton.last[n + k]


@leaf
def size_of_moved(newton, run, cq, cv):
    """Largest change by the correction, taken for one of accelerations, as a share of the scales."""
    n = np.int64(newton.place.shape[0])
    positions = np.int64(run.y.shape[0]) - n - newton.state.shape[0] - 2
    largest = 0.0
    for k in range(n):
        x = np.abs(real(run.stages[MOVED, k]))
        at = newton.place[k, 0]
        largest = max(largest, real(cq) * x / real(run.scale[at]), real(cv) * x / real(run.scale[positions + k]))
    return largest


@leaf
def move_made_at(newton, residual, run, cq, cv, cx, far):
    """The state where the matrix was made, moved `far` along the correction."""
    n, states, stages = residual.vdot.shape[0], newton.state.shape[0], run.stages
    positions = np.int64(run.y.shape[0]) - n - states - 2
    y, x = residual.y, stages[MOVED]
    for i in range(y.shape[0]):
        y[i] = stages[Y, i]
    for k in range(n):
        along = far * real(x[k])
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        if axis == NONE:
            y[p] += cq * along
            y[positions + k] += cv * along
            residual.vdot[k] = stages[VDOT, k] + along
        elif axis == 0:
            w = (along, far * real(x[k + 1]), far * real(x[k + 2]))
            change = newton.last[0:4]
            rates_of_parameters(stages[Y, p : p + 4], w, change)
            for i in range(4):
                y[p + i] += cq * change[i]
            turned = inverse_tangent(stages[CHANGE, k : k + 3], w)
            for i in range(3):
                y[positions + k + i] += cv * turned[i]
                residual.vdot[k + i] = stages[VDOT, k + i] + turned[i]
    for k in range(n, n + states):
        y[positions + k] += cx * (far * real(x[k]))
    for k in range(min(residual.lam.shape[0], run.y.shape[0])):
        residual.lam[k] = stages[LAM, k] + far * real(stages[MOVED_LAM, k])


@leaf
def load_missed(newton, run, n):
    """newton.b := -δA x, in the rows of the equations of motion and of states of forces."""
    newton.b[:] = 0.0
    for k in range(n + newton.state.shape[0]):
        missed = run.stages[MISSED, k]
        newton.b[k] = real(missed) - missed if k < n else missed - real(missed)


@leaf
def settle_correction(machine, run, cq, cv, cx):
    """Add to newton.correction the slopes by δA; it is for further passes then to close the constraints. Returns a status."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    size = size_of_moved(newton, run, cq, cv)
    if residual.row.shape[0] == 0 or not size > NOTHING:
        return OK
    far, status = FAR / size, OK
    copy_unknowns(residual, run, KEPT_VDOT, KEPT_LAM)
    for k in range(n + states):
        run.stages[MISSED, k] = 0.0
    for sign in (1.0, -1.0):
        move_made_at(newton, residual, run, cq, cv, cx, sign * far)
        if status == OK:
            status = call_hook(machine, RESIDUAL, 0, run.numbers[MADE_AT])
        for k in range(n + states):
            run.stages[MISSED, k] += sign / (2.0 * far) * residual.value[k]
    for k in range(n):
        residual.vdot[k] = run.stages[KEPT_VDOT, k]
    for k in range(min(residual.lam.shape[0], run.y.shape[0])):
        residual.lam[k] = run.stages[KEPT_LAM, k]
    if status != OK:
        return status
    load_missed(newton, run, n)
    solve(machine)
    for k in range(n):
        if newton.place[k, 1] == 0:
            newton.b[k], newton.b[k + 1], newton.b[k + 2] = inverse_tangent(
                newton.change[k : k + 3], (newton.b[k], newton.b[k + 1], newton.b[k + 2])
            )
    for k in range(n):
        newton.correction[k] += newton.b[k]
    return OK
