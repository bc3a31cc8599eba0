"""The stages of Radau IIA by Newton's iteration with the derivatives of every stage at that stage: one system of three times the size.

Stages Z_i = u(t + c_i h) - y miss R_i = h Σ a_ij F_j - Z_i. With changes w of accelerations and rates, and of multipliers, at the stages,

    Δv_i = R_i + h Σ a_ij w_j        Δq_i = R_i + h Σ a_ij Δv_j        M_i (w_i, Δλ_i) + D_i (Δv_i, Δx_i) + K_i Δq_i = 0

so block (i, j) of the matrix is δ_ij M_i + h a_ij D_i + K_i X_ij, X = h² A² for plain positions. Euler parameters turn with the body,
θ̇ = ½ θ ∘ (0, ω̄): with those of a body at all stages as one vector of twelve,

    Δθ_i - h Σ a_ij ½ Δθ_j ∘ (0, ω̄_j) = R_i + h Σ a_ij ½ θ_j ∘ (0, Δω̄_j)

is solved for them first. Nothing depends on the energies at the end of y: they change by what they miss.

Where a stiff spring turns with the machine it has another direction at every stage. The simplified iteration, which has one matrix for all
of them, then does not contract unless the step is short against that turn, however slow the motion; this one does.
"""

import numpy as np

from nivel.integrate.radau.radau_constants import AA, A
from nivel.kernels.algebra.lu import factorise_lu, solve_lu
from nivel.kernels.algebra.rotation import angular_velocity
from nivel.kernels.algebra.rows import clear, copy
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.residual.shifted_matrix import find_parts, keep_multipliers
from nivel.kernels.solve.newton_matrix import factorise_entries, solve_entries
from nivel.native.function import leaf

# rows of the derivatives at the last stage, and of those put aside
END, BEGIN = 2, 3


@leaf
def put_aside(machine):
    """Keep the derivatives at the begin of the step, and its multipliers."""
    record = record_at(machine)
    copy_parts(record.newton.shifted, BEGIN)
    copy(record.residual.lam, record.newton.lam)


@leaf
def bring_back(machine, row, y):
    """The derivatives of a row with their state y, and the multipliers put aside, are what the record has again."""
    record = record_at(machine)
    shifted, own, residual = record.newton.shifted, record.newton.shifted.coupled, record.residual
    for p in range(shifted.M.shape[0]):
        shifted.M[p], shifted.D[p], shifted.K[p] = own.M[row, p], own.D[row, p], own.K[row, p]
    copy(record.newton.lam, residual.lam)
    copy(y, residual.y)


@leaf
def copy_parts(shifted, row):
    """Into a row of those of the stages."""
    own = shifted.coupled
    for p in range(shifted.M.shape[0]):
        own.M[row, p], own.D[row, p], own.K[row, p] = shifted.M[p], shifted.D[p], shifted.K[p]


@leaf
def find_stage_parts(machine, stage, t, y, rate):
    """Derivatives at a stage: its time, its state y, last evaluated with the result `rate`. Returns a status."""
    shifted = record_at(machine).newton.shifted
    keep_multipliers(machine)
    status = find_parts(machine, t, y, rate)
    copy_parts(shifted, stage)
    copy(y, shifted.coupled.state[stage])
    return status


@leaf
def spin_matrix(own, turn, v, h):
    """The factors of the equations of the Euler parameters of one body, whose angular velocities start at v. Returns a status."""
    matrix, state = own.spin[turn], own.state
    for i in range(3):
        for j in range(3):
            share = -0.5 * h * A[i, j]
            x, y, z = share * state[j, v], share * state[j, v + 1], share * state[j, v + 2]
            r, c, one = 4 * i, 4 * j, 1.0 if i == j else 0.0
            # d ∘ (0, ω̄) of a column d
            matrix[r, c], matrix[r, c + 1], matrix[r, c + 2], matrix[r, c + 3] = one, -x, -y, -z
            matrix[r + 1, c], matrix[r + 1, c + 1], matrix[r + 1, c + 2], matrix[r + 1, c + 3] = x, one, z, -y
            matrix[r + 2, c], matrix[r + 2, c + 1], matrix[r + 2, c + 2], matrix[r + 2, c + 3] = y, -z, one, x
            matrix[r + 3, c], matrix[r + 3, c + 1], matrix[r + 3, c + 2], matrix[r + 3, c + 3] = z, y, -x, one
    return OK if factorise_lu(matrix, own.pivot[turn]) else NOT_CONVERGED


@leaf
def turn_by(own, turn, p, h, d, w):
    """Overwrite d (12,), what the Euler parameters from place p of y miss at the stages, by their changes, where the angular velocities
    change by w (9,)."""
    for j in range(3):
        e0, e1, e2, e3 = own.state[j, p], own.state[j, p + 1], own.state[j, p + 2], own.state[j, p + 3]
        x, y, z = w[3 * j], w[3 * j + 1], w[3 * j + 2]
        c0, c1 = -e1 * x - e2 * y - e3 * z, e0 * x - e3 * y + e2 * z
        c2, c3 = e3 * x + e0 * y - e1 * z, -e2 * x + e1 * y + e0 * z
        for i in range(3):
            share = 0.5 * h * A[i, j]
            d[4 * i] += share * c0
            d[4 * i + 1] += share * c1
            d[4 * i + 2] += share * c2
            d[4 * i + 3] += share * c3
    solve_lu(own.spin[turn], own.pivot[turn], d)


