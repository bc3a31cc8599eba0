"""A matrix with the pattern of Newton's iteration: dense with exchanges of rows where it is full, sparse in a fixed order otherwise."""

from nivel.kernels.algebra.lu import factorise_lu, solve_lu
from nivel.kernels.algebra.sparse_lu import factorise_sparse_lu, solve_sparse_lu
from nivel.kernels.core.number import without_slopes
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf


@leaf
def factorise_entries(pattern, factors, failure):
    """Factors of the matrix with the entries `factors.value`.

    pattern : `row_start`, `column` and `lu` of the matrix. failure : (1,) gets the unknown without a pivot, where the matrix is sparse.
    Returns a status.
    """
    size = factors.matrix.shape[0]
    if size == 0 and factors.b.shape[0] > 0:
        failed = factorise_sparse_lu(pattern.lu, factors.value, factors.L, factors.U, factors.Dinv, factors.work)
        if failed >= 0:
            failure[0] = failed
        return OK if failed < 0 else NOT_CONVERGED
    factors.matrix[:, :] = 0.0
    for i in range(size):
        for p in range(pattern.row_start[i], pattern.row_start[i + 1]):
            factors.matrix[i, pattern.column[p]] = without_slopes(factors.value[p])
    return OK if factorise_lu(factors.matrix, factors.pivot) else NOT_CONVERGED


@leaf
def solve_entries(pattern, factors):
    """Overwrite factors.b with the solution, for factors of `factorise_entries`."""
    if factors.matrix.shape[0] == 0:
        solve_sparse_lu(pattern.lu, factors.L, factors.U, factors.Dinv, factors.b, factors.work)
    else:
        solve_lu(factors.matrix, factors.pivot, factors.b)


@leaf
def factorise(machine):
    """Factors of the matrix whose entries were found. Returns a status; the unknown without a pivot is left in control.failure."""
    record = record_at(machine)
    return factorise_entries(record.newton, record.newton, record.control.failure)


@leaf
def solve(machine):
    """Overwrite newton.b with the solution."""
    newton = record_at(machine).newton
    solve_entries(newton, newton)
