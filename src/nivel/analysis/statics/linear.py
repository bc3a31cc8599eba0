"""Linear equations of statics: sparse factors, and how many directions of a stiffness are unstable."""

from typing import Any

import numpy as np
from scipy import linalg
from scipy.linalg import eig, eigh
from scipy.sparse import bmat, csc_matrix, diags
from scipy.sparse.linalg import ArpackNoConvergence, splu

from nivel.analysis.statics.equations import Change, Sparse, Tangent
from nivel.lazy import Struct, replace, scipy
from nivel.system.system import Array

# Up to so many unknowns the null space of the constraints is made as a full matrix.
DENSE = 240
# Up to so many rows matrices are factorised as full ones.
FULL = 60
# Stiffness of the constraints in the count of the negative pivots of large machines, as a share of the largest stiffness.
STIFF = 1e7
# Forces without a potential make a stiffness that is unsymmetric by more than this share.
UNSYMMETRIC = 1e-8
# Eigenvalues with larger imaginary parts than this share are pairs of complex ones.
REAL = 1e-7
# Eigenvalues next to zero that are looked at where pivots do not tell.
FEW = 6
# Or so many, until they are stiffer than this share of the largest stiffness, next to which pivots tell.
NEAR_ZERO, SOFT = (12, 48, 150), 1e-5
# A stiffness φᵀ K φ below this share of |φ|ᵀ |K| |φ| is round-off.
CANCELLED = 1e-13
# Stiffness below this share of the largest is round-off.
NO_STIFFNESS = 3e-14
# Shifts, as shares of the largest ω² that stiffness and mass can make, with which a matrix without an inverse is tried.
SHIFTS = (0.0, 1e-15, 1e-13, 1e-11, 1e-9)
# Pivots below this share of the largest are none.
NO_PIVOT = 1e-15
# LU factors of a full matrix, and solutions with them
getrf, getrs = linalg.get_lapack_funcs(("getrf", "getrs"), dtype=np.float64)


class PivotError(Exception):
    """A matrix has no inverse."""


def factors(matrix: Sparse) -> Any:
    """LU factors with exchange of rows. Raises PivotError where the matrix is singular to round-off."""
    if matrix.shape[0] <= FULL:
        return _Full(matrix.toarray())
    try:
        found = splu(csc_matrix(matrix))
    except RuntimeError as error:
        raise PivotError from error
    _refuse_small(found.U.diagonal())
    return found


def saddle_factors(tangent: Tangent, shift: float = 0.0) -> Any:
    """LU factors of [K + shift, Cᵀ; C, 0]. Raises PivotError where it is singular to round-off."""
    small = tangent.K.shape[0] + tangent.C.shape[0] <= FULL
    return _Full(tangent.full_saddle(shift)) if small else factors(tangent.saddle(shift))


class _Full:
    """Factors of a small matrix."""

    def __init__(self, matrix: Array) -> None:
        self._lu, self._pivots, _ = getrf(matrix)  # a pivot of zero is told below
        _refuse_small(np.diagonal(self._lu))

    def solve(self, b: Array) -> Array:
        return getrs(self._lu, self._pivots, b)[0]


def _refuse_small(pivots: Array) -> None:
    size = np.abs(pivots)
    if not len(size) or not size.min() > NO_PIVOT * size.max():
        raise PivotError


def solve(tangent: Tangent, r: Array, C: Array, shift: float = 0.0) -> Change:
    """x, λ with (K + shift) x + Cᵀ λ = r and C x = C."""
    if not len(r):
        return Change(np.zeros(0), np.zeros(len(C)))
    x = saddle_factors(tangent, shift).solve(np.concatenate([r, C]))
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


def is_small(tangent: Tangent, count: int = 0) -> bool:
    """Whether full matrices are the way to `count` eigenvalues: few unknowns, or few motions, among which Lanczos's method goes astray."""
    size, rows = tangent.K.shape[0], tangent.C.shape[0]
    return size <= DENSE or (count > 0 and size - rows <= max(2 * count + 1, 20) + FEW)


