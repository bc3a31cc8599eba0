"""Linear equations (1 - s ∂f/∂y) x = r of the equations of motion as ẏ = f(t, y), without ever forming ∂f/∂y.

f comes from M v̇ + C_qᵀ λ = Q and C̈ = 0, so the change of v̇ by a change of y follows from their derivatives. With Δv = r_v + s Δv̇ and
Δq = r_q + s Δv that is the sparse system of `nivel.kernels.residual.tangent` for cq = s², cv = cx = s:

    [M + s D + s² K, C_qᵀ; ∂C̈/∂v̇, 0] [Δv̇; Δλ] = -(what the residual changes by along q: r_q + s r_v, v: r_v, x: r_x)

whose right-hand side is one evaluation on dual numbers, with the time moved too where its part of f is wanted. The turning of a body's
axes by its own angular velocity within s, and the energies at the end of y, on which nothing depends, are left out: this is for
iterations, and for methods that keep their order with any matrix.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.rotation import angular_velocity, rates_of_parameters
from nivel.kernels.core.lanes import slope, unit
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_family
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.residual.residual import known_multiplier
from nivel.kernels.residual.tangent import ACCELERATIONS, differentiate, load_twin
from nivel.kernels.solve.newton_matrix import factorise, solve
from nivel.native.function import leaf


@leaf
def prepare_shifted(machine, t, y, rate, s):
    """Factors for the state y, last evaluated with the result `rate`. Returns a status."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    for i in range(y.shape[0]):
        residual.y[i] = y[i]
    for k in range(n):
        residual.vdot[k] = rate[positions + k]
        newton.change[k] = 0.0
    for k in range(residual.lam.shape[0]):
        residual.lam[k] = known_multiplier(record, k)
    status = differentiate(machine, t, s * s, s, s, ACCELERATIONS)
    return factorise(machine) if status == OK else status


@leaf
def move_along(newton, residual, moving, r, s):
    """Move the twin's state along the direction that r asks for before the accelerations change. Leaves rotations in newton.moved."""
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(r.shape[0]) - n - states - 2
    moved, factor = newton.moved, unit(0, 1.0)
    for k in range(n):
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        moving.y[positions + k] += factor * r[positions + k]
        if axis == NONE:
            moving.y[p] += factor * (r[p] + s * r[positions + k])
        elif axis == 0:
            turn = moved[k : k + 3]
            angular_velocity(residual.y[p : p + 4], r[p : p + 4], turn)
            for i in range(3):
                turn[i] += s * r[positions + k + i]
            change = newton.last[0:4]
            rates_of_parameters(residual.y[p : p + 4], turn, change)
            for i in range(4):
                moving.y[p + i] += factor * change[i]
    for k in range(states):
        moving.y[positions + n + k] += factor * r[positions + n + k]


@leaf
def solve_shifted(machine, t, r, s, ahead):
    """Overwrite r (ny,) with x, the solution of (1 - s ∂f/∂y) x = r + s ahead ∂f/∂t. Returns a status."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    twin, moving = load_twin(newton, residual)
    n, states, rows = residual.vdot.shape[0], newton.state.shape[0], residual.lam.shape[0]
    positions = np.int64(r.shape[0]) - n - states - 2
    move_along(newton, residual, moving, r, s)
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
