"""The matrix of Newton's iteration: dense with exchanges of rows where it is full, sparse in a fixed order otherwise."""

from __future__ import annotations

from nivel.kernels.compile import stage
from nivel.kernels.lu import factorise_lu, solve_lu
from nivel.kernels.record import record_at
from nivel.kernels.sparse_lu import factorise_sparse_lu, solve_sparse_lu
from nivel.kernels.status import NOT_CONVERGED, OK


@stage
def factorise(machine):
    """Factors of the matrix whose entries were found. Returns a status; the unknown without a pivot is left in control.failure."""
    record = record_at(machine)
    newton = record.newton
    size = newton.matrix.shape[0]
    if size == 0 and newton.b.shape[0] > 0:
        failed = factorise_sparse_lu(newton.lu, newton.value, newton.L, newton.U, newton.Dinv, newton.work)
        if failed >= 0:
            record.control.failure[0] = failed
        return OK if failed < 0 else NOT_CONVERGED
    newton.matrix[:, :] = 0.0
    for i in range(size):
        for p in range(newton.row_start[i], newton.row_start[i + 1]):
            newton.matrix[i, newton.column[p]] = newton.value[p]
    return OK if factorise_lu(newton.matrix, newton.pivot) else NOT_CONVERGED


@stage
def solve(machine):
    """Overwrite newton.b with the solution."""
    newton = record_at(machine).newton
    if newton.matrix.shape[0] == 0:
        solve_sparse_lu(newton.lu, newton.L, newton.U, newton.Dinv, newton.b, newton.work)
    else:
        solve_lu(newton.matrix, newton.pivot, newton.b)
