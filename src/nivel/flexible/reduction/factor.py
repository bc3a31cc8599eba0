"""Factors of sparse symmetric positive definite matrices, and the lowest modes of a pencil.

SuperLU as Cholesky's substitute: minimum degree of Aᵀ + A, symmetric mode, no pivoting. A boom of 69 000 freedoms takes
about two seconds, against fifteen with the ordering that SuperLU takes by itself.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp
import scipy.sparse.linalg as spl

from nivel.errors import SolveError
from nivel.flexible.model.model import Sparse
from nivel.machine.core.vectors import Array, Whole

Solve = Callable[[Array], Array]

DENSE: Final = 400  # freedoms up to which modes are computed with full matrices
NO_STIFFNESS: Final = 3e-14  # a pivot below this share of its diagonal element is what round-off left of zero
TOLERANCE: Final[Any] = 1e-10  # of eigenvalues, relative
STARTS: Final = 2  # random loads from which the softest motion is sought
BLOCK: Final = 16  # right-hand sides at once


class NoStiffnessError(Exception):
    """The matrix is not positive definite: `motion` (N,) costs no energy."""

    def __init__(self, motion: Array) -> None:
        self.motion = motion
        super().__init__("the matrix is singular")


class Factor:
    """The factor of a symmetric positive definite matrix (N, N)."""

    def __init__(self, matrix: Sparse) -> None:
        """Raises NoStiffnessError where the matrix is singular, or a soft motion has negative energy."""
        self._lu = None
        if matrix.shape[0] == 0:
            return
        self._lu = _decomposed(matrix)
        if self._lu is None or self._smallest_pivot(matrix.diagonal()) < NO_STIFFNESS:
            self._lu = None
            raise NoStiffnessError(_soft_motion(matrix))

    def _smallest_pivot(self, diagonal: Array) -> float:
        """The smallest pivot that any order of elimination has, as a share of its diagonal element.

        Eliminated last, a freedom has the pivot 1 / (A⁻¹)_ii, and A⁻¹ is x xᵀ / λ of the softest motion x, with xᵀ D x = 1 for the
        diagonal D and λ = xᵀ A x, but for what is stiffer. Two steps of inverse iteration from random loads give both. SuperLU tells
        its pivots only with a copy of the whole factor.
        """
        if diagonal.min() <= 0.0:
            return 0.0
        motion = np.random.default_rng(3).normal(size=(len(diagonal), STARTS)) / np.sqrt(diagonal)[:, None]
        softness = np.ones(STARTS)
        with np.errstate(all="ignore"):
            for _ in range(2):
                moved = self.solve(diagonal[:, None] * motion)
                softness = np.einsum("nk,n,nk->k", motion, diagonal, moved)
                motion = moved / np.sqrt(np.einsum("nk,n,nk->k", moved, diagonal, moved))
            pivot = 1.0 / softness / (motion**2 * diagonal[:, None]).max(axis=0)
        return float(pivot.min()) if np.all(np.isfinite(pivot)) else 0.0

    def solve(self, right: Array) -> Array:
        """(N,) or (N, k)"""
        if self._lu is None:
            return np.zeros_like(right)
        if right.ndim == 1 or right.shape[1] <= BLOCK:
            return self._lu.solve(np.asfortranarray(right))
        parts = [right[:, k : k + BLOCK] for k in range(0, right.shape[1], BLOCK)]
        return np.hstack([self._lu.solve(np.asfortranarray(part)) for part in parts])


def _decomposed(matrix: Sparse):
    try:
        return spl.splu(
            sp.csc_matrix(matrix), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
        )
    except RuntimeError:  # exactly singular
        return None


def _soft_motion(matrix: Sparse) -> Array:
    """(N,) the motion that costs least energy, by inverse iteration on the matrix with a little added to its diagonal."""
    diagonal = np.abs(matrix.diagonal())
    added = np.where(diagonal > 0.0, diagonal, diagonal.max() or 1.0)
    lu = _decomposed(sp.csc_array(matrix + sp.diags_array(1e-9 * added)))
    motion = np.random.default_rng(1).normal(size=matrix.shape[0])
    for _ in range(4 if lu is not None else 0):
        motion = lu.solve(added * motion)  # type: ignore[union-attr]
        motion = motion / np.abs(motion).max()
    return motion


def lowest_modes(K: Sparse, M: Sparse, count: int, solve: Solve, rigid: Array | None = None) -> tuple[Array, Array]:
    """The `count` lowest eigenvalues [1/s²] and M-orthonormal modes (N, count) of K φ = ω² M φ.

    solve : K⁻¹. rigid : (N, 6) M-orthonormal rigid modes of a K that is singular for them; they are left out, and `solve`
    is the inverse on what is M-orthogonal to them. Lanczos by ARPACK; full matrices where the model is small. Raises NoStiffnessError
    where a motion beside the rigid ones costs no energy.
    """
    size = K.shape[0]
    available = size - (0 if rigid is None else rigid.shape[1])
    count = min(count, available)
    if count <= 0:
        return np.zeros(0), np.zeros((size, 0))
    if size <= DENSE or 3 * count > size:
        return _dense_modes(K, M, count, rigid)
    operator: Any = spl.LinearOperator((size, size), matvec=solve, dtype=float)  # type: ignore[call-arg]
    start = solve(np.random.default_rng(2).normal(size=size))
    try:
        values, vectors = spl.eigsh(K, k=count, M=M, sigma=0.0, OPinv=operator, v0=start, tol=TOLERANCE)
    except spl.ArpackNoConvergence as error:
        raise SolveError(f"{count} modes were not found: {error}", time=0.0, advice="ask for fewer modes") from None
    order = np.argsort(values)
    return values[order], vectors[:, order]


def _dense_modes(K: Sparse, M: Sparse, count: int, rigid: Array | None) -> tuple[Array, Array]:
    full_K, full_M = K.toarray(), M.toarray()
    basis = np.eye(len(full_K)) if rigid is None else la.null_space((full_M @ rigid).T)
    small_K, small_M = basis.T @ full_K @ basis, basis.T @ full_M @ basis
    # freedoms may have no mass: the inverse pencil M φ = (1/ω²) K φ does not mind
    try:
        inverse, vectors = la.eigh(_symmetric(small_M), _symmetric(small_K))
    except la.LinAlgError:  # K is not positive definite
        raise NoStiffnessError(basis @ la.eigh(_symmetric(small_K))[1][:, 0]) from None
    order = np.argsort(inverse)[::-1][:count]
    order = order[inverse[order] > 1e-14 * inverse[order[0]]]
    vectors = basis @ vectors[:, order]
    return 1.0 / inverse[order], vectors / np.sqrt(inverse[order])


def _symmetric(matrix: Array) -> Array:
    return 0.5 * (matrix + matrix.T)


def determinate(rigid: Array) -> Whole:
    """(6,) rows of rigid modes (N, 6) that, held, stop every rigid motion: far apart, by pivoted QR."""
    scaled = rigid / np.abs(rigid).max(axis=0)
    return np.sort(pivots(scaled.T)[: rigid.shape[1]])


def pivots(matrix: Array) -> Whole:
    """(n,) columns of (m, n) in the order in which QR with pivoting takes them: the first m are as independent as can be."""
    order: Any = la.qr(matrix, mode="r", pivoting=True)[-1]
    return np.asarray(order, dtype=np.int64)
