"""Multipliers of least length, for what a frame shows of a redundant machine whose equations leave dependent rows out.

All λ with the same S λ move the machine alike; shown is the one with the least Σ S_kk λ_k², which does not depend on units. It is what the
augmented Lagrangian with 1/α_k = ε S_kk tends to from λ = 0: each iteration (S + 1/α) d' = d/α leaves what moves something
smaller by ε over its share of S, and adds nothing that moves nothing. Its factor is as sparse as that of S.
"""

import numpy as np

from nivel.kernels.algebra.dense import IMMOBILE, solve_pivoted
from nivel.kernels.algebra.rows import clear
from nivel.kernels.algebra.sparse import DEPENDENT, factorise
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import record_at
from nivel.kernels.solve.saddle import LEFT_OUT, PIVOTED, RANK, SETTLED, factorise_by_pivots, iterate_rows
from nivel.native.function import leaf, stage

# ε: round-off over it is left of what moves nothing
SHARE = 1e-6
MOST_ITERATIONS = 40


@stage
def spread_multipliers(machine):
    """`constraints.lam` of the state last evaluated := the one of least length. The factor of S is lost."""
    record = record_at(machine)
    rank = record.control.rank
    if rank[LEFT_OUT] == 0 or rank[PIVOTED] == 1:
        return
    saddle, lam = record.saddle, record.constraints.lam
    product(saddle, lam)
    if not found_by_iteration(record):
        product(saddle, lam)
        if factorise_by_pivots(record) >= 0:
            return
        solve_pivoted(saddle, np.int64(rank[RANK]))
    for k in range(saddle.b.shape[0]):
        lam[saddle.row[k]] = saddle.b[k]


@leaf
def product(saddle, lam):
    """b := S λ."""
    b = saddle.b
    clear(b)
    for k in range(b.shape[0]):
        row = saddle.order[k]
        own = lam[saddle.row[row]]
        last = saddle.S_start[k + 1] - 1
        for p in range(saddle.S_start[k], last):
            other = saddle.order[saddle.S_row[p]]
            b[row] += saddle.S[p] * lam[saddle.row[other]]
            b[other] += saddle.S[p] * own
        b[row] += saddle.S[last] * own


@leaf
def shift_rows(record):
    """1/α of all rows; those that nothing can move count as `nivel.kernels.algebra.dense` has them."""
    saddle, scale = record.saddle, record.constraints.scale
    largest = 0.0
    for k in range(saddle.order.shape[0]):
        unit = scale[saddle.row[saddle.order[k]]]
        largest = max(largest, saddle.S[saddle.S_start[k + 1] - 1] / (unit * unit))
    for k in range(saddle.order.shape[0]):
        row, mobile = saddle.order[k], saddle.S[saddle.S_start[k + 1] - 1]
        unit = scale[saddle.row[row]]
        saddle.shift[row] = SHARE * max(mobile, IMMOBILE * (largest if largest > 0.0 else 1.0) * unit * unit)


@leaf
def found_by_iteration(record):
    """Overwrite b with the solution of least length of S x = b; S and 1/α are left as they were. Whether it was found."""
    saddle, iterations = record.saddle, record.control.iterations
    shift_rows(record)
    for k in range(saddle.order.shape[0]):
        saddle.S[saddle.S_start[k + 1] - 1] += saddle.shift[saddle.order[k]]
    found = factorise(saddle, DEPENDENT, True) < 0
    if found:
        most, so_far = iterations[0], iterations[1]
        iterations[0] = MOST_ITERATIONS
        found = iterate_rows(saddle, iterations, 0.0, SETTLED) == OK
        iterations[0], iterations[1] = most, so_far
    for k in range(saddle.order.shape[0]):
        row = saddle.order[k]
        saddle.S[saddle.S_start[k + 1] - 1] -= saddle.shift[row]
        saddle.shift[row] = 0.0
    return found
