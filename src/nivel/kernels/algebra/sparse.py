"""Symmetric positive definite systems with a fixed pattern: L D Lᵀ row by row, symbolic part done once when the machine is built.

The up-looking method (Davis 2005, "Algorithm 849", §2): row k of L solves a triangular system with the rows above it; its pattern
is known, so there is no search and no allocation.

Rows that repeat others (`least` negative) are left out: their rows and columns of L are zero, and so is 1/D, so the
solution has zeros there and satisfies the other rows.
"""

from nivel.kernels.algebra.analytic import real
from nivel.native.function import stage

# A pivot this small against its diagonal is round-off: the row depends on the rows before it.
DEPENDENT = 1e-13


@stage
def factorise(saddle, dependent, whole):
    """L and 1/D of S. Returns -1, or k where row `order[k]` depends on the rows eliminated before it.

    dependent : a pivot below this share of its diagonal says so. whole : rows that are left out are taken in as well.
    """
    L, Dinv, y = saddle.L, saddle.Dinv, saddle.y
    for k in range(saddle.order.shape[0]):
        if saddle.least[k] < 0.0 and not whole:
            for e in range(saddle.P_start[k], saddle.P_start[k + 1]):
                L[saddle.P_entry[e]] = 0.0
            Dinv[k] = 0.0
            continue
        for p in range(saddle.S_start[k], saddle.S_start[k + 1]):
            y[saddle.S_row[p]] = saddle.S[p]
        diagonal = y[k]
        pivot = diagonal
        y[k] = 0.0
        for e in range(saddle.P_start[k], saddle.P_start[k + 1]):
            j = saddle.P_column[e]
            last = saddle.P_entry[e]
            yj = y[j]
            y[j] = 0.0
            if real(Dinv[j]) == 0.0:
                L[last] = 0.0
                continue
            for p in range(saddle.L_start[j], last):
                y[saddle.L_row[p]] -= L[p] * yj
            entry = yj * Dinv[j]
            pivot -= entry * yj
            L[last] = entry
        if not (real(pivot) > dependent * real(diagonal) and (whole or real(pivot) > saddle.least[k])):
            return k
        Dinv[k] = 1.0 / pivot
    return -1


@stage
def solve(saddle):
    """Overwrite b (row order) with the solution of S x = b."""
    L, y = saddle.L, saddle.y
    n = saddle.order.shape[0]
    for k in range(n):
        y[k] = saddle.b[saddle.order[k]]
    for j in range(n):
        yj = y[j]
        for p in range(saddle.L_start[j], saddle.L_start[j + 1]):
            y[saddle.L_row[p]] -= L[p] * yj
    for i in range(n):
        j = n - 1 - i
        yj = y[j] * saddle.Dinv[j]
        for p in range(saddle.L_start[j], saddle.L_start[j + 1]):
            yj -= L[p] * y[saddle.L_row[p]]
        y[j] = yj
    for k in range(n):
        saddle.b[saddle.order[k]] = y[k]
        y[k] = 0.0
