"""Dense linear systems without symmetry: LU by Gaussian elimination with exchanges of rows (Golub, Van Loan 2013, §3.4).

The kernels work on float64 and on complex128 alike.
"""

from __future__ import annotations

import numpy as np

from nivel.native.function import leaf


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
    return True


@leaf
def solve_lu(matrix, pivot, b):
    """Overwrite b (n,) with the solution, for factors of `factorise_lu`."""
    n = b.shape[0]
    for k in range(n):
        best = pivot[k]
        b[k], b[best] = b[best], b[k]
        for j in range(k):
            b[k] -= matrix[k, j] * b[j]
    for i in range(n):
        k = n - 1 - i
        for j in range(k + 1, n):
            b[k] -= matrix[k, j] * b[j]
        b[k] /= matrix[k, k]