def has_potential(tangent: Tangent) -> bool:
    """Whether the stiffness is symmetric, as it is in equilibrium where all forces have a potential."""
    largest = float(np.abs(tangent.K).max()) if tangent.K.nnz else 0.0
    return not tangent.K.nnz or float(np.abs(tangent.K - tangent.K.T).max()) <= UNSYMMETRIC * largest


def unstable_directions(tangent: Tangent) -> int:
    """Number of directions in which an equilibrium is unstable: of negative stiffness.

    Where forces have no potential (they follow a body, or moments keep their axis), the number of real negative eigenvalues of
    K φ = ω² M φ, in large machines of those next to zero.
    """
    if has_potential(tangent):
        return negative_directions(tangent)
    values, _ = lowest(tangent, tangent.K.shape[0] if is_small(tangent) else FEW, tangent.M)
    return int(np.sum(values < 0.0))


def symmetric(matrix: Any) -> Any:
    """Its symmetric part: of a stiffness at an equilibrium of conservative forces, all of it."""
    return 0.5 * (matrix + matrix.T)


def negative_directions(tangent: Tangent, shift: float = 0.0) -> int:
    """Number of negative eigenvalues of K + shift on the motions that all constraints allow.

    Of small machines by these eigenvalues; of large ones by Sylvester's law of inertia, from the signs of the pivots of K + shift + s Cᵀ C,
    in which constraints are springs of a large stiffness s, eliminated without exchange of rows. Where a pivot is negative, eigenvalues
    next to zero are looked at one by one, since a rigid motion and a soft one may have lost their sign to round-off and to these springs.
    """
    size = tangent.K.shape[0]
    if not size:
        return 0
    if is_small(tangent):
        Z = tangent.free_directions
        values = (
            linalg.eigvalsh(symmetric(Z.T @ (tangent.K @ Z)) + shift * np.eye(Z.shape[1]))
            if Z.shape[1]
            else np.zeros(0)
        )
        return int(np.sum(values < -NO_STIFFNESS * np.max(np.abs(values), initial=0.0)))
    largest = float(np.abs(tangent.K).max()) if tangent.K.nnz else 0.0
    K = symmetric(tangent.K) + (shift + NO_STIFFNESS * largest) * diags(np.ones(size))
    signs = _pivot_signs(csc_matrix(K + STIFF * (tangent.C.T @ tangent.C)))
    if signs is not None and not np.any(signs < 0):
        return 0
    near, reach = _negative_near_zero(replace(tangent, K=csc_matrix(K)))
    further = _pivot_signs(csc_matrix(K + reach * diags(np.ones(size)) + STIFF * (tangent.C.T @ tangent.C)))
    return near + (0 if further is None else int(np.sum(further < 0)))


def _negative_near_zero(tangent: Tangent) -> tuple[int, float]:
    """(how many eigenvalues of K are negative, to what distance from zero); those below the round-off of their terms, |φ|ᵀ |K| |φ|,
    are zero."""
    size = tangent.K.shape[0]
    unit, largest = diags(np.ones(size)), float(np.abs(tangent.K).max())
    alike, count, reach = replace(tangent, inertia=lambda: csc_matrix(unit)), 0, 0.0
    for more in NEAR_ZERO:
        _, shapes = _lanczos(alike, more, unit)
        values = np.einsum("ik,ik->k", shapes, symmetric(tangent.K) @ shapes)
        known = np.einsum("ik,ik->k", np.abs(shapes), np.abs(tangent.K) @ np.abs(shapes))
        reach = float(np.max(np.abs(values), initial=0.0))
        count = int(np.sum((values < -CANCELLED * known) & (np.abs(values) < reach)))
        if reach > SOFT * largest or shapes.shape[1] < more:
            break
    return count, reach * (1.0 - 1e-6)


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