@leaf
def find_reach(machine, positions, h):
    """Fill `reach`, X in the equations above. Returns a status."""
    newton = record_at(machine).newton
    own, turn = newton.shifted.coupled, 0
    d, w = own.work[0], own.work[1]
    for k in range(newton.place.shape[0]):
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        if axis == NONE:
            for i in range(3):
                for j in range(3):
                    own.reach[k, i, j] = h * h * AA[i, j]
        elif axis == 0:
            if spin_matrix(own, turn, positions + k, h) != OK:
                return NOT_CONVERGED
            for column in range(9):
                j, along = column // 3, column % 3
                d[:] = 0.0
                w[:] = 0.0
                for i in range(3):
                    w[3 * i + along] = h * A[i, j]
                turn_by(own, turn, p, h, d, w)
                for i in range(3):
                    angular_velocity(own.state[i, p : p + 4], d[4 * i : 4 * i + 4], w[9:12])
                    for m in range(3):
                        own.reach[k + m, i, column] = w[9 + m]
            turn += 1
    return OK


@leaf
def fill_row(newton, u, h):
    """The three rows of the matrix that belong to unknown u."""
    own, value = newton.shifted.coupled, newton.shifted.coupled.factors.value
    n, states = newton.place.shape[0], newton.state.shape[0]
    first, count = np.int64(newton.row_start[u]), np.int64(newton.row_start[u + 1]) - np.int64(newton.row_start[u])
    for e in range(count):
        p = first + e
        c = np.int64(newton.column[p])
        for i in range(3):
            at = 9 * first + 3 * (i * count + e)
            for j in range(3):
                value[at + j] = h * A[i, j] * own.D[i, p] if c < n + states else 0.0
            value[at + i] += own.M[i, p]
            if c < n:
                axis = newton.place[c, 1]
                if axis == NONE:
                    for j in range(3):
                        value[at + j] += own.K[i, p] * own.reach[c, i, j]
                else:
                    a = np.int64(axis)
                    for j in range(3):
                        for m in range(3):
                            value[at + j] += own.K[i, p - a + m] * own.reach[c - a + m, i, 3 * j + a]


@leaf
def factorise_stages(machine, positions, h):
    """Factors of the system for the derivatives found at the stages of a step h. Returns a status; the unknown without a pivot is left in
    control.failure."""
    record = record_at(machine)
    newton = record.newton
    own = newton.shifted.coupled
    if find_reach(machine, positions, h) != OK:
        return NOT_CONVERGED
    for u in range(newton.row_start.shape[0] - 1):
        fill_row(newton, u, h)
    status = factorise_entries(own, own.factors, record.control.failure)
    if status != OK and own.factors.matrix.shape[0] == 0:
        # the system has three places for an unknown
        record.control.failure[0] //= 3
    return status


@leaf
def turn_with_velocities(own, turn, p, v, h):
    """work[0] := the changes of the Euler parameters from place p of y at the stages, for what they miss and for the changes of the angular
    velocities from place v, both in r."""
    d, w = own.work[0], own.work[1]
    for i in range(3):
        for m in range(4):
            d[4 * i + m] = own.r[i, p + m]
        for m in range(3):
            w[3 * i + m] = own.r[i, v + m]
    turn_by(own, turn, p, h, d, w)


@leaf
def load_right_side(newton, positions, h):
    """b := -D_i (R_v, R_x) - K_i times how positions change while accelerations do not."""
    own, turn = newton.shifted.coupled, 0
    b, r, d = own.factors.b, own.r, own.work[0]
    n = newton.place.shape[0]
    for k in range(n):
        p, axis, v = np.int64(newton.place[k, 0]), newton.place[k, 1], positions + k
        if axis == NONE:
            for i in range(3):
                own.moved[i, k] = r[i, p] + h * (A[i, 0] * r[0, v] + A[i, 1] * r[1, v] + A[i, 2] * r[2, v])
        elif axis == 0:
            turn_with_velocities(own, turn, p, v, h)
            turn += 1
            for i in range(3):
                angular_velocity(own.state[i, p : p + 4], d[4 * i : 4 * i + 4], own.moved[i, k : k + 3])
    clear(b)
    for j in range(n + newton.state.shape[0]):
        for e in range(newton.entry_start[j], newton.entry_start[j + 1]):
            row, p = np.int64(newton.entry[e, 0]), newton.entry[e, 1]
            for i in range(3):
                b[3 * row + i] -= own.D[i, p] * r[i, positions + j]
                if j < n:
                    b[3 * row + i] -= own.K[i, p] * own.moved[i, j]


@leaf
def take_accelerations(newton, positions, h):
    """r := the changes of the states at the stages, for the changes of accelerations and rates in b."""
    own, turn = newton.shifted.coupled, 0
    b, r, d = own.factors.b, own.r, own.work[0]
    n = newton.place.shape[0]
    for k in range(n + newton.state.shape[0]):
        for i in range(3):
            r[i, positions + k] += h * (A[i, 0] * b[3 * k] + A[i, 1] * b[3 * k + 1] + A[i, 2] * b[3 * k + 2])
    for k in range(n):
        p, axis, v = np.int64(newton.place[k, 0]), newton.place[k, 1], positions + k
        if axis == NONE:
            for i in range(3):
                r[i, p] += h * (A[i, 0] * r[0, v] + A[i, 1] * r[1, v] + A[i, 2] * r[2, v])
        elif axis == 0:
            turn_with_velocities(own, turn, p, v, h)
            turn += 1
            for i in range(3):
                for m in range(4):
                    r[i, p + m] = d[4 * i + m]


@leaf
def solve_stages(machine, positions, h):
    """Overwrite `r`, what the stages of a step h miss, by their changes."""
    newton = record_at(machine).newton
    own = newton.shifted.coupled
    load_right_side(newton, positions, h)
    solve_entries(own, own.factors)
    take_accelerations(newton, positions, h)
