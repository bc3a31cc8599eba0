"""The embedding technique (report 44, eqs. 84–89): v̇ = B u̇ + D in M v̇ + C_qᵀ λ = Q leaves Bᵀ M B u̇ = Bᵀ (Q - M D)."""

import numpy as np

from nivel.kernels.algebra.rows import add_times, clear, subtract
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import combined, minus, plus_cross, put, seen, times, turned
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import record_at
from nivel.kernels.solve.flexible_partition import flexible_forces, moves_with_modes, times_flexible_mass
from nivel.kernels.solve.partition import solve_dependent
from nivel.native.function import leaf, shared


@leaf
def generalised_forces(machine):
    """Q = Q_e + Q_v about the frame origins (eq. 75): (F - m ω × (ω × c), Aᵀ(τ - c × m ω × (ω × c)) - ω̄ × J̄ ω̄)."""
    record = record_at(machine)
    bodies, Q = record.bodies, record.partition.Q
    flexible_forces(machine, Q)
    for b in range(bodies.mass.shape[0]):
        if moves_with_modes(record, b):
            continue
        F, c, w, w_b = bodies.wrench[b], bodies.c[b], bodies.omega[b], bodies.omega_b[b]
        A, J, m = bodies.A[b], bodies.inertia_b[b], bodies.mass[b]
        pull = times(m, combined(dot(w, c), w, -dot(w, w), c))
        torque = minus((F[3], F[4], F[5]), cross(c, pull))
        put(Q, 6 * b, minus(F, pull))
        put(Q, 6 * b + 3, minus(seen(A, torque), cross(w_b, turned(J, w_b))))


@leaf
def times_masses(machine, x, out):
    """out (n,) = M x."""
    record = record_at(machine)
    times_flexible_mass(machine, x, out)
    for b in range(record.bodies.mass.shape[0]):
        if not moves_with_modes(record, b):
            times_mass(record.bodies, b, x[6 * b : 6 * b + 6], out[6 * b : 6 * b + 6])


@leaf
def subtract_inertia(machine, x):
    """Q -= M x."""
    partition = record_at(machine).partition
    times_masses(machine, x, partition.p)
    subtract(partition.p, partition.Q)


@leaf
def embed(machine):
    """v: the accelerations B u̇ + D, from B, D and Q; Q becomes C_qᵀ λ (eqs. 87–89)."""
    record = record_at(machine)
    partition = record.partition
    B, MB, H, u, v = partition.B, partition.MB, partition.H, partition.u, partition.v
    free, n = B.shape
    subtract_inertia(machine, partition.D)
    for k in range(free):
        times_masses(machine, B[k], MB[k])
        total = 0.0
        for i in range(n):
            total += B[k, i] * partition.Q[i]
        u[k] = total
        for j in range(k + 1):
            total = 0.0
            for i in range(n):
                total += MB[k, i] * B[j, i]
            H[k, j] = total
    solve_definite(H, u)
    clear(v)
    for k in range(free):
        add_times(u[k], B[k], v)
    subtract_inertia(machine, v)
    for i in range(n):
        v[i] += partition.D[i]


@leaf
def follow_independent(machine, vdot):
    """Dependent entries of v̇ := B u̇ + D for the independent ones u̇ there, by the partition and γ of the state last read."""
    record = record_at(machine)
    partition, rank = record.partition, np.int64(record.control.rank[0])
    column, B, u = partition.column, partition.B, partition.u
    solve_dependent(partition, rank, record.constraints.gamma)
    for k in range(u.shape[0]):
        u[k] = vdot[column[rank + k]]
    for k in range(rank):
        i = column[k]
        value = partition.D[i]
        for m in range(u.shape[0]):
            value += B[m, i] * u[m]
        vdot[i] = value


@leaf
def times_mass(bodies, b, x, out):
    """out = M x of body b about its frame origin for x = (Ṙ, ω̄) or its derivative: (m a, J̄ ω̄ + Aᵀ (c × m a)), a = Ṙ + ω × c."""
    A, c, J, m = bodies.A[b], bodies.c[b], bodies.inertia_b[b], bodies.mass[b]
    w_b = x[3:6]
    momentum = times(m, plus_cross(x, turned(A, w_b), c))
    lever = cross(c, momentum)
    put(out, 0, momentum)
    for i in range(3):
        out[3 + i] = dot(J[i], w_b) + A[0, i] * lever[0] + A[1, i] * lever[1] + A[2, i] * lever[2]


@leaf
def solve_definite(H, x):
    """Overwrite x with H⁻¹ x for a symmetric positive definite H, of which the Cholesky factor is left in the lower triangle."""
    n = x.shape[0]
    for k in range(n):
        for j in range(k + 1):
            value = H[k, j]
            for i in range(j):
                value -= H[k, i] * H[j, i]
            H[k, j] = np.sqrt(value) if j == k else value / H[j, j]
        for j in range(k):
            x[k] -= H[k, j] * x[j]
        x[k] /= H[k, k]
    for i in range(n):
        k = n - 1 - i
        for j in range(k + 1, n):
            x[k] -= H[j, k] * x[j]
        x[k] /= H[k, k]


@shared
def depend_on(machine, t, normalise_state, read):
    """Dependent positions, velocities and accelerations of `residual.y` and `vdot` from C = 0, Ċ = 0 and C̈ = 0; the independent ones stay.

    normalise_state(machine, t, y), read(machine, t, y) : the former two, and the state, compiled into this one. Returns a status: SINGULAR
    where the positions cannot be found; control.failure is the row that is farthest open.
    """
    own = record_at(machine).residual
    status = normalise_state(machine, t, own.y)
    if status == OK:
        status = read(machine, t, own.y)
    if status == OK:
        follow_independent(machine, own.vdot)
    return status