def lowest(tangent: Tangent, count: int, metric: Sparse = None, *, nearest: bool = False) -> tuple[Array, Array]:
    """(values (k,), directions (f, k)): the lowest eigenvalues of K φ = ω² M φ on the motions that all constraints allow, ascending.

    metric : M; absent, the unit matrix. Directions have φᵀ M φ = 1. nearest : those next to zero; of large machines always.
    Of an unsymmetric K the real eigenvalues, and the real parts of complex pairs where these are positive.
    Of large machines by inverse iteration with the factors of the saddle (Lanczos; shift and invert).
    """
    size = tangent.K.shape[0]
    M = diags(np.ones(size)) if metric is None else metric
    if is_small(tangent, count):
        Z = tangent.free_directions
        if not Z.shape[1]:
            return np.zeros(0), np.zeros((size, 0))
        inner = Z.T @ (tangent.K @ Z), symmetric(Z.T @ (M @ Z))
        values, vectors = symmetric_modes(symmetric(inner[0]), inner[1]) if has_potential(tangent) else _general(*inner)
        order = np.argsort(np.abs(values), kind="stable") if nearest else np.arange(len(values))
        chosen = np.sort(order[:count])
        return values[chosen], Z @ vectors[:, chosen]
    values, vectors = _lanczos(tangent, count, M)
    unstable = 0 if nearest or not has_potential(tangent) else negative_directions(tangent)
    if np.sum(values < 0.0) >= unstable:
        return values, vectors
    # what is most unstable may be far from zero: of 1/(ω² - shift) all that are negative
    try:
        below, directions = _lanczos(tangent, unstable, M, "SA")
    except ArpackNoConvergence:
        return values, vectors
    down, up = below < 0.0, values >= 0.0
    values = np.concatenate([below[down], values[up]])[:count]
    return values, np.hstack([directions[:, down], vectors[:, up]])[:, :count]


def symmetric_modes(K: Array, M: Array) -> tuple[Array, Array]:
    """Eigenvalues and directions of K φ = ω² M φ, ascending. Every ω² is known to ε times the largest, which is nothing of the low ones
    where rotations of hardly any inertia are stiff. Those nearest to zero are taken from Lᵀ K⁻¹ L x = x/ω², M = L Lᵀ.

    Raises PivotError where M is not positive to round-off.
    """
    try:
        values, vectors = linalg.eigh(K, M)
    except linalg.LinAlgError as error:
        raise PivotError from error
    L, largest = linalg.cholesky(M, lower=True), float(np.max(np.abs(values), initial=0.0))
    for share in SHIFTS:
        shift = -share * largest
        try:
            inverse = _Full(K - shift * M).solve(L)
        except PivotError:
            continue
        theta, x = linalg.eigh(symmetric(L.T @ inverse))
        size = np.abs(theta)
        near = size > np.sqrt(size.max() * size.min())
        far = np.argsort(np.abs(values - shift), kind="stable")[int(near.sum()) :]
        low = linalg.solve_triangular(L, x[:, near], lower=True, trans=1)
        values = np.concatenate([1.0 / theta[near] + shift, values[far]])
        order = np.argsort(values, kind="stable")
        return values[order], np.hstack([low, vectors[:, far]])[:, order]
    return values, vectors


def _general(K: Array, M: Array) -> tuple[Array, Array]:
    """Real eigenvalues and complex pairs (their positive real parts, once) of an unsymmetric matrix, ascending, with real directions."""
    found: Any = linalg.eig(K, M)
    return _real(np.asarray(found[0]), np.asarray(found[1]), M)


