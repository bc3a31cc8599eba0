"""Derivatives of the residual with respect to accelerations and multipliers, velocities and states, positions, each on its own.

    M δv̇ + C_qᵀ δλ        D (δv, δx)        K δq

so that M + s D + s² K follows for any s, real or complex, without evaluations: see `nivel.kernels.residual.shifted_matrix`. Of the
constraints the
rows are C̈, and turns of bodies are small rotations in body axes.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_family, call_hook
from nivel.kernels.record.record import NONE, TANGENT, record_at
from nivel.kernels.residual.tangent import EPSILON, add_compliance, load_twin, still
from nivel.native.function import leaf

ACCELERATION, VELOCITY, POSITION = 0, 1, 2


@leaf
def is_moved(j, n, states, part):
    """Whether unknown j stands for something of this part: a velocity in all, a state of a force and a multiplier in one."""
    if j < n:
        return True
    return part == (VELOCITY if j < n + states else ACCELERATION)


@leaf
def move_part(newton, moving, j, factor, part):
    """Move what unknown j stands for in the complex residual `moving` by i ε: factor = i ε."""
    n, states = moving.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(moving.y.shape[0]) - n - states - 2
    if j >= n + states:
        moving.lam[j - n - states] += factor
    elif part == VELOCITY:
        moving.y[positions + j] += factor
    elif part == ACCELERATION:
        moving.vdot[j] += factor
    elif newton.place[j, 1] == NONE:
        moving.y[newton.place[j, 0]] += factor
    else:
        p, axis, half = np.int64(newton.place[j, 0]), newton.place[j, 1], 0.5 * factor
        x, y, z = half if axis == 0 else 0j, half if axis == 1 else 0j, half if axis == 2 else 0j
        e0, e1, e2, e3 = moving.y[p], moving.y[p + 1], moving.y[p + 2], moving.y[p + 3]
        moving.y[p] += -e1 * x - e2 * y - e3 * z
        moving.y[p + 1] += e0 * x - e3 * y + e2 * z
        moving.y[p + 2] += e3 * x + e0 * y - e1 * z
        moving.y[p + 3] += -e2 * x + e1 * y + e0 * z


@leaf
def write_part(newton, value, j, n, part, out):
    """Column j of this part from the imaginary parts of the residual's value; with M also the row of C_qᵀ that goes with it."""
    states = newton.state.shape[0]
    rows = newton.b.shape[0] - n - states
    for e in range(newton.entry_start[j], newton.entry_start[j + 1]):
        row, p, transposed = np.int64(newton.entry[e, 0]), newton.entry[e, 1], newton.entry[e, 2]
        slope = value[row if row < n + states else row + 2 * rows].imag / EPSILON
        out[p] = -slope if n <= row < n + states else slope
        if part == ACCELERATION and transposed != NONE:
            out[transposed] = slope


@leaf
def own_rates(newton, n, out):
    """The rows of the rates of states are ẋ - g: their derivatives with respect to ẋ are 1."""
    for j in range(n, n + newton.state.shape[0]):
        for e in range(newton.entry_start[j], newton.entry_start[j + 1]):
            if newton.entry[e, 0] == j:
                out[newton.entry[e, 1]] = 1.0


@leaf
def differentiate_part(machine, t, part, out):
    """Fill `out` with the derivatives of one part for `residual.y`, `vdot` and `lam`. Returns a status."""
    record = record_at(machine)
    newton, here = record.newton, record.residual
    twin, moving = load_twin(newton, here)
    n, states = here.vdot.shape[0], newton.state.shape[0]
    for g in range(newton.group_start.shape[0] - 1):
        first, last = np.int64(newton.group_start[g]), np.int64(newton.group_start[g + 1])
        count = 0
        for m in range(first, last):
            if is_moved(np.int64(newton.group[m]), n, states, part):
                move_part(newton, moving, np.int64(newton.group[m]), 1j * EPSILON, part)
                count += 1
        if count == 0:
            continue
        status = call_family(newton.address[2], twin, 0, complex(t))
        if status != OK:
            return status
        for m in range(first, last):
            if is_moved(np.int64(newton.group[m]), n, states, part):
                write_part(newton, moving.value, np.int64(newton.group[m]), n, part, out)
                still(newton, moving, here, np.int64(newton.group[m]))
    return call_hook(machine, TANGENT, 1 + part, t)


@leaf
def differentiate_parts(machine, t):
    """Fill newton.shifted.M, D and K for `residual.y`, `vdot` and `lam`. Returns a status."""
    newton = record_at(machine).newton
    newton.asked[2] = 0.0
    own_rates(newton, np.int64(newton.place.shape[0]), newton.shifted.M)
    add_compliance(newton, newton.shifted.M)
    for part in range(3):
        out = newton.shifted.M if part == ACCELERATION else (newton.shifted.D if part == VELOCITY else newton.shifted.K)
        status = differentiate_part(machine, t, part, out)
        if status != OK:
            return status
    return OK
