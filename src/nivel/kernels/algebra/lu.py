"""Dense linear systems without symmetry: LU by Gaussian elimination with exchanges of rows (Golub, Van Loan 2013, §3.4).

Factors are left transposed, with the inverses of the pivots on the diagonal: the solution goes column by column of them, COLUMNS at a
time, so that no sum waits for the one before it. That takes a quarter of the time of one row after the other for 35 unknowns.

The kernels work on float64 and on complex128 alike.
"""

import numpy as np

from nivel.native.function import leaf

# columns that a pass of the solution takes together
COLUMNS = 4


@leaf
def magnitude(x):
    """|Re x| + |Im x|: what pivots are compared by, cheaper than the absolute value of a complex number."""
    return np.abs(np.real(x)) + np.abs(np.imag(x))


@leaf
def factorise_lu(matrix, pivot):
    """Overwrite a matrix (n, n) with its factors; pivot[k] is the row that took place k. Returns whether it is regular."""
    n = matrix.shape[0]
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if magnitude(matrix[i, k]) > magnitude(matrix[best, k]):
                best = i
        pivot[k] = best
        if not magnitude(matrix[best, k]) > 0.0:
            return False
        if best != k:
            for j in range(n):
                matrix[k, j], matrix[best, j] = matrix[best, j], matrix[k, j]
        row = matrix[k, k + 1 : n]
        for i in range(k + 1, n):
            factor = matrix[i, k] / matrix[k, k]
            matrix[i, k] = factor
            if factor != 0.0:
                rest = matrix[i, k + 1 : n]
                for j in range(rest.shape[0]):
                    rest[j] -= factor * row[j]
    for k in range(n):
        matrix[k, k] = 1.0 / matrix[k, k]
        for j in range(k):
            matrix[k, j], matrix[j, k] = matrix[j, k], matrix[k, j]
    return True


@leaf
def solve_lu(matrix, pivot, b):
    """Overwrite b (n,) with the solution, for factors of `factorise_lu`."""
    n = b.shape[0]
    together = n - n % COLUMNS
    for k in range(n):
        best = pivot[k]
        b[k], b[best] = b[best], b[k]
    for k in range(0, together, COLUMNS):
        c0, c1, c2, c3 = matrix[k], matrix[k + 1], matrix[k + 2], matrix[k + 3]
        x0 = b[k]
        x1 = b[k + 1] - c0[k + 1] * x0
        x2 = b[k + 2] - c0[k + 2] * x0 - c1[k + 2] * x1
        x3 = b[k + 3] - c0[k + 3] * x0 - c1[k + 3] * x1 - c2[k + 3] * x2
        b[k + 1], b[k + 2], b[k + 3] = x1, x2, x3
        for i in range(k + COLUMNS, n):
            b[i] -= c0[i] * x0 + c1[i] * x1 + c2[i] * x2 + c3[i] * x3
    for k in range(together, n):
        for i in range(k + 1, n):
            b[i] -= matrix[k, i] * b[k]
    for m in range(n - together):
        k = n - 1 - m
        b[k] *= matrix[k, k]
        for i in range(k):
            b[i] -= matrix[k, i] * b[k]
    for m in range(0, together, COLUMNS):
        k = together - COLUMNS - m
        c0, c1, c2, c3 = matrix[k], matrix[k + 1], matrix[k + 2], matrix[k + 3]
        x3 = b[k + 3] * c3[k + 3]
        x2 = (b[k + 2] - c3[k + 2] * x3) * c2[k + 2]
        x1 = (b[k + 1] - c3[k + 1] * x3 - c2[k + 1] * x2) * c1[k + 1]
        x0 = (b[k] - c3[k] * x3 - c2[k] * x2 - c1[k] * x1) * c0[k]
        b[k], b[k + 1], b[k + 2], b[k + 3] = x0, x1, x2, x3
        for i in range(k):
            b[i] -= c0[i] * x0 + c1[i] * x1 + c2[i] * x2 + c3[i] * x3
