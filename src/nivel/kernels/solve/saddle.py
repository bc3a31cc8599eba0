"""The saddle-point system, eliminated body by body: S λ = C_q M⁻¹ Q - γ with S = C_q M⁻¹ C_qᵀ.

A formulation leaves the whitened blocks W = C_q L⁻ᵀ and forces z = L⁻¹ Q with M = L Lᵀ (block-diagonal, so body by body);
what follows is the same for all of them: S = W Wᵀ, right-hand side W z - γ, accelerations L⁻ᵀ (z - Wᵀ λ).
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.dense import factorise_pivoted, gather, solve_pivoted
from nivel.kernels.algebra.rows import clear, copy
from nivel.kernels.algebra.sparse import DEPENDENT, factorise, solve
from nivel.kernels.core.number import where
from nivel.kernels.core.status import MULTIPLIERS_NOT_FOUND, OK, SINGULAR
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

# places of control.rank: how many rows are independent; how many of a redundant machine are left out of the factor; whether the last
# factor is the pivoted one
RANK, LEFT_OUT, PIVOTED = 0, 1, 2
# Rows of a redundant machine are chosen anew where the smallest pivot, as a share of the most mobile row, has fallen to this share of the
# largest that it has been since the choice. What kept rows are open by is then up to ten times as much in those left out.
WORSE = 1e-2
CONTRADICTORY = 1e-3
# The augmented Lagrangian has converged where what its last change does, squared, is below this share of what all forces do, unless
# somebody wants another one.
SETTLED = 1e-24
# Its last iterate is good enough where the iterations to come, as a geometric series, would do less than this share, squared.
GOOD_ENOUGH = 1e-12
# That series is not taken for slower than this: then round-off would count.
SLOWEST = 1.0 - 1e-4
# A singular position, where it does not converge, may last for so many evaluations; at the start of a run for none.
MOST_UNSETTLED = 200


@stage
def factorise_rows(machine, width):
    """Assemble and factorise S from W (blocks of `width` columns). Returns a status; on failure control.failure is the row.

    Of a redundant machine rows that repeat others are left out. Where those that stay come near to depending on each other, although
    others do not (a Bennett linkage in line), and where nothing is known of them, rows are chosen by pivots.
    """
    record = record_at(machine)
    saddle = record.saddle
    W, S = saddle.W, saddle.S
    clear(S)
    for p in range(saddle.pair.shape[0]):
        a, b = saddle.pair[p, 0], saddle.pair[p, 1]
        total = W[a, 0] * W[b, 0]
        for i in range(1, width):
            total += W[a, i] * W[b, i]
        S[saddle.pair[p, 2]] += total
    for k in range(saddle.order.shape[0]):
        S[saddle.S_start[k + 1] - 1] += saddle.shift[saddle.order[k]]
    rank, redundant = record.control.rank, saddle.dense.shape[0] > 0
    failed = 0
    if rank[LEFT_OUT] > 0 or not redundant:
        failed = factorise(saddle, DEPENDENT, False)
    chosen = redundant and rank[LEFT_OUT] > 0
    rank[PIVOTED] = 1 if redundant and (not chosen or failed >= 0 or have_worsened(record)) else 0
    if rank[PIVOTED] == 1:
        failed = factorise_by_pivots(record)
        if chosen and failed < 0:
            choose_rows(record)
    if failed >= 0:
        record.control.failure[0] = saddle.row[saddle.order[failed]]
        return SINGULAR
    return OK


@leaf
def have_worsened(record):
    """Whether the rows that stay in the factor of S just made are much nearer to depending on each other than they once were."""
    saddle, best, scale = record.saddle, record.control.settled, record.constraints.scale
    smallest, largest = np.inf, 0.0
    for k in range(saddle.order.shape[0]):
        unit = scale[saddle.row[saddle.order[k]]]
        largest = max(largest, real(saddle.S[saddle.S_start[k + 1] - 1]) / (unit * unit))
        if saddle.least[k] > 0.0:
            smallest = min(smallest, 1.0 / (real(saddle.Dinv[k]) * unit * unit))
    if largest == 0.0:
        return False
    if smallest < WORSE * best[1] * largest:
        return True
    best[1] = max(best[1], smallest / largest)
    return False


@leaf
def choose_rows(record):
    """Let the rows of the pivoted factor stay from now on, and leave the others out."""
    saddle, rank = record.saddle, np.int64(record.control.rank[RANK])
    for k in range(saddle.pivot.shape[0]):
        bound = np.abs(saddle.least[saddle.pivot[k]])
        saddle.least[saddle.pivot[k]] = bound if k < rank else -bound
    record.control.settled[1] = 0.0


@leaf
def factorise_by_pivots(record):
    """The pivoted factor of S, of all rows. Returns -1, or a place in the order of elimination where too few rows are independent."""
    saddle, scale = record.saddle, record.constraints.scale
    gather(saddle, scale)
    return factorise_pivoted(saddle, scale, np.int64(record.control.rank[RANK]))


@stage
def solve_rows(machine, forces):
    """Overwrite b with the solution of S x = b, or of (S + 1/α) x = b for penalty methods. Returns a status. Rows that are left out get 0;
    of pivoted rows it is the solution of least length.

    forces : zᵀ z of what b comes from, 0 where it comes from nothing else; round-off is judged by it.
    """
    record = record_at(machine)
    saddle = record.saddle
    if record.control.rank[PIVOTED] == 1:
        solve_pivoted(saddle, np.int64(record.control.rank[RANK]))
        return OK
    if record.control.iterations[0] <= 1:
        solve(saddle)
        return OK
    return iterate_rows(saddle, record.control.iterations, forces, record.control.settled[0])


@stage
def iterate_rows(saddle, most, forces, settled):
    """Augmented Lagrangian: (S + 1/α) xₖ₊₁ = b + xₖ/α, eq. 120 after elimination of the accelerations, until x is that of S x = b.

    In changes d of x: (S + 1/α) dₖ₊₁ = dₖ/α. What d does is the acceleration energy dᵀ S d = Σ (dₖ - dₖ₊₁) dₖ₊₁/α, which multipliers
    of dependent rows, never settled, have no part in. It ends below the share `settled` of `forces`. Returns a status.
    """
    b, x, before = saddle.b, saddle.target, saddle.before
    copy(b, x)
    solve(saddle)
    for k in range(b.shape[0]):
        forces += real(b[k] * (x[k] - saddle.shift[k] * b[k]))
        x[k] = b[k]
    last, done = 0.0, 0.0
    for _ in range(1, most[0]):
        for k in range(b.shape[0]):
            before[k] = b[k]
            b[k] *= saddle.shift[k]
        solve(saddle)
        most[1] += 1
        last, done = done, 0.0
        for k in range(b.shape[0]):
            x[k] += b[k]
            done += saddle.shift[k] * real((before[k] - b[k]) * b[k])
        if done <= settled * forces:
            break
    copy(x, b)
    left = 1.0 - min((done / last) ** 0.5, SLOWEST) if last > done > 0.0 else 1.0 - SLOWEST
    return OK if done <= max(settled, GOOD_ENOUGH * left * left) * forces else MULTIPLIERS_NOT_FOUND


@stage
def multipliers(machine, width):
    """λ from W, z, γ (with Baumgarte's terms, eq. 110), after `factorise_rows`; z becomes z - Wᵀ λ. Returns a status."""
    record = record_at(machine)
    saddle, constraints = record.saddle, record.constraints
    twice_alpha, beta_squared = record.control.stabilise[0], record.control.stabilise[1]
    b, own = saddle.b, record.control.feedback
    for k in range(b.shape[0]):
        row = saddle.row[k]
        fed_back = twice_alpha * own[row, 0] * constraints.Cdot[row] + beta_squared * own[row, 1] * constraints.C[row]
        b[k] = fed_back - constraints.gamma[row]
    for k in range(saddle.blocks[0]):
        row, body = saddle.block[k, 0], saddle.block[k, 3]
        total = b[row]
        for i in range(width):
            total += saddle.W[k, i] * saddle.z[body, i]
        b[row] = total
    forces = 0.0
    if record.control.iterations[0] > 1:
        for body in range(saddle.z.shape[0]):
            for i in range(width):
                forces += real(saddle.z[body, i] * saddle.z[body, i])
    status = solve_rows(machine, forces)
    unsettled = record.control.iterations[2:3]
    unsettled[0] = 0 if status == OK else unsettled[0] + 1
    if unsettled[0] <= MOST_UNSETTLED:
        status = OK
    for k in range(b.shape[0]):
        constraints.lam[saddle.row[k]] = b[k]
    subtract_rows(saddle, width)
    return status


@stage
def subtract_rows(saddle, width):
    """z -= Wᵀ b."""
    for k in range(saddle.blocks[0]):
        row, body = saddle.block[k, 0], saddle.block[k, 3]
        for i in range(width):
            saddle.z[body, i] -= saddle.W[k, i] * saddle.b[row]


@stage
def correction(machine, violation, share, width):
    """z = -Wᵀ S⁻¹ violation: the whitened change that removes a share of the violation of the linearised rows, least in the mass metric."""
    record = record_at(machine)
    saddle = record.saddle
    for k in range(saddle.b.shape[0]):
        saddle.b[k] = share * violation[saddle.row[k]]
    solve_rows(machine, 0.0)
    for body in range(saddle.z.shape[0]):
        clear(saddle.z[body])
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
    rows = 0.0
    for k in range(saddle.row.shape[0]):
        row = saddle.row[k]
        rows = where(np.abs(violation[row]) > tolerance * scale[row], 1.0, rows)
    return rows > 0.0
