"""Coordinate partitioning (report 44, eqs. 78–87): C_q = [C_d C_i], v_d = -C_d⁻¹ C_i v_i - C_d⁻¹ C_t, B = [-C_d⁻¹ C_i; 1].

C_q is measured in units of the machine's length and its rows have unit length, so that entries can be compared. A partition is
chosen by Gaussian elimination with pivots from anywhere in C_q: their columns are the dependent velocities, their rows those that
determine them. Velocities that somebody wants to be independent have small units, so that pivots are found among the others
(`nivel.system.elimination.partition`). A partition is kept while elimination within it goes well. The rank comes from the analysis of
the assembled machine, so no tolerance decides it anew; rows beyond it follow from the chosen ones.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rows import add_times
from nivel.kernels.algebra.spatial import cross
from nivel.kernels.algebra.vectors import minus, moment, seen
from nivel.kernels.core.status import OK, SINGULAR
from nivel.kernels.record.record import record_at
from nivel.kernels.solve.flexible_partition import fill_flexible_rows, moves_with_modes, weigh_flexible_row
from nivel.native.function import leaf

# A pivot this small is round-off; squared, it is what pivots of S = C_q M⁻¹ C_qᵀ are held against.
DEPENDENT = 3e-7
# A partition is given up when the largest entry of B (or of what dependent rows are made of) has grown by this factor over the
# least since the choice, or over 1: small changes of independent velocities then are large ones of dependent velocities. Methods whose
# formulas hold for the independent velocities alone err by as much more, and their iteration contracts by as much less.
GROWTH, GROWTH_OF_FORMULAS = 10.0, 2.0
# Of entries that are equal except for round-off the first is taken.
CLEARLY = 1.0001


@leaf
def fill_rows(machine):
    """E: C_q (K, n) of the state last read with respect to (Ṙ, ω̄) of all bodies and ṗ, scaled, in the order of the partition."""
    record = record_at(machine)
    bodies, markers, saddle, partition = record.bodies, record.markers, record.saddle, record.partition
    J, E, unit, place = record.constraints.J, partition.E, partition.unit, partition.column_place
    rows, n = E.shape
    for k in range(n):
        place[partition.column[k]] = k
    for k in range(rows):
        partition.row_place[partition.row[k]] = k
    E[:, :] = 0.0
    fill_flexible_rows(machine)
    for k in range(saddle.blocks[0]):
        part, marker, b = saddle.block[k, 1], saddle.block[k, 2], saddle.block[k, 3]
        if moves_with_modes(record, b):
            continue
        entries, A, u = E[partition.row_place[saddle.block[k, 0]]], bodies.A[b], markers.u[marker]
        turning = seen(A, moment(J[part], u))
        for i in range(3):
            entries[place[6 * b + i]] += unit[6 * b + i] * J[part, i]
            entries[place[6 * b + 3 + i]] += unit[6 * b + 3 + i] * turning[i]
    for k in range(rows):
        square = 0.0
        for j in range(n):
            square += E[k, j] * E[k, j]
        scale = 1.0 / np.sqrt(square) if real(square) > 0.0 else 0.0 * square
        partition.scale[partition.row[k]] = scale
        for j in range(n):
            E[k, j] *= scale


@leaf
def weigh_rows(machine):
    """weight_k = √(C_q M⁻¹ C_qᵀ)_kk of the rows in E, before elimination."""
    record = record_at(machine)
    bodies, partition = record.bodies, record.partition
    E, place, unit = partition.E, partition.column_place, partition.unit
    for k in range(E.shape[0]):
        square = weigh_flexible_row(machine, E[k])
        for b in range(bodies.mass.shape[0]):
            if moves_with_modes(record, b):
                continue
            f0, f1, f2 = E[k, place[6 * b]], E[k, place[6 * b + 1]], E[k, place[6 * b + 2]]
            n0, n1, n2 = E[k, place[6 * b + 3]], E[k, place[6 * b + 4]], E[k, place[6 * b + 5]]
            f0, f1, f2 = f0 / unit[6 * b], f1 / unit[6 * b + 1], f2 / unit[6 * b + 2]
            n0, n1, n2 = n0 / unit[6 * b + 3], n1 / unit[6 * b + 4], n2 / unit[6 * b + 5]
            A, K, c = bodies.A[b], bodies.whitener_b[b], bodies.c[b]
            # moment about the centre of mass, body axes: n̄ - Aᵀ (c × f)
            n0, n1, n2 = minus((n0, n1, n2), seen(A, cross(c, (f0, f1, f2))))
            w0 = K[0, 0] * n0
            w1 = K[1, 0] * n0 + K[1, 1] * n1
            w2 = K[2, 0] * n0 + K[2, 1] * n1 + K[2, 2] * n2
            square += (f0 * f0 + f1 * f1 + f2 * f2) / bodies.mass[b] + w0 * w0 + w1 * w1 + w2 * w2
        partition.weight[partition.row[k]] = np.sqrt(square)


@leaf
def find_pivot(E, k, last_row, last_column):
    """(size, row, column) of the largest entry from (k, k) on."""
    largest, best_row, best_column = np.abs(real(E[k, k])), k, k
    for i in range(k, last_row):
        for j in range(k, last_column):
            size = np.abs(real(E[i, j]))
            if size > CLEARLY * largest:
                largest, best_row, best_column = size, i, j
    return largest, best_row, best_column


@leaf
def eliminate(partition, rank, anywhere):
    """Factors of C_d in E; `anywhere`: a new choice, pivots of all rows and columns, otherwise of the chosen rows.

    Returns (-1 or the place in `row` of one that depends on those before it, smallest pivot).
    """
    E, row, column = partition.E, partition.row, partition.column
    rows, n = E.shape
    smallest = 1.0
    for k in range(rank):
        size, i, j = find_pivot(E, k, rows if anywhere else rank, n if anywhere else k + 1)
        if not size > DEPENDENT:
            return k, size
        smallest = min(smallest, size)
        if i != k:
            row[k], row[i] = row[i], row[k]
            for m in range(n):
                E[k, m], E[i, m] = E[i, m], E[k, m]
        if j != k:
            column[k], column[j] = column[j], column[k]
            for m in range(rows):
                E[m, k], E[m, j] = E[m, j], E[m, k]
        pivot_row = E[k, k + 1 :]
        for m in range(k + 1, rows):
            if E[m, k] != 0.0:
                factor = E[m, k] / E[k, k]
                E[m, k] = factor
                rest = E[m, k + 1 :]
                for p in range(rest.shape[0]):
                    rest[p] -= factor * pivot_row[p]
    return -1, smallest


@leaf
def spread(partition, rank):
    """B from the factors, and the combinations of rows that vanish. Returns their largest entry, in scaled units."""
    E, column, unit, B, null = partition.E, partition.column, partition.unit, partition.B, partition.null
    largest = 0.0
    for m in range(B.shape[0]):
        x = B[m]
        own = unit[column[rank + m]]
        for i in range(rank):
            k = rank - 1 - i
            value = -E[k, rank + m]
            for j in range(k + 1, rank):
                value -= E[k, j] * (x[column[j]] * own / unit[column[j]])
            value /= E[k, k]
            x[column[k]] = value * unit[column[k]] / own
            size = np.abs(real(value))
            if not size <= largest:
                largest = size
        for k in range(rank, column.shape[0]):
            x[column[k]] = 0.0
        x[column[rank + m]] = 1.0
    for m in range(null.shape[0]):
        x = null[m]
        for i in range(rank):
            k = rank - 1 - i
            value = -E[rank + m, k]
            for j in range(k + 1, rank):
                value -= E[j, k] * x[j]
            x[k] = value
            size = np.abs(real(value))
            if not size <= largest:
                largest = size
        for k in range(rank, x.shape[0]):
            x[k] = 0.0
        x[rank + m] = 1.0
    return largest


@leaf
def divide(machine):
    """Factorise C_d of the state last read, after a new choice where the present partition has become a bad one; B with it.

    Nothing is lost by a choice at any state, even inside a step: accelerations and multipliers do not depend on the partition.
    Returns a status; on failure control.failure is the row.
    """
    partition = record_at(machine).partition
    redundant = partition.null.shape[0] > 0
    fill_rows(machine)
    if partition.choices[0] > 0:
        if redundant:
            weigh_rows(machine)
        if serves(machine):
            return OK
        fill_rows(machine)
    if redundant:
        weigh_rows(machine)
    return choose(machine)


@leaf
def serves(machine):
    """Whether the present partition serves for the rows in E, which are factorised."""
    record = record_at(machine)
    partition, rank = record.partition, np.int64(record.control.rank[0])
    quality = partition.quality
    failed, smallest = eliminate(partition, rank, False)
    if failed >= 0:
        return False
    growth = spread(partition, rank)
    if not growth <= quality[2] * max(1.0, quality[0]):
        return False
    quality[0], quality[1] = min(quality[0], growth), smallest
    return True


@leaf
def choose(machine):
    """A new partition of the rows in E, which are factorised. Returns a status; on failure control.failure is the row."""
    record = record_at(machine)
    partition, rank = record.partition, np.int64(record.control.rank[0])
    quality = partition.quality
    failed, smallest = eliminate(partition, rank, True)
    if failed >= 0:
        record.control.failure[0] = partition.row[failed]
        return SINGULAR
    partition.choices[0] += 1
    quality[0], quality[1] = spread(partition, rank), smallest
    return OK


@leaf
def solve_dependent(partition, rank, right):
    """D: its dependent entries C_d⁻¹ `right` (K,), the others zero."""
    E, row, column, b, D = partition.E, partition.row, partition.column, partition.b, partition.D
    for k in range(rank):
        value = right[row[k]] * partition.scale[row[k]]
        for j in range(k):
            value -= E[k, j] * b[j]
        b[k] = value
    for i in range(rank):
        k = rank - 1 - i
        value = b[k]
        for j in range(k + 1, rank):
            value -= E[k, j] * b[j]
        b[k] = value / E[k, k]
        D[column[k]] = b[k] * partition.unit[column[k]]
    for k in range(rank, column.shape[0]):
        D[column[k]] = 0.0


@leaf
def solve_multipliers(partition, rank, g, lam):
    """λ (K,) with C_qᵀ λ = g for a g (n,) with Bᵀ g = 0, from the dependent entries: C_dᵀ λ = g_d.

    Where rows depend on each other, the λ of least length, λ_k² weighed by (C_q M⁻¹ C_qᵀ)_kk as in `nivel.kernels.algebra.dense`.
    """
    E, row, column, b, null = partition.E, partition.row, partition.column, partition.b, partition.null
    for k in range(rank):
        value = g[column[k]] * partition.unit[column[k]]
        for j in range(k):
            value -= E[j, k] * b[j]
        b[k] = value / E[k, k]
    for i in range(rank):
        k = rank - 1 - i
        for j in range(k + 1, rank):
            b[k] -= E[j, k] * b[j]
    rows = row.shape[0]
    for k in range(rank, rows):
        b[k] = 0.0
    if null.shape[0] > 0:
        for k in range(rows):
            b[k] *= partition.weight[row[k]]
            for m in range(null.shape[0]):
                null[m, k] *= partition.weight[row[k]]
        # Gram–Schmidt; each column brings an unknown of its own, so they are far from parallel
        for m in range(null.shape[0]):
            for o in range(m):
                remove(null[o], null[m])
            normalise_vector(null[m])
            remove(null[m], b)
        for k in range(rows):
            b[k] /= partition.weight[row[k]]
    for k in range(rows):
        lam[row[k]] = b[k] * partition.scale[row[k]]


@leaf
def remove(direction, x):
    """x -= direction (directionᵀ x) for a unit direction."""
    share = 0.0
    for k in range(x.shape[0]):
        share += direction[k] * x[k]
    add_times(-share, direction, x)


@leaf
def normalise_vector(x):
    """x := x/|x|."""
    square = 0.0
    for k in range(x.shape[0]):
        square += x[k] * x[k]
    for k in range(x.shape[0]):
        x[k] /= np.sqrt(square)
