"""The saddle-point system, eliminated body by body: S λ = C_q M⁻¹ Q - γ with S = C_q M⁻¹ C_qᵀ.

A formulation leaves the whitened blocks W = C_q L⁻ᵀ and forces z = L⁻¹ Q with M = L Lᵀ (block-diagonal, so body by body);
what follows is the same for all of them: S = W Wᵀ, right-hand side W z - γ, accelerations L⁻ᵀ (z - Wᵀ λ).
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.analytic import real
from nivel.kernels.compile import leaf, stage
from nivel.kernels.dense import factorise_pivoted, gather, solve_pivoted
from nivel.kernels.record import record_at
from nivel.kernels.sparse import factorise, solve
from nivel.kernels.status import OK, SINGULAR

CONTRADICTORY = 1e-3
# The augmented Lagrangian has converged where the square of its last change is below this share of the multipliers'.
SETTLED = 1e-24


@stage
def factorise_rows(machine, width):
    """Assemble and factorise S from W (blocks of `width` columns). Returns a status; on failure control.failure is the row."""
    record = record_at(machine)
    saddle = record.saddle
    W, S = saddle.W, saddle.S
    for p in range(S.shape[0]):
        S[p] = 0.0
    for p in range(saddle.pair.shape[0]):
        a, b = saddle.pair[p, 0], saddle.pair[p, 1]
        total = W[a, 0] * W[b, 0]
        for i in range(1, width):
            total += W[a, i] * W[b, i]
        S[saddle.pair[p, 2]] += total
    for k in range(saddle.order.shape[0]):
        S[saddle.S_start[k + 1] - 1] += saddle.shift[saddle.order[k]]
    if saddle.dense.shape[0] > 0:
        gather(saddle, record.constraints.scale)
        failed = factorise_pivoted(saddle, np.int64(record.control.rank[0]))
    else:
        failed = factorise(saddle)
    if failed >= 0:
        record.control.failure[0] = saddle.row[saddle.order[failed]]
        return SINGULAR
    return OK


@stage
def solve_rows(machine):
    """Overwrite b with the solution of S x = b, or of (S + 1/α) x = b for penalty methods.

    The augmented Lagrangian repeats (S + 1/α) xₖ₊₁ = b + xₖ/α, which is eq. 120 after elimination of the accelerations, until x is that
    of S x = b. It holds for dependent rows too.
    """
    record = record_at(machine)
    saddle, most = record.saddle, record.control.iterations
    if saddle.dense.shape[0] > 0:
        solve_pivoted(saddle, np.int64(record.control.rank[0]))
        return
    if most[0] <= 1:
        solve(saddle)
        return
    # b becomes the change d of x from one iteration to the next: (S + 1/α) dₖ₊₁ = dₖ/α
    b, x = saddle.b, saddle.target
    solve(saddle)
    for k in range(b.shape[0]):
        x[k] = b[k]
    for _ in range(1, most[0]):
        for k in range(b.shape[0]):
            b[k] *= saddle.shift[k]
        solve(saddle)
        most[1] += 1
        change, size = 0.0, 0.0
        for k in range(b.shape[0]):
            x[k] += b[k]
            change += saddle.shift[k] * real(b[k] * b[k])
            size += saddle.shift[k] * real(x[k] * x[k])
        if change <= SETTLED * size:
            break
    for k in range(b.shape[0]):
        b[k] = x[k]


@stage
def multipliers(machine, width):
    """λ from W, z, γ (with Baumgarte's terms, eq. 110), after `factorise_rows`; z becomes z - Wᵀ λ."""
    record = record_at(machine)
    saddle, constraints = record.saddle, record.constraints
    twice_alpha, beta_squared = record.control.stabilise[0], record.control.stabilise[1]
    b = saddle.b
    for k in range(b.shape[0]):
        row = saddle.row[k]
        b[k] = twice_alpha * constraints.Cdot[row] + beta_squared * constraints.C[row] - constraints.gamma[row]
    for k in range(saddle.blocks[0]):
        row, body = saddle.block[k, 0], saddle.block[k, 3]
        total = b[row]
        for i in range(width):
            total += saddle.W[k, i] * saddle.z[body, i]
        b[row] = total
    solve_rows(machine)
    for k in range(b.shape[0]):
        constraints.lam[saddle.row[k]] = b[k]
    subtract_rows(saddle, width)


@stage
def subtract_rows(saddle, width):
    """z -= Wᵀ b."""
    for k in range(saddle.blocks[0]):
        row, body = saddle.block[k, 0], saddle.block[k, 3]
        for i in range(width):
            saddle.z[body, i] -= saddle.W[k, i] * saddle.b[row]


@stage
def correction(machine, violation, width):
    """z = -Wᵀ S⁻¹ violation: the whitened change that removes a violation of the linearised rows, least in the mass metric."""
    record = record_at(machine)
    saddle = record.saddle
    for k in range(saddle.b.shape[0]):
        saddle.b[k] = violation[saddle.row[k]]
    solve_rows(machine)
    for body in range(saddle.z.shape[0]):
        for i in range(width):
            saddle.z[body, i] = 0.0
    subtract_rows(saddle, width)


@leaf
def contradicts(saddle, constraints, failure):
    """Whether a row of a redundant machine is open by more than CONTRADICTORY of its scale: it contradicts the rows that it repeated
    at the start. `failure` (1,) gets the row."""
    if saddle.dense.shape[0] == 0:
        return False
    for row in range(constraints.C.shape[0]):
        if np.abs(constraints.C[row]) > CONTRADICTORY * constraints.scale[row]:
            failure[0] = row
            return True
    return False


@stage
def exceeds(saddle, violation, scale, tolerance):
    """Whether any row of the saddle is violated by more than `tolerance` times its scale."""
    for k in range(saddle.row.shape[0]):
        row = saddle.row[k]
        limit = tolerance * scale[row]
        if violation[row] > limit or violation[row] < -limit:
            return True
    return False
