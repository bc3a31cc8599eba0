"""Derivatives of the residual with respect to accelerations and multipliers, velocities and states, positions, each on its own.

    M δv̇ + C_qᵀ δλ        D (δv, δx)        K δq

so that M + s D + s² K follows for any s, real or complex, without evaluations: see `nivel.kernels.residual.shifted_matrix`. Of the
constraints the
rows are C̈, and turns of bodies are small rotations in body axes.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.lanes import slope, unit
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_family, call_hook
from nivel.kernels.record.record import NONE, TANGENT, record_at
from nivel.kernels.residual.tangent import add_compliance, load_twin, still
from nivel.native.duals import LANES
from nivel.native.function import leaf

ACCELERATION, VELOCITY, POSITION = 0, 1, 2
PARTS = 3


@leaf
def is_moved(j, n, states, part):
    """Whether unknown j stands for something of this part: a velocity in all, a state of a force and a multiplier in one."""
    if j < n:
        return True
    return part == (VELOCITY if j < n + states else ACCELERATION)


@leaf
def move_part(newton, moving, j, factor, part):
    """Move what unknown j stands for in this part, in the twin's residual `moving`, by `factor`, a dual number."""
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
        nothing = 0.0 * half
        x, y, z = (
            half if axis == 0 else nothing,
            half if axis == 1 else nothing,
            half if axis == 2 else nothing,
        )
        e0, e1, e2, e3 = moving.y[p], moving.y[p + 1], moving.y[p + 2], moving.y[p + 3]
        moving.y[p] += -e1 * x - e2 * y - e3 * z
        moving.y[p + 1] += e0 * x - e3 * y + e2 * z
        moving.y[p + 2] += e3 * x + e0 * y - e1 * z
        moving.y[p + 3] += -e2 * x + e1 * y + e0 * z


@leaf
def write_part(newton, value, j, lane, n, part, out):
    """Column j of this part from the slopes of the residual's value along a direction; with M also the row of C_qᵀ that goes with it."""
    states = newton.state.shape[0]
    rows = newton.b.shape[0] - n - states
    for e in range(newton.entry_start[j], newton.entry_start[j + 1]):
        row, p, transposed = np.int64(newton.entry[e, 0]), newton.entry[e, 1], newton.entry[e, 2]
        found = slope(value[row if row < n + states else row + 2 * rows], lane)
        out[p] = -found if n <= row < n + states else found
        if part == ACCELERATION and transposed != NONE:
            out[transposed] = found


@leaf
def own_rates(newton, n, out):
    """The rows of the rates of states are ẋ - g: their derivatives with respect to ẋ are 1."""
    for j in range(n, n + newton.state.shape[0]):
        for e in range(newton.entry_start[j], newton.entry_start[j + 1]):
            if newton.entry[e, 0] == j:
                out[newton.entry[e, 1]] = 1.0


@leaf
def moves_with(newton, g, n, part):
    """Whether a group has an unknown that stands for something of this part."""
    for m in range(np.int64(newton.group_start[g]), np.int64(newton.group_start[g + 1])):
        if is_moved(np.int64(newton.group[m]), n, newton.state.shape[0], part):
            return True
    return False


@leaf
def differentiate_columns(machine, twin, moving, first, behind, out, t):
    """The next LANES columns, or as many as there are, of groups of the first part, then of the second, from number `first` to `behind`.
    Returns (status, number of the next one)."""
    record = record_at(machine)
    newton, here = record.newton, record.residual
    n, states, groups = here.vdot.shape[0], newton.state.shape[0], np.int64(newton.group_start.shape[0]) - 1
    last, lane = first, np.int64(0)
    while last < behind and lane < LANES:
        part, g = last // groups, last % groups
        if moves_with(newton, g, n, part):
            for m in range(np.int64(newton.group_start[g]), np.int64(newton.group_start[g + 1])):
                if is_moved(np.int64(newton.group[m]), n, states, part):
                    move_part(newton, moving, np.int64(newton.group[m]), unit(lane, 1.0), part)
            lane += 1
        last += 1
    status = call_family(newton.address[2], twin, 0, t)
    lane = np.int64(0)
    for k in range(first, last):
        part, g = k // groups, k % groups
        if moves_with(newton, g, n, part):
            entries = out[0] if part == ACCELERATION else (out[1] if part == VELOCITY else out[2])
            for m in range(np.int64(newton.group_start[g]), np.int64(newton.group_start[g + 1])):
                if is_moved(np.int64(newton.group[m]), n, states, part):
                    write_part(newton, moving.value, np.int64(newton.group[m]), lane, n, part, entries)
            lane += 1
    for k in range(first, last):
        for m in range(np.int64(newton.group_start[k % groups]), np.int64(newton.group_start[k % groups + 1])):
            still(newton, moving, here, np.int64(newton.group[m]))
    return status, last


@leaf
def differentiate_first(machine, parts, out, t):
    """Fill out[part], the entries of the first `parts` parts, for `residual.y`, `vdot` and `lam`. Returns a status."""
    record = record_at(machine)
    newton = record.newton
    twin, moving = load_twin(machine)
    behind, next_one = parts * (np.int64(newton.group_start.shape[0]) - 1), np.int64(0)
    while next_one < behind:
        status, next_one = differentiate_columns(machine, twin, moving, next_one, behind, out, t)
        if status != OK:
            return status
    for part in range(parts):
        status = call_hook(machine, TANGENT, 1 + part, t)
        if status != OK:
            return status
    return OK


@leaf
def differentiate_parts(machine, t):
    """Fill newton.shifted.M, D and K for `residual.y`, `vdot` and `lam`. Returns a status."""
    newton = record_at(machine).newton
    newton.asked[2] = 0.0
    M, D, K = newton.shifted.M, newton.shifted.D, newton.shifted.K
    own_rates(newton, np.int64(newton.place.shape[0]), M)
    add_compliance(newton, M)
    return differentiate_first(machine, PARTS, (M, D, K), t)
