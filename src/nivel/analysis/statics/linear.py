"""Linear equations of statics: sparse factors, and how many directions of a stiffness are unstable."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from scipy.linalg import eigh, eigvalsh, null_space
from scipy.sparse import bmat, csc_matrix, diags
from scipy.sparse.linalg import splu

from nivel.analysis.statics.equations import Change, Sparse, Tangent
from nivel.system.system import Array

# Up to so many unknowns the null space of the constraints is made as a full matrix.
DENSE = 240
# Stiffness of the constraints in the count of the negative pivots of large machines, as a share of the largest stiffness.
STIFF = 1e7
# Pivots below this share of the largest are none.
NO_PIVOT = 1e-15


class NoPivot(Exception):
    """A matrix has no inverse."""


def factors(matrix: Sparse) -> Any:
    """LU factors with exchange of rows. Raises NoPivot where the matrix is singular to round-off."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found = splu(csc_matrix(matrix))
        except RuntimeError as error:
            raise NoPivot from error
    pivots = np.abs(found.U.diagonal())
    if not len(pivots) or not pivots.min() > NO_PIVOT * pivots.max():
        raise NoPivot
    return found


def solve(tangent: Tangent, r: Array, C: Array, shift: float = 0.0) -> Change:
    """x, λ with (K + shift) x + Cᵀ λ = r and C x = C."""
    if not len(r):
        return Change(np.zeros(0), np.zeros(len(C)))
    x = factors(tangent.saddle(shift)).solve(np.concatenate([r, C]))
    return Change(x[: len(r)], x[len(r) :])


def bordered(tangent: Tangent, border: Change) -> Any:
    """Factors of the saddle with time as a further unknown, held by a further row: regular at limit points."""
    size = len(border.q)
    column = np.concatenate([tangent.slope, tangent.opening])[:, None]
    row = np.concatenate([border.q, np.zeros(tangent.C.shape[0])])[None]
    if not size and not tangent.C.shape[0]:
        return factors(csc_matrix([[border.t]]))
    return factors(bmat([[tangent.saddle(), column], [row, [[border.t]]]]))


def solve_bordered(found: Any, r: Array, C: Array, last: float) -> Change:
    """x, λ and t for factors of `bordered`."""
    x = found.solve(np.concatenate([r, C, [last]]))
    return Change(x[: len(r)], x[len(r) : -1], float(x[-1]))


def free_directions(tangent: Tangent) -> Array:
    """Columns (f, ·): an orthonormal basis of the motions that all constraints allow."""
    return null_space(tangent.C.toarray()) if tangent.C.shape[0] else np.eye(tangent.K.shape[0])


def symmetric(matrix: Any) -> Any:
    """Its symmetric part: of a stiffness at an equilibrium of conservative forces, all of it."""
    return 0.5 * (matrix + matrix.T)


def negative_directions(tangent: Tangent, shift: float = 0.0) -> int:
    """Number of negative eigenvalues of K + shift on the motions that all constraints allow.

    Of small machines by these eigenvalues; of large ones by Sylvester's law of inertia, from the signs of the pivots of
    [K + shift, Cᵀ; C, -1/s], whose constraints are springs of a large stiffness s, eliminated without exchange of rows.
    """
    size = tangent.K.shape[0]
    if not size:
        return 0
    if size <= DENSE:
        Z = free_directions(tangent)
        values = eigvalsh(symmetric(Z.T @ (tangent.K @ Z)) + shift * np.eye(Z.shape[1])) if Z.shape[1] else np.zeros(0)
        return int(np.sum(values < 0.0))
    K = symmetric(tangent.K) + shift * diags(np.ones(size))
    rows = tangent.C.shape[0]
    matrix = bmat([[K, tangent.C.T], [tangent.C, diags(np.full(rows, -1.0 / STIFF))]]) if rows else K
    signs = _pivot_signs(csc_matrix(matrix))
    if signs is None:
        values, _ = lowest(tangent, 6)
        return int(np.sum(values + shift < 0.0))
    return int(np.sum(signs < 0)) - rows


def _pivot_signs(matrix: Sparse) -> Array | None:
    """Signs of the pivots of L D Lᵀ; None where one is too small, so that rows were exchanged."""
    try:
        found = splu(
            matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True, "Equil": False}
        )
    except RuntimeError:
        return None
    if not np.array_equal(found.perm_r, found.perm_c):
        return None
    return np.sign(found.U.diagonal())


def lowest(tangent: Tangent, count: int, metric: Sparse = None) -> tuple[Array, Array]:
    """(values (k,), directions (f, k)): eigenvalues of K φ = ω² M φ on the motions that all constraints allow, those next to zero, ascending.

    metric : M; absent, the unit matrix. Directions have φᵀ M φ = 1.
    Of large machines by inverse iteration with the factors of the saddle (Lanczos; shift and invert).
    """
    size = tangent.K.shape[0]
    M = diags(np.ones(size)) if metric is None else metric
    if size <= DENSE:
        Z = free_directions(tangent)
        if not Z.shape[1]:
            return np.zeros(0), np.zeros((size, 0))
        values, vectors = eigh(symmetric(Z.T @ (tangent.K @ Z)), symmetric(Z.T @ (M @ Z)))
        chosen = np.sort(np.argsort(np.abs(values), kind="stable")[:count]) if metric is None else np.arange(count)
        chosen = chosen[chosen < len(values)]
        return values[chosen], Z @ vectors[:, chosen]
    return _lanczos(tangent, count, M)


def _lanczos(tangent: Tangent, count: int, M: Sparse) -> tuple[Array, Array]:
    from scipy.sparse.linalg import LinearOperator, eigsh

    size, rows = tangent.K.shape[0], tangent.C.shape[0]
    count = min(count, size - rows - 1)
    if count < 1:
        return np.zeros(0), np.zeros((size, 0))
    K, shift, found = symmetric(tangent.K), 0.0, None
    for shift in (0.0, -1e-9, -1e-7, -1e-5):
        try:
            matrix = K - shift * M
            found = factors(bmat([[matrix, tangent.C.T], [tangent.C, None]]) if rows else matrix)
            break
        except NoPivot:
            continue
    if found is None:
        raise NoPivot
    last: Any = found

    def inverse(b: Array) -> Array:
        return last.solve(np.concatenate([np.ravel(b), np.zeros(rows)]))[:size]

    begin = inverse(M @ np.random.default_rng(0).standard_normal(size))
    operator = LinearOperator((size, size), matvec=inverse, dtype=float)  # type: ignore[call-arg]
    values, vectors = eigsh(K, k=count, M=csc_matrix(M), sigma=shift, OPinv=operator, v0=begin, which="LM")
    order = np.argsort(values)
    return values[order], vectors[:, order]