def _real(values: Any, vectors: Any, M: Any) -> tuple[Array, Array]:
    real = np.abs(values.imag) <= REAL * np.abs(values)
    kept = real | ((values.imag > 0.0) & (values.real > 0.0))
    values, vectors = values[kept], vectors[:, kept]
    # a complex direction is turned so that its largest part is real
    largest = vectors[np.argmax(np.abs(vectors), axis=0), np.arange(vectors.shape[1])]
    shapes = (vectors / np.where(largest == 0.0, 1.0, largest)).real
    shapes = shapes / np.sqrt(np.einsum("ik,ik->k", shapes, M @ shapes))
    order = np.argsort(values.real, kind="stable")
    return values.real[order], shapes[:, order]


def fastest(tangent: Tangent) -> float:
    """The size of the largest squares of frequencies: stiffness over mass of single unknowns [1/s²]."""
    K, M = np.abs(tangent.K.diagonal()), np.abs(tangent.M.diagonal())
    massive = M > 0.0
    found = float(np.max(K[massive] / M[massive], initial=0.0))
    return found or 1.0


def _lanczos(tangent: Tangent, count: int, M: Sparse, which: str = "LM") -> tuple[Array, Array]:
    size, rows = tangent.K.shape[0], tangent.C.shape[0]
    count = min(count, size - rows - 1)
    if count < 1:
        return np.zeros(0), np.zeros((size, 0))
    even = has_potential(tangent)
    K, shift, found = symmetric(tangent.K) if even else tangent.K, 0.0, None
    for share in SHIFTS:
        shift = -share * fastest(tangent)
        try:
            matrix = K - shift * M
            found = factors(bmat([[matrix, tangent.C.T], [tangent.C, None]]) if rows else matrix)
            break
        except PivotError:
            continue
    if found is None:
        raise PivotError
    last: Any = found

    def inverse(b: Array) -> Array:
        return last.solve(np.concatenate([np.ravel(b), np.zeros(rows)]))[:size]

    begin = inverse(M @ np.random.default_rng(0).standard_normal(size))
    operator = scipy.sparse.linalg.LinearOperator((size, size), matvec=inverse, dtype=float)  # type: ignore[call-arg]
    mass = csc_matrix(M)
    if not even:
        found_pairs: Any = scipy.sparse.linalg.eigs(
            K, k=count, M=mass, sigma=shift, OPinv=operator, v0=begin, which="LM"
        )
        return _real(found_pairs[0], found_pairs[1], mass)
    values, vectors = scipy.sparse.linalg.eigsh(K, k=count, M=mass, sigma=shift, OPinv=operator, v0=begin, which=which)
    order = np.argsort(values)
    return values[order], vectors[:, order]


# Small vibrations about an equilibrium: natural frequencies, modes, damping, and linearised buckling loads.

# Squares of frequencies ω² = φᵀ K φ below this share of |φ|ᵀ |K| |φ| are round-off: rigid motions. Where forces have no potential all are
# known to such a share of the largest only.
ROUND_OFF = 1e-13
# Squares of frequencies below this share of the largest are zero, since a frequency of 1e-12 of another one is not computed.
NONE = 1e-24
# Machines of up to so many unknowns get their damping: the eigenvalues of a full matrix of twice the size.
DAMPED = 400


class Vibrations(Struct):
    """squares : ω² (k,) [1/s²] ascending, negative where the equilibrium is unstable, zero of rigid motions; shapes (f, k) with unit modal
    mass, without units.

    rates : complex s (k,) [1/s] of the damped motions e^{st}, by |s|, one of each pair; NaN where there are none or the machine is large.
    rigid : how many of the squares are zero.
    """

    squares: Array
    shapes: Array
    rates: Array
    rigid: int


