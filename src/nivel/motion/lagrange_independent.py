"""Independent coordinates of the Lagrange equations: the embedding technique on q̇ = (Ṙ, θ̇) of all bodies (report 44, eqs. 78–89).

q̈ = B q̈_i + D with Bᵀ M B q̈_i = Bᵀ (Q_e + Q_v - M D), where the normalisation of Euler parameters is one of the constraints. M + μ θ θᵀ
of `nivel.motion.lagrange` is L Lᵀ, so that Bᵀ M B = (Lᵀ B)ᵀ Lᵀ B and the right side is (Lᵀ B)ᵀ (z - Lᵀ D), z = L⁻¹ (Q_e + Q_v). The
state is that of `lagrange`; after every step the dependent rates and positions are replaced by what the independent ones leave them.

With friction in joints the accelerations come from `lagrange`, as in `nivel.motion.independent`.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rows import subtract
from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, finish_forces
from nivel.kernels.record.record import CORRECT, EVALUATE, record_at
from nivel.kernels.solve.embedding import solve_definite
from nivel.kernels.solve.partition import choose, serves, solve_dependent, solve_multipliers
from nivel.kernels.solve.saddle import PIVOTED
from nivel.motion.independent import keep_independent
from nivel.motion.lagrange import WIDTH, factorise_body, fill_row, forward, read_state, whiten_forces, write_rate
from nivel.motion.lagrange import evaluate as evaluate_lagrange
from nivel.native.entry import entry
from nivel.native.function import leaf, stage


@stage
def read_with_rows(machine, t, y):
    """The state, the factors of all bodies, and C_q in W. Returns a status."""
    status = read_state(machine, t, y)
    fill_blocks(machine, y)
    return status


@stage
def fill_blocks(machine, y):
    """The factors of all bodies, and C_q of all blocks in W."""
    record = record_at(machine)
    for b in range(record.bodies.mass.shape[0]):
        factorise_body(record.bodies, record.saddle.G[b], b)
    for k in range(record.saddle.blocks[0]):
        fill_row(machine, y, k)


@leaf
def fill_rows(machine):
    """E: C_q (K, n) of the blocks in W, scaled, in the order of the partition; weight_k = √(C_q M⁻¹ C_qᵀ)_kk."""
    record = record_at(machine)
    saddle, partition = record.saddle, record.partition
    E, unit, place, row = partition.E, partition.unit, partition.column_place, partition.p
    rows, n = E.shape
    for k in range(n):
        place[partition.column[k]] = k
    for k in range(rows):
        partition.row_place[partition.row[k]] = k
    E[:, :] = 0.0
    for k in range(saddle.blocks[0]):
        entries, first = E[partition.row_place[saddle.block[k, 0]]], WIDTH * np.int64(saddle.block[k, 3])
        for i in range(WIDTH):
            entries[place[first + i]] += saddle.W[k, i]
    for k in range(rows):
        for i in range(n):
            row[i] = E[k, place[i]]
        own = 0.0
        for b in range(saddle.G.shape[0]):
            z = row[WIDTH * b : WIDTH * b + WIDTH]
            forward(saddle.G[b], z)
            for i in range(WIDTH):
                own += z[i] * z[i]
        square = 0.0
        for j in range(n):
            E[k, j] *= unit[partition.column[j]]
            square += E[k, j] * E[k, j]
        scale = 1.0 / np.sqrt(square) if real(square) > 0.0 else 0.0 * square
        partition.scale[partition.row[k]] = scale
        partition.weight[partition.row[k]] = np.sqrt(own) * scale
        for j in range(n):
            E[k, j] *= scale


@leaf
def divide(machine):
    """As `nivel.kernels.solve.partition.divide`."""
    fill_rows(machine)
    if record_at(machine).partition.choices[0] > 0:
        if serves(machine):
            return OK
        fill_rows(machine)
    return choose(machine)


@leaf
def whitened(saddle, x, out):
    """out = Lᵀ x of all bodies."""
    for b in range(saddle.G.shape[0]):
        G, first = saddle.G[b], WIDTH * b
        for i in range(WIDTH):
            value = G[i, i] * x[first + i]
            for j in range(max(i + 1, 3), WIDTH):
                value += G[j, i] * x[first + j]
            out[first + i] = value


@leaf
def embed(machine):
    """v: the accelerations B q̈_i + D, from B, D and z; Q becomes C_qᵀ λ (eqs. 87–89)."""
    record = record_at(machine)
    saddle, partition = record.saddle, record.partition
    B, MB, H, u, v, p, Q = partition.B, partition.MB, partition.H, partition.u, partition.v, partition.p, partition.Q
    free, n = B.shape
    whitened(saddle, partition.D, p)
    for k in range(free):
        whitened(saddle, B[k], MB[k])
        u[k] = 0.0
        for i in range(n):
            u[k] += MB[k, i] * (saddle.z[i // WIDTH, i % WIDTH] - p[i])
        for j in range(k + 1):
            H[k, j] = 0.0
            for i in range(n):
                H[k, j] += MB[k, i] * MB[j, i]
    solve_definite(H, u)
    for i in range(n):
        v[i] = partition.D[i]
        for k in range(free):
            v[i] += u[k] * B[k, i]
    whitened(saddle, v, p)
    for i in range(n):
        p[i] = saddle.z[i // WIDTH, i % WIDTH] - p[i]
    for b in range(saddle.G.shape[0]):
        G, first = saddle.G[b], WIDTH * b
        for i in range(WIDTH):
            value = G[i, i] * p[first + i]
            for j in range(i if i >= 3 else 0):
                value += G[i, j] * p[first + j]
            Q[first + i] = value


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (q, q̇, x): x are the states of forces, the work of external forces and the dissipated energy [J].

    Leaves everything else in the record.
    """
    record = record_at(machine)
    if record.friction.columns.shape[0] > 0:
        return evaluate_lagrange(machine, t, y, ydot)
    partition, saddle, rank = record.partition, record.saddle, np.int64(record.control.rank[0])
    status = read_state(machine, t, y)
    if status != OK:
        return status
    load_weight(record.bodies)
    status = apply_forces(machine, t, y)
    if status != OK:
        return status
    fill_blocks(machine, y)
    status = divide(machine)
    if status != OK:
        return status
    whiten_forces(machine, y)
    solve_dependent(partition, rank, record.constraints.gamma)
    embed(machine)
    solve_multipliers(partition, rank, partition.Q, record.constraints.lam)
    record.control.rank[PIVOTED] = 1  # as in `nivel.motion.independent`
    status = finish_forces(machine, t, ydot)
    for b in range(saddle.G.shape[0]):
        for i in range(WIDTH):
            saddle.z[b, i] = partition.v[WIDTH * b + i]
        write_rate(machine, y, ydot, b)
    return status


@leaf
def move_dependent(machine, y):
    """Positions: subtract D from the dependent ones."""
    D = record_at(machine).partition.D
    subtract(D, y)


@entry(CORRECT)
def normalise_state(machine, t, y):
    """What depends on the independent coordinates, see `nivel.motion.independent.keep_independent`."""
    return keep_independent(machine, t, y, read_with_rows, divide, move_dependent)


# the dependent coordinates are solved for with every stabilisation, so there is nothing left to correct directly
correct = normalise_state
