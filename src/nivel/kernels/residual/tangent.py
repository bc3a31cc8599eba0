"""Exact derivatives of the residual: the same source runs on dual numbers, whose slopes are derivatives along LANES directions.

Unknowns that have no row in common are moved along one direction, so a chain of any length takes as many evaluations as a short one.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.inverse_tangent import inverse_tangent_by, inverse_tangent_factor
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.core.lanes import is_whole, slope, unit
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_family, call_hook
from nivel.kernels.record.record import NONE, TANGENT, record_at
from nivel.native.duals import LANES
from nivel.native.function import leaf

# Derivatives of the residual with respect to accelerations and multipliers, velocities and states, positions, each on its own.
#
#     M δv̇ + C_qᵀ δλ        D (δv, δx)        K δq
#
# so that M + s D + s² K follows for any s, real or complex, without evaluations: see `nivel.kernels.residual.shifted_matrix`. Of the
# constraints the
# rows are C̈, and turns of bodies are small rotations in body axes.

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
        x, y, z = half if axis == 0 else nothing, half if axis == 1 else nothing, half if axis == 2 else nothing
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


# which rows of the constraints stand in the matrix: C/cq or C̈
POSITIONS, ACCELERATIONS = 0, 1


@leaf
def inverse_tangent(psi, w):
    """T⁻¹ w: change of the rotation vector ψ of A exp(ψ̃) for a small rotation w after it, in the turned axes."""
    return inverse_tangent_by(inverse_tangent_factor(dot(psi, psi)), 0.5, psi, w)


@leaf
def move_unknown(newton, moving, j, factor, cq, cv, cx):
    """Move unknown j of the twin's residual `moving` by `factor`, a dual number."""
    n, states, positions = moving.vdot.shape[0], newton.state.shape[0], np.int64(moving.y.shape[0])
    positions -= n + states + 2
    if j >= n + states:
        moving.lam[j - n - states] += factor
    elif j >= n:
        moving.y[positions + j] += cx * factor
    elif newton.place[j, 1] == NONE:
        moving.y[newton.place[j, 0]] += cq * factor
        moving.y[positions + j] += cv * factor
        moving.vdot[j] += factor
    else:
        p, axis = np.int64(newton.place[j, 0]), np.int64(newton.place[j, 1])
        first, half = j - axis, 0.5 * cq * factor
        x, y, z = 1.0 if axis == 0 else 0.0, 1.0 if axis == 1 else 0.0, 1.0 if axis == 2 else 0.0
        e0, e1, e2, e3 = moving.y[p], moving.y[p + 1], moving.y[p + 2], moving.y[p + 3]
        moving.y[p] += half * (-e1 * x - e2 * y - e3 * z)
        moving.y[p + 1] += half * (e0 * x - e3 * y + e2 * z)
        moving.y[p + 2] += half * (e3 * x + e0 * y - e1 * z)
        moving.y[p + 3] += half * (-e2 * x + e1 * y + e0 * z)
        w = inverse_tangent(newton.change[first : first + 3], (x, y, z))
        for i in range(3):
            moving.y[positions + first + i] += cv * w[i] * factor
            moving.vdot[first + i] += w[i] * factor


@leaf
def write_column(newton, value, j, lane, n, held, cq, level):
    """Column j of the matrix from the slopes of the residual's value along a direction, and the row of C_qᵀ that goes with it.

    held : constraint rows; those behind them are of frictions, at the level of accelerations always.
    """
    states = newton.state.shape[0]
    rows = newton.b.shape[0] - n - states
    for e in range(newton.entry_start[j], newton.entry_start[j + 1]):
        row, p, transposed = np.int64(newton.entry[e, 0]), newton.entry[e, 1], newton.entry[e, 2]
        found = slope(value[row], lane)
        if row >= n + states:
            of_positions = level == POSITIONS and row < n + states + held
            newton.value[p] = found / cq if of_positions else slope(value[row + 2 * rows], lane)
            if transposed != NONE:
                newton.value[transposed] = found / cq
        elif row >= n:
            newton.value[p] = (1.0 if row == j else 0.0) - found
        else:
            newton.value[p] = found