def vibrations(tangent: Tangent, count: int) -> Vibrations:
    """The `count` lowest vibrations about the equilibrium of a tangent."""
    squares, shapes = lowest(tangent, count, tangent.M)
    known = np.einsum("ik,ik->k", np.abs(shapes), np.abs(tangent.K) @ np.abs(shapes))
    still = (np.abs(squares) <= ROUND_OFF * known) | (np.abs(squares) <= NONE * fastest(tangent))
    if not has_potential(tangent):
        still |= np.abs(squares) <= ROUND_OFF * _largest(tangent)
    squares = np.where(still, 0.0, squares)
    rates = np.full(count, np.nan, dtype=complex)
    if tangent.K.shape[0] <= DAMPED and tangent.D.count_nonzero():
        found = _damped(tangent)[:count]
        rates[: len(found)] = found
    filled = np.full(count, np.nan)
    filled[: len(squares)] = squares
    all_shapes = np.full((tangent.K.shape[0], count), np.nan)
    all_shapes[:, : len(squares)] = shapes
    return Vibrations(filled, all_shapes, rates, int(np.sum(still)))


def _largest(tangent: Tangent) -> float:
    """Largest square of a frequency; of large machines its size."""
    if not tangent.K.shape[0]:
        return 0.0
    if not is_small(tangent):
        return fastest(tangent)
    Z = tangent.free_directions
    if not Z.shape[1]:
        return 0.0
    values = eigh(symmetric(Z.T @ (tangent.K @ Z)), symmetric(Z.T @ (tangent.M @ Z)), eigvals_only=True)
    return float(np.max(np.abs(values)))


def _damped(tangent: Tangent) -> Array:
    """s of (s² M + s D + K) φ = 0 on the motions that all constraints allow, one of each pair, by |s|."""
    Z = tangent.free_directions
    m = Z.shape[1]
    if not m:
        return np.zeros(0, dtype=complex)
    M, D, K = (Z.T @ (matrix @ Z) for matrix in (tangent.M, tangent.D, tangent.K))
    inverse = np.linalg.inv(M)
    first = np.block([[np.zeros((m, m)), np.eye(m)], [-inverse @ K, -inverse @ D]])
    values: Any = eig(first, right=False)
    found = np.asarray(values, dtype=complex)
    found = found[np.imag(found) >= 0.0]
    return found[np.argsort(np.abs(found), kind="stable")]


def buckling_factors(before: Tangent, after: Tangent, count: int) -> tuple[Array, Array]:
    """(μ (k,), directions (f, k)): the smallest positive μ for which K₀ + μ (K₁ - K₀) has no stiffness in a direction, ascending.

    before, after : tangents K₀, K₁ at two loads; constraints as before. Raises PivotError where K₀ itself has no stiffness somewhere.
    """
    size, rows = before.K.shape[0], before.C.shape[0]
    K0, dK = symmetric(before.K), symmetric(after.K - before.K)
    if is_small(before, count):
        Z = before.free_directions
        if not Z.shape[1]:
            return np.zeros(0), np.zeros((size, 0))
        try:
            values, vectors = eigh(symmetric(-(Z.T @ (dK @ Z))), symmetric(Z.T @ (K0 @ Z)))
        except np.linalg.LinAlgError:
            raise PivotError from None
        return _positive(values, Z @ vectors, count)
    found = saddle_factors(before)

    def inverse(b: Array) -> Array:
        return found.solve(np.concatenate([np.ravel(b), np.zeros(rows)]))[:size]

    begin = inverse(np.random.default_rng(0).standard_normal(size))
    operator = scipy.sparse.linalg.LinearOperator((size, size), matvec=inverse, dtype=float)  # type: ignore[call-arg]
    values, vectors = scipy.sparse.linalg.eigsh(
        -dK, k=min(count, size - rows - 1), M=K0, Minv=operator, v0=begin, which="LA"
    )
    return _positive(values, vectors, count)


def _positive(inverses: Array, vectors: Array, count: int) -> tuple[Array, Array]:
    """μ = 1/θ of the largest positive θ."""
    chosen = np.flatnonzero(inverses > 1e-12 * np.max(np.abs(inverses), initial=0.0))
    chosen = chosen[np.argsort(-inverses[chosen], kind="stable")][:count]
    return 1.0 / inverses[chosen], vectors[:, chosen]
