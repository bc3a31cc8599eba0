"""Symmetric positive semidefinite systems of known rank: Cholesky with diagonal pivoting, for machines with redundant rows.

S = P [L1; L2] [L1ᵀ L2ᵀ] Pᵀ with r columns. The basic solution of S x = b sets the last n - r unknowns (in pivot order) to zero;
subtracting its part in the null space, spanned by the columns of [-L1⁻ᵀ L2ᵀ; 1], leaves the one of least length. The rank r
comes from the analysis of the assembled machine, so no tolerance decides it anew at every step. Rows are scaled to a unit
diagonal first: "least length" then weighs λ_k² by S_kk and does not depend on units. Pivots are the rows that move most, in units of their
scales: in relative coordinates a row may lose its mobility where others keep theirs (a Bennett linkage in line), and by it the others would
be left open.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.native.function import leaf

DEPENDENT = 1e-13
# S_kk of a row against the most mobile one, in units of their scales, below which it counts as this share: what is left is round-off
IMMOBILE = 1e-10


@leaf
def gather(saddle, row_scale):
    """Copy S from its sparse form to the full symmetric matrix `dense`, in elimination order, scaled to a unit diagonal.

    Rows that nothing can move (those out of the plane of a tree that moves in a plane) have a diagonal of round-off, and nearly vanish.
    """
    K, scale = saddle.dense, saddle.Dinv
    K[:, :] = 0.0
    largest = 0.0
    for k in range(saddle.order.shape[0]):
        unit = row_scale[saddle.row[saddle.order[k]]]
        largest = max(largest, real(saddle.S[saddle.S_start[k + 1] - 1]) / (unit * unit))
    for k in range(saddle.order.shape[0]):
        last = saddle.S_start[k + 1]
        unit = row_scale[saddle.row[saddle.order[k]]]
        least = IMMOBILE * (largest if largest > 0.0 else 1.0) * unit * unit
        mobile = saddle.S[last - 1] if real(saddle.S[last - 1]) > least else least + 0.0 * saddle.S[last - 1]
        scale[k] = 1.0 / np.sqrt(mobile)
        for p in range(saddle.S_start[k], last):
            i = saddle.S_row[p]
            value = saddle.S[p] * scale[k] * scale[i]
            K[k, i] = value
            K[i, k] = value


@leaf
def mobility_left(saddle, row_scale, i):
    """What is left of S_kk of row i of the pivots, in units of its scale."""
    k = saddle.pivot[i]
    unit = real(saddle.Dinv[k]) * row_scale[saddle.row[saddle.order[k]]]
    return real(saddle.dense[i, i]) / (unit * unit)


@leaf
def factorise_pivoted(saddle, row_scale, rank):
    """Factor of `dense` in its lower triangle. Returns -1, or k where fewer than `rank` rows are independent."""
    K, pivot = saddle.dense, saddle.pivot
    n = K.shape[0]
    for k in range(n):
        pivot[k] = k
    for k in range(rank):
        best, largest = k, mobility_left(saddle, row_scale, k)
        for i in range(k + 1, n):
            mobile = mobility_left(saddle, row_scale, i)
            if mobile > largest:
                best, largest = i, mobile
        if not real(K[best, best]) > DEPENDENT:
            return np.int64(pivot[best])
        if best != k:
            for j in range(n):
                K[k, j], K[best, j] = K[best, j], K[k, j]
            for j in range(n):
                K[j, k], K[j, best] = K[j, best], K[j, k]
            pivot[k], pivot[best] = pivot[best], pivot[k]
        root = np.sqrt(K[k, k])
        K[k, k] = root
        for i in range(k + 1, n):
            K[i, k] /= root
        for i in range(k + 1, n):
            factor = K[i, k]
            for j in range(k + 1, i + 1):
                K[i, j] -= factor * K[j, k]
            for j in range(k + 1, i):
                K[j, i] = K[i, j]
    _null_space(saddle, rank)
    return np.int64(-1)


@leaf
def _null_space(saddle, rank):
    """X = L1⁻ᵀ L2ᵀ in the first `rank` rows of `null`; the Cholesky factor of 1 + XᵀX below them."""
    K, X = saddle.dense, saddle.null
    extra = X.shape[1]
    for m in range(extra):
        for i in range(rank):
            k = rank - 1 - i
            value = K[rank + m, k]
            for j in range(k + 1, rank):
                value -= K[j, k] * X[j, m]
            X[k, m] = value / K[k, k]
    for m in range(extra):
        for o in range(m + 1):
            value = 1.0 if m == o else 0.0
            for k in range(rank):
                value += X[k, m] * X[k, o]
            for k in range(o):
                value -= X[rank + m, k] * X[rank + o, k]
            X[rank + m, o] = np.sqrt(value) if m == o else value / X[rank + o, o]


@leaf
def solve_pivoted(saddle, rank):
    """Overwrite b (row order) with the solution of least length of S x = b."""
    K, X, y = saddle.dense, saddle.null, saddle.y
    n, extra = K.shape[0], X.shape[1]
    for k in range(rank):
        value = saddle.b[saddle.order[saddle.pivot[k]]] * saddle.Dinv[saddle.pivot[k]]
        for j in range(k):
            value -= K[k, j] * y[j]
        y[k] = value / K[k, k]
    for i in range(rank):
        k = rank - 1 - i
        value = y[k]
        for j in range(k + 1, rank):
            value -= K[j, k] * y[j]
        y[k] = value / K[k, k]
    # x -= N (NᵀN)⁻¹ Nᵀ x with N = [-X; 1] and the last unknowns zero
    for m in range(extra):
        value = 0.0 * y[0]
        for k in range(rank):
            value -= X[k, m] * y[k]
        for k in range(m):
            value -= X[rank + m, k] * y[rank + k]
        y[rank + m] = value / X[rank + m, m]
    for i in range(extra):
        m = extra - 1 - i
        value = y[rank + m]
        for o in range(m + 1, extra):
            value -= X[rank + o, m] * y[rank + o]
        y[rank + m] = value / X[rank + m, m]
    for m in range(extra):
        for k in range(rank):
            y[k] += X[k, m] * y[rank + m]
        y[rank + m] = -y[rank + m]
    for k in range(n):
        saddle.b[saddle.order[saddle.pivot[k]]] = y[k] * saddle.Dinv[saddle.pivot[k]]
    for k in range(n):
        y[k] = 0.0
