"""Slopes of the corrections of positions of index 2 by what Newton's matrix changes by, on records of which all numbers are dual.

A correction x is one along the matrix A: A x = (0, ρ), with ρ such that the constraints are closed. A is that of a state a few steps ago,
and depends on the parameters as that state does. Differentiated: A δx = (0, δρ) - δA x. Newton's passes for slopes find the first part;
the second, δA x, is the mixed derivative of the residual along x and the parameters, at the state where A was made:

    δ(R(u + ε x) - R(u - ε x))/2 ε

It is linear in x, and corrections of steps with the same matrix have nearly the same directions. So δA is kept along those that were met,
an orthonormal set of a few, and two evaluations are made only for what of x is across all of them. What is negligible of that waits for
the next step.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rotation import rates_of_parameters
from nivel.kernels.algebra.rows import add, copy
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import NONE, RESIDUAL, record_at
from nivel.kernels.residual.tangent import inverse_tangent
from nivel.kernels.solve.newton_matrix import solve
from nivel.native.function import leaf

# the largest share of a scale that a difference moves an entry by; corrections below the second share have no slopes worth the difference
FAR, NOTHING = 1e-4, 1e-14
# Below this share of the scales what is across the directions known waits.
NEGLIGIBLE = 1e-10
# Rows of run.stages: y, accelerations and multipliers where the matrix was made; the correction, its multipliers; accelerations and
# multipliers now; δA x. Entries of run.numbers: the time where the matrix was made, its coefficients; how many directions are known.
Y, VDOT, LAM, MOVED, MOVED_LAM, KEPT_VDOT, KEPT_LAM, MISSED = 12, 13, 14, 15, 16, 17, 18, 19
# turns within the step where the matrix was made; what waits of corrections, its multipliers
CHANGE, REST, REST_LAM = 20, 21, 22
# directions x, of length 1 as shares of the scales of positions; their multipliers; δA along them
DIRECTIONS = 6
DIRECTION = 23
DIRECTION_LAM = DIRECTION + DIRECTIONS
ALONG = DIRECTION_LAM + DIRECTIONS
ROWS = ALONG + DIRECTIONS
MADE_AT, MADE_CQ, MADE_CV, MADE_CX, KNOWN = 14, 15, 16, 17, 18
NUMBERS = 19


@leaf
def begin_moved(run):
    """The correction of a step begins with what waits."""
    for i in range(run.y.shape[0]):
        run.stages[MOVED, i], run.stages[MOVED_LAM, i] = run.stages[REST, i], run.stages[REST_LAM, i]


@leaf
def forget_moved(run):
    """No correction yet."""
    for i in range(run.y.shape[0]):
        run.stages[MOVED, i], run.stages[MOVED_LAM, i] = 0.0, 0.0
        run.stages[REST, i], run.stages[REST_LAM, i] = 0.0, 0.0


@leaf
def copy_unknowns(residual, run, vdot, lam):
    """Accelerations and multipliers into two rows; of multipliers as many as have room."""
    copy(residual.vdot, run.stages[vdot])
    copy(residual.lam, run.stages[lam])


@leaf
def keep_made_at(machine, run, t, cq, cv, cx):
    """The matrix is made at the state in `residual`, at time t, with these coefficients."""
    newton, residual = record_at(machine).newton, record_at(machine).residual
    copy(residual.y, run.stages[Y])
    copy(newton.change, run.stages[CHANGE])
    copy_unknowns(residual, run, VDOT, LAM)
    c = run.numbers
    c[MADE_AT], c[MADE_CQ], c[MADE_CV], c[MADE_CX], c[KNOWN] = t, cq, cv, cx, 0.0


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
    copy(stages[Y], y)
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
def product(newton, run, row, other):
    """Of two rows of corrections, as shares of the scales of positions."""
    total = 0.0
    for k in range(newton.place.shape[0]):
        scale = real(run.scale[newton.place[k, 0]])
        total += real(run.stages[row, k]) * real(run.stages[other, k]) / (scale * scale)
    return total


@leaf
def use_directions(newton, run, multipliers):
    """MISSED := δA x as far as the directions known say it; they are taken out of the correction and its `multipliers`."""
    n, stages = newton.place.shape[0] + newton.state.shape[0], run.stages
    for i in range(n):
        stages[MISSED, i] = 0.0
    for d in range(np.int64(run.numbers[KNOWN])):
        share = product(newton, run, MOVED, DIRECTION + d)
        for i in range(n):
            stages[MOVED, i] = real(stages[MOVED, i]) - share * real(stages[DIRECTION + d, i])
            stages[MISSED, i] += share * stages[ALONG + d, i]
        for i in range(multipliers):
            stages[MOVED_LAM, i] = real(stages[MOVED_LAM, i]) - share * real(stages[DIRECTION_LAM + d, i])


@leaf
def find_along(machine, run, row):
    """Row := δA x for the correction there is. Returns a status; overwrites `residual`."""
    record, c = record_at(machine), run.numbers
    newton, residual = record.newton, record.residual
    n = residual.vdot.shape[0] + newton.state.shape[0]
    cq, cv, cx = c[MADE_CQ], c[MADE_CV], c[MADE_CX]
    far, status = FAR / size_of_moved(newton, run, cq, cv), OK
    for k in range(n):
        run.stages[row, k] = 0.0
    for sign in (1.0, -1.0):
        move_made_at(newton, residual, run, cq, cv, cx, sign * far)
        if status == OK:
            status = call_hook(machine, RESIDUAL, 0, c[MADE_AT])
        for k in range(n):
            run.stages[row, k] += sign / (2.0 * far) * residual.value[k]
    return status


@leaf
def learn_direction(machine, run, size):
    """Add δA of the correction, whose length is `size`, to MISSED, and its direction to those known. Returns a status."""
    at = min(np.int64(run.numbers[KNOWN]), DIRECTIONS - 1)
    status = find_along(machine, run, ALONG + at)
    for i in range(run.y.shape[0]):
        run.stages[MISSED, i] += run.stages[ALONG + at, i]
        run.stages[DIRECTION + at, i] = run.stages[MOVED, i] / size
        run.stages[DIRECTION_LAM + at, i] = run.stages[MOVED_LAM, i] / size
        run.stages[ALONG + at, i] /= size
    run.numbers[KNOWN] = at + 1.0
    return status


@leaf
def settle_correction(machine, run, waits):
    """Add to newton.correction the slopes by δA; it is for further passes then to close the constraints. waits : whether what is
    negligible may wait. Returns a status."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    n, multipliers, status = residual.vdot.shape[0], min(residual.lam.shape[0], run.y.shape[0]), OK
    if residual.row.shape[0] == 0:
        return OK
    use_directions(newton, run, multipliers)
    size = np.sqrt(product(newton, run, MOVED, MOVED))
    if size > (NEGLIGIBLE if waits else NOTHING):
        copy_unknowns(residual, run, KEPT_VDOT, KEPT_LAM)
        status = learn_direction(machine, run, size)
        copy(run.stages[KEPT_VDOT], residual.vdot)
        copy(run.stages[KEPT_LAM], residual.lam)
        forget_moved(run)
    for i in range(run.y.shape[0]):
        run.stages[REST, i], run.stages[REST_LAM, i] = run.stages[MOVED, i], run.stages[MOVED_LAM, i]
    if status != OK:
        return status
    load_missed(newton, run, n)
    solve(machine)
    for k in range(n):
        if newton.place[k, 1] == 0:
            newton.b[k], newton.b[k + 1], newton.b[k + 2] = inverse_tangent(
                newton.change[k : k + 3], (newton.b[k], newton.b[k + 1], newton.b[k + 2])
            )
    add(newton.b, newton.correction)
    return OK