@leaf
def add_compliance(newton, entries):
    """-1/α at the multipliers of penalty methods."""
    for k in range(newton.compliance.shape[0]):
        entries[newton.diagonal[k]] = -newton.compliance[k]


@leaf
def take_values(into, of):
    """The values of numbers that may be dual."""
    for k in range(of.shape[0]):
        into[k] = real(of[k])


@leaf
def carry_over(record, twin):
    """What the run on dual numbers carries from state to state beside y: its twin has the memory of the run without slopes."""
    here, moving = record.residual, twin.residual
    take_values(twin.coordinates.reference, record.coordinates.reference)
    for e in range(record.elements.memory.shape[0]):
        take_values(twin.elements.memory[e], record.elements.memory[e])
    take_values(twin.watched.held, record.watched.held)
    take_values(twin.friction.anchor, record.friction.anchor)
    take_values(twin.control.stick, record.control.stick)
    take_values(moving.begun, here.begun)
    take_values(moving.bidden, here.bidden)
    take_values(moving.frozen, here.frozen)
    take_values(moving.span, here.span)


@leaf
def load_twin(machine):
    """The twin's residual at the same state, accelerations and multipliers, without slopes. Returns the twin's address and its residual."""
    record = record_at(machine)
    newton, here = record.newton, record.residual
    twin = (newton.address[0],)
    moving = record_at(twin).residual
    if is_whole(machine):
        carry_over(record, record_at(twin))
    for i in range(here.y.shape[0]):
        moving.y[i] = real(here.y[i])
    for i in range(here.vdot.shape[0]):
        moving.vdot[i] = real(here.vdot[i])
    for i in range(here.lam.shape[0]):
        moving.lam[i] = real(here.lam[i])
    return twin, moving


@leaf
def differentiate(machine, t, cq, cv, cx, level):
    """Entries of the matrix of Newton's iteration, [M + cv D + cq K, C_qᵀ; C_q, 0], at `residual.y`, `vdot`, `lam`. Returns a status.

    Unknown v̇ moves positions by cq and velocities by cv, ẋ the states of forces by cx; columns are with respect to rotations after
    A exp(change), and scaled like accelerations. level : ACCELERATIONS has the derivatives of C̈, with its feedback, in place of the last
    rows. With penalties there is -1/α in the corner.
    """
    record = record_at(machine)
    newton, here = record.newton, record.residual
    twin, moving = load_twin(machine)
    n, held, groups = here.vdot.shape[0], here.row.shape[0], np.int64(newton.group_start.shape[0]) - 1
    for first in range(0, groups, LANES):
        last = min(first + LANES, groups)
        for g in range(first, last):
            for m in range(np.int64(newton.group_start[g]), np.int64(newton.group_start[g + 1])):
                move_unknown(newton, moving, np.int64(newton.group[m]), unit(g - first, 1.0), cq, cv, cx)
        status = call_family(newton.address[1], twin, 0, t)
        if status != OK:
            return status
        for g in range(first, last):
            for m in range(np.int64(newton.group_start[g]), np.int64(newton.group_start[g + 1])):
                write_column(newton, moving.value, np.int64(newton.group[m]), g - first, n, held, cq, level)
        for m in range(np.int64(newton.group_start[first]), np.int64(newton.group_start[last])):
            still(newton, moving, here, np.int64(newton.group[m]))
    add_compliance(newton, newton.value)
    newton.asked[0], newton.asked[1] = cq, cv
    return call_hook(machine, TANGENT, 0, t)


@leaf
def still(newton, moving, here, j):
    """Put back what `move_unknown` moved for unknown j."""
    n, states = here.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(here.y.shape[0]) - n - states - 2
    if j >= n + states:
        moving.lam[j - n - states] = real(here.lam[j - n - states])
    elif j >= n:
        moving.y[positions + j] = real(here.y[positions + j])
    else:
        p, axis = np.int64(newton.place[j, 0]), newton.place[j, 1]
        first, count = (j, 1) if axis == NONE else (j - np.int64(axis), 4)
        for i in range(count):
            moving.y[p + i] = real(here.y[p + i])
        for i in range(min(count, 3)):
            moving.y[positions + first + i] = real(here.y[positions + first + i])
            moving.vdot[first + i] = real(here.vdot[first + i])
