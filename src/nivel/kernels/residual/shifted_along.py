"""Linear equations (1 - s ∂f/∂y) x = r of the equations of motion as ẏ = f(t, y), without ever forming ∂f/∂y.

f comes from M v̇ + C_qᵀ λ = Q and C̈ = 0, so the change of v̇ by a change of y follows from their derivatives. With Δv = r_v + s Δv̇ and
Δq = r_q + s Δv that is the sparse system of `nivel.kernels.residual.tangent` for cq = s², cv = cx = s:

    [M + s D + s² K, C_qᵀ; ∂C̈/∂v̇, 0] [Δv̇; Δλ] = -(what the residual changes by along q: r_q + s r_v, v: r_v, x: r_x)

whose right-hand side is one evaluation on dual numbers, with the time moved too where its part of f is wanted. The turning of a body's
axes by its own angular velocity within s, and the energies at the end of y, on which nothing depends, are left out: this is for
iterations, and for methods that keep their order with any matrix.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rotation import angular_velocity, rates_of_parameters
from nivel.kernels.algebra.rows import advance, clear, copy
from nivel.kernels.core.lanes import is_whole, slope, unit
from nivel.kernels.core.number import number_of
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_family, call_hook
from nivel.kernels.record.record import NONE, RESIDUAL, record_at
from nivel.kernels.residual.residual import known_multiplier
from nivel.kernels.residual.tangent import ACCELERATIONS, differentiate, load_twin
from nivel.kernels.solve.newton_matrix import factorise, solve
from nivel.native.function import leaf


@leaf
def return_to(machine, y, rate):
    """The state y with the result `rate`, and the multipliers in newton.lam, in `residual`: an evaluation elsewhere may have left it."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    n = residual.vdot.shape[0]
    positions = np.int64(y.shape[0]) - n - newton.state.shape[0] - 2
    copy(y, residual.y)
    for k in range(n):
        residual.vdot[k] = rate[positions + k]
    copy(newton.lam, residual.lam)


@leaf
def prepare_shifted(machine, t, y, rate, s):
    """Factors for the state y, last evaluated with the result `rate`. Returns a status."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    clear(newton.change)
    for k in range(residual.lam.shape[0]):
        newton.lam[k] = known_multiplier(record, k)
    return_to(machine, y, rate)
    status = differentiate(machine, t, s * s, s, s, ACCELERATIONS)
    return factorise(machine) if status == OK else status


@leaf
def part_of(x, slopes):
    """The value of x as the slope along direction 0; or its slopes alone, along the directions that they have."""
    return x - real(x) if slopes else unit(0, real(x))


@leaf
def move_along(newton, residual, moving, r, s, slopes):
    """Move the twin's state along the direction that r asks for before the accelerations change, or along those that its `slopes` ask for.
    Leaves rotations in newton.moved."""
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(r.shape[0]) - n - states - 2
    moved = newton.moved
    for k in range(n):
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        moving.y[positions + k] += part_of(r[positions + k], slopes)
        if axis == NONE:
            moving.y[p] += part_of(r[p] + s * r[positions + k], slopes)
        elif axis == 0:
            turn = moved[k : k + 3]
            angular_velocity(residual.y[p : p + 4], r[p : p + 4], turn)
            for i in range(3):
                turn[i] += s * r[positions + k + i]
            change = newton.last[0:4]
            rates_of_parameters(residual.y[p : p + 4], turn, change)
            for i in range(4):
                moving.y[p + i] += part_of(change[i], slopes)
    for k in range(states):
        moving.y[positions + n + k] += part_of(r[positions + n + k], slopes)


@leaf
def add_slopes(machine, t, r, s):
    """Add to newton.b, the right-hand side for the value of r, what its slopes ask for: all of them in one evaluation. Returns a status."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    twin, moving = load_twin(machine)
    n, states, rows = residual.vdot.shape[0], newton.state.shape[0], residual.lam.shape[0]
    move_along(newton, residual, moving, r, s, True)
    status = call_family(newton.address[1], twin, 0, t)
    for k in range(n):
        newton.b[k] -= number_of(machine, moving.value[k] - real(moving.value[k]))
    for k in range(n, n + states):
        newton.b[k] += number_of(machine, moving.value[k] - real(moving.value[k]))
    for k in range(n + states, n + states + rows):
        row = k + 2 * rows
        newton.b[k] -= number_of(machine, moving.value[row] - real(moving.value[row]))
    return status


@leaf
def solve_shifted(machine, t, r, s, ahead):
    """Overwrite r (ny,) with x, the solution of (1 - s ∂f/∂y) x = r + s ahead ∂f/∂t. Returns a status."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    twin, moving = load_twin(machine)
    n, states, rows = residual.vdot.shape[0], newton.state.shape[0], residual.lam.shape[0]
    positions = np.int64(r.shape[0]) - n - states - 2
    move_along(newton, residual, moving, r, s, False)
    status = call_family(newton.address[1], twin, 0, t + unit(0, ahead))
    if status != OK:
        return status
    b = newton.b
    for k in range(n):
        b[k] = -slope(moving.value[k], 0)
    for k in range(states):
        b[n + k] = slope(moving.value[n + k], 0)
    for k in range(rows):
        b[n + states + k] = -slope(moving.value[n + states + 2 * rows + k], 0)
    if is_whole(machine):
        status = add_slopes(machine, t, r, s)
        if status != OK:
            return status
    solve(machine)
    for k in range(n + states):
        r[positions + k] += s * b[k]
    for k in range(n):
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        if axis == NONE:
            r[p] += s * r[positions + k]
        elif axis == 0:
            change = newton.last[0:4]
            rates_of_parameters(residual.y[p : p + 4], r[positions + k : positions + k + 3], change)
            for i in range(4):
                r[p + i] += s * change[i]
    return OK


# Slopes of the solutions of (1 - s ∂f/∂y) x = r for what ∂f/∂y itself changes by: on records of which all numbers are dual.
#
# `solve_shifted` finds x with the slopes of r. The equation says that the residual does not change to first order
# along x, with the accelerations and multipliers that go with it; so the slopes of
#
#     (R(y + ε x) - R(y - ε x))/2 ε
#
# are what the slopes of x miss, and change them by the factors there are. Of the difference only slopes count, those of a smooth function:
# with ε x a share FAR of the scales they are known to ten digits.

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
    copy(residual.y, work[Y])
    copy(residual.vdot, work[VDOT])
    for k in range(n):
        work[FOUND, k], work[MISSED, k] = newton.b[k], 0.0
    for k in range(min(residual.lam.shape[0], most)):
        work[LAM, k], work[FOUND_LAM, k], work[MISSED_LAM, k] = residual.lam[k], newton.b[n + k], 0.0


@leaf
def bring_back(residual, work):
    """The state is what it was."""
    copy(work[Y], residual.y)
    copy(work[VDOT], residual.vdot)
    copy(work[LAM], residual.lam)


@leaf
def move_far_along(newton, residual, work, r, s, far):
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
    advance(work[LAM], far, work[FOUND_LAM], residual.lam)


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
        move_far_along(newton, residual, work, r, s, sign * far)
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
