"""Eigenvalues of linear equations, with the zeros that structure makes told apart from those of round-off.

A coordinate on which nothing depends, and a rigid motion, make eigenvalues that are exactly zero, often several with one eigenvector; as
numbers these come out as ± √ε or worse. States are ordered into strongly connected blocks: of a block of one state the eigenvalue is
A_kk; in larger ones the multiplicity of zero follows from the null spaces of the block, whose rows and columns are first made equal in
size, so that no unit and no fast motion beside a slow one decides what is zero.

An eigenvalue with the vectors l, r of its block is known to |l|ᵀ |δA| |r| / |lᴴ r|, for entries that are known to δA, and a backward error
ε ‖A‖ of the method in balanced coordinates (Golub, Van Loan, Matrix Computations, 4th edition, §7.2.2), at most to √(|δA| ‖A‖), as two
equal ones with one vector are: the slow motions of a stiff machine have the round-off of its fastest.

Basis of undamped vibrations, in which linear equations are graded: the stiffness of each motion stands beside its own mass.

States (s, w, x) = T (η, ζ, …). The first columns of T are the vibrations Φ of K φ = ω² M φ, with what of K is symmetrical, on the motions
that nothing holds: s = Z Φ η, w = Z Φ ζ. Behind them stand what drivers as inputs prescribe, and the states of elements. With Φᵀ M Φ = 1

    η̇ = ζ + …        ζ̇ = -(diag ω² + Φᵀ K_a Φ) η - Φᵀ D Φ ζ - …

where K_a is what of the stiffness is not symmetrical. A stiffness is none where it is less than the round-off of the terms that make it,
|Φ|ᵀ |K| |Φ|: a thin strip keeps its slow vibration beside fast ones, however far apart these are.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, eig, eigh, matrix_balance, norm
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components

from nivel.analysis.linearise.reduction import ROUND_OFF, Reduction
from nivel.analysis.statics.linear import symmetric
from nivel.elements.control.dynamics import LinearSystem
from nivel.lazy import Struct
from nivel.machine.core.vectors import Complex
from nivel.system.system import Array

# a mass matrix is symmetrical to this share
SYMMETRIC = 1e-9
# vibrations whose ω² is below this share of the largest are told apart once more among themselves
SLOW = 1e-6


class Graded(Struct):
    """A (n, n) in the columns of `basis` (n, n); entries below `noise` (n, n) are round-off."""

    A: Array
    noise: Array
    basis: Array

    def kept(self, some: NDArray[np.intp]) -> "Graded":
        """Of these states alone, all of the others being states of elements."""
        chosen = np.ix_(some, some)
        return Graded(self.A[chosen], self.noise[chosen], self.basis[chosen])


def graded(reduction: Reduction, space: LinearSystem, signs: Array) -> Graded | None:
    """The equations of `space`, whose first states have these signs, in the basis of vibrations; None without a mass matrix for it,
    and for wheels that do not slip, whose places are more than their rates."""
    shapes = _shapes(reduction)
    if shapes is None:
        return None
    m, w, h = len(reduction.selected), len(reduction.moving), shapes.shape[1]
    T = _basis(reduction, shapes)
    inverse = np.linalg.inv(T)
    more = np.ones(len(T))
    more[: len(signs)] = signs
    A = inverse @ (more[:, None] * space.A * more) @ T
    noise = np.abs(inverse) @ reduction.noise() @ np.abs(T)
    # a rate is that of its own place
    A[:m, m : m + w] = noise[:m, m : m + w] = 0.0
    A[np.arange(w), m + np.arange(w)] = 1.0
    A[m : m + h], noise[m : m + h] = _accelerations(reduction, T, shapes)
    # vibrations have no symmetrical stiffness in common
    stiffness = symmetric(A[m : m + h, :h])
    A[m : m + h, :h] -= stiffness - np.diag(np.diag(stiffness))
    return Graded(A, noise, more[:, None] * T)


def _shapes(reduction: Reduction) -> Array | None:
    """(f, h) changes of all unknowns in the vibrations of the motions that nothing holds, with unit mass."""
    held = reduction.held
    Z, M = held.motions, reduction.by_rate.r[reduction.instant.free]
    mass = Z.T @ M @ Z
    count = Z.shape[1] + held.prescribed.shape[1]
    if not len(mass) or not count == len(reduction.moving) == len(reduction.selected):
        return None
    if np.max(np.abs(mass - mass.T)) > SYMMETRIC * np.max(np.abs(mass)):
        return None
    forces, rates = _pushed(reduction, _basis(reduction, Z), Z)[:2]
    stiffness = -symmetric(forces[:, : len(mass)] + mass @ rates[:, : len(mass)])
    try:
        squares, inner = eigh(stiffness, symmetric(mass))
    except LinAlgError:
        return None
    shapes, size, slow = Z @ inner, np.abs(squares), np.arange(len(squares))
    # to a share ε of the largest ω² alone all are known so far
    while len(slow) and np.max(size) > 0.0:
        few = slow[size <= SLOW * np.max(size)]
        if len(few) == len(slow) or not len(few):
            break
        # among themselves slow vibrations are known to their own round-off
        own = -symmetric(_accelerations(reduction, _basis(reduction, shapes), shapes)[0][few][:, few])
        values, turned = eigh(own)
        shapes[:, few] = shapes[:, few] @ turned
        slow, size = few, np.abs(values)
    return shapes


def _basis(reduction: Reduction, shapes: Array) -> Array:
    """T"""
    m, w, S = len(reduction.selected), len(reduction.moving), reduction.instant.state_count
    moved = np.hstack([shapes, reduction.held.prescribed])
    out = np.eye(m + w + S)
    out[:m, :m] = moved[reduction.selected]
    out[m : m + w, m : m + w] = moved[reduction.moving]
    return out


def _accelerations(reduction: Reduction, T: Array, shapes: Array) -> tuple[Array, Array]:
    """(h, n) accelerations of vibrations with unit mass for each column of T, and their round-off."""
    forces, rates, noise = _pushed(reduction, T, shapes)
    return forces + rates, noise


def _pushed(reduction: Reduction, T: Array, shapes: Array) -> tuple[Array, Array, Array]:
    """(h, n) each: generalised forces on `shapes` for each column of T; accelerations beside these; round-off of both."""
    m, w, h = len(reduction.selected), len(reduction.moving), shapes.shape[1]
    q, v, x = reduction.Zq @ T[:m], reduction.Y @ T[:m] + reduction.Z @ T[m : m + w], T[m + w :]
    free = reduction.instant.free
    P, M = reduction.held.by_row, reduction.by_rate.r[free]
    rows = -reduction.moved("Cddot", q, v, x)
    forces = shapes.T @ (-reduction.moved("r", q, v, x)[free] - M @ (P @ rows))
    inner = np.linalg.inv(T[m : m + w, m : m + w])[:h]
    rates = inner @ (reduction.shifted(v) + P @ rows)[reduction.moving]
    places = (np.abs(reduction.Zq) @ np.abs(T[:m]), np.abs(reduction.Y) @ np.abs(T[:m]))
    size = (places[0], places[1] + np.abs(reduction.Z) @ np.abs(T[m : m + w]), np.abs(x))
    by_rows = np.abs(P) @ reduction.size_of("Cddot", *size)
    noise = np.abs(shapes).T @ (reduction.size_of("r", *size)[free] + np.abs(M) @ by_rows)
    noise = noise + np.abs(inner) @ (np.abs(reduction.shifted(size[1])) + by_rows)[reduction.moving]
    return forces, rates, ROUND_OFF * noise


# entries below this share of the largest of their row are round-off
NOTHING = 1e-12
# singular values of a block whose rows and columns are equal in size, below this times the root of their number, are zero
OF_BLOCK = 4e-15
# of the floating-point numbers
EPSILON = 2.220446049250313e-16
# rounds that make rows and columns equal in size
ROUNDS = 12
# left and right eigenvectors with less in common belong to one chain
CHAINED = 1e-6
# zeros of a chain whose equations are not known to this share part by so many roots of what is not known
DRIFTS, PARTED = 1e-13, 10.0
# eigenvalues that the ranks say are zero have to be this small, as a share of the largest
SMALL = 1e-3
# a state of a rigid motion moves by more than this share of the one that moves most
MOVES = 1e-6
Index = NDArray[np.intp]


class Eigen(Struct):
    """values (n,) in ascending order of magnitude; zero : (n,) exactly zero by structure; right, left (n, n), a column each, with
    leftᴴ right = 1 where values are simple. zeros : of each structural zero, the states that it moves. known (n,) : to how much [1/s] each
    value is, by round-off."""

    values: Complex
    zero: NDArray[np.bool_]
    right: Complex
    left: Complex
    zeros: tuple[tuple[int, ...], ...]
    known: Array

    def unknown(self) -> "Eigen":
        """As many that are not numbers: of equations that change, whose eigenvalues describe no motion."""
        n = len(self.values)
        none, vectors = np.full(n, complex(np.nan, np.nan)), np.full((n, n), complex(np.nan, np.nan))
        return Eigen(none, np.zeros(n, dtype=bool), vectors, vectors.copy(), (), np.zeros(n))


def eigenvalues(
    A: Array, scale: Array, noise: Array | None = None, apart: Graded | None = None, drift: Array | None = None
) -> Eigen:
    """Of A (n, n); scale : (n,) sizes of the states, which entries are compared by. noise : (n, n) below which entries are round-off.
    apart : the same equations in the basis of their vibrations, where eigenvalues are then taken. drift : (n, n) by which A changes
    with time while it is taken for constant: no zero is known better."""
    n = len(A)
    if not n:
        empty = np.zeros((0, 0), dtype=np.complex128)
        return Eigen(np.zeros(0, dtype=np.complex128), np.zeros(0, dtype=bool), empty, empty, (), np.zeros(0))
    noise, drift = (np.zeros_like(A) if each is None else each for each in (noise, drift))
    scaled = np.where(np.abs(A) > noise, A, 0.0) * scale / scale[:, None]
    scaled = np.where(np.abs(scaled) > NOTHING * np.abs(scaled).max(axis=1, keepdims=True), scaled, 0.0)
    if apart is None:
        values, left, right, known = _of(scaled, (noise + drift) * scale / scale[:, None])
        right, left = scale[:, None] * right, left / scale[:, None]
    else:
        T = apart.basis
        unsure = apart.noise + np.abs(np.linalg.inv(T)) @ drift @ np.abs(T) if np.any(drift) else apart.noise
        values, left, right, known = _of(np.where(np.abs(apart.A) > apart.noise, apart.A, 0.0), unsure)
        right, left = T @ right, np.linalg.solve(T.T, left)
    place = np.lexsort((-values.imag, np.round(np.abs(values), 12)))
    values, left, right, known = values[place], left[:, place], right[:, place], known[place]
    overlap = np.einsum("ij,ij->j", left.conj(), right)
    size = np.linalg.norm(left * scale[:, None], axis=0) * np.linalg.norm(right / scale[:, None], axis=0)
    sure = np.abs(overlap) > 1e-12 * size
    left = left / np.where(sure, overlap.conj(), 1.0)
    zero = values == 0.0
    return Eigen(values, zero, right, left, _moved(scaled, right[:, zero] / scale[:, None]), known)


def _of(A: Array, unsure: Array) -> tuple[Complex, Complex, Complex, Array]:
    """(eigenvalues, left, right, to how much they are known): of parts that do not act on each other each by itself. unsure (n, n) : to how
    much entries are known."""
    n = len(A)
    values, known = np.zeros(n, dtype=np.complex128), np.zeros(n)
    left, right = np.zeros((n, n), dtype=np.complex128), np.zeros((n, n), dtype=np.complex128)
    _, part = connected_components(csr_matrix(A != 0.0), directed=False)
    for number in np.unique(part):
        own = np.flatnonzero(part == number)
        some = np.ix_(own, own)
        values[own], left[some], right[some], known[own] = _of_part(A[some], unsure[some])
    return values, left, right, known


def _of_part(A: Array, unsure: Array) -> tuple[Complex, Complex, Complex, Array]:
    _, block = connected_components(csr_matrix(A != 0.0), directed=True, connection="strong")
    values, known = np.zeros(len(A), dtype=np.complex128), np.zeros(len(A))
    for number in np.unique(block):
        own = np.flatnonzero(block == number)
        values[own], known[own] = _of_block(A[np.ix_(own, own)], unsure[np.ix_(own, own)])
    found: Any = eig(A, left=True, right=True)
    order = _matched(values, found[0])
    return values, found[1][:, order], found[2][:, order], known


def _of_block(A: Array, unsure: Array) -> tuple[Complex, Array]:
    """Eigenvalues of a strongly connected block, and to how much they are known."""
    if len(A) == 1:
        return A[0].astype(np.complex128), unsure[0]
    balanced, size = _balanced(A)
    unsure = unsure * size / size[:, None]
    found: Any = eig(balanced, left=True, right=True)
    values, left, right = found[0].astype(np.complex128), np.abs(found[1]), np.abs(found[2])
    overlap = np.abs(np.einsum("ij,ij->j", found[1].conj(), found[2]))
    whole = float(norm(balanced, 2))
    error = np.einsum("ij,ik,kj->j", left, unsure, right) + EPSILON * whole
    known = np.minimum(error / np.maximum(overlap, EPSILON), np.sqrt(error * whole))
    count = _zeros(A, unsure)
    order = np.argsort(np.abs(values), kind="stable")
    if count and np.abs(values[order[count - 1]]) > SMALL * np.abs(values).max():
        count = 0
    values[order[:count]] = 0.0
    return values, known


def _zeros(A: Array, unsure: Array) -> int:
    """Multiplicity of the eigenvalue zero: its eigenvectors, and one more for each of them that is orthogonal to all left ones, as in a
    rigid motion, whose position and speed make one chain."""
    A, size = _balanced(A)
    rows, columns = _equal_sizes(A)
    U, values, Vt = np.linalg.svd(rows[:, None] * A * columns)
    unsure = rows[:, None] * (unsure * size / size[:, None]) * columns
    known = np.einsum("ij,ik,kj->j", np.abs(U), unsure, np.abs(Vt.T))
    count = int(np.sum(np.cumprod((values <= np.maximum(OF_BLOCK * np.sqrt(len(A)) * values[0], known))[::-1])))
    if not count:
        return 0
    left, right = rows[:, None] * U[:, len(A) - count :], columns[:, None] * Vt[len(A) - count :].T
    overlap = np.linalg.svd(np.linalg.qr(left)[0].T @ np.linalg.qr(right)[0], compute_uv=False)
    chained = int(np.sum(overlap <= CHAINED))
    # what is not known of a chain of two moves its zeros by the root
    root = PARTED * np.sqrt(np.max(known[len(A) - count :]) * np.abs(A).max())
    near = int(np.sum(np.abs(np.linalg.eigvals(A)) <= root)) if np.max(unsure) > DRIFTS else 0
    return max(count + chained, near)


def _balanced(A: Array) -> tuple[Array, Array]:
    """A in states of other sizes, in which its rows and columns have equal norms, and these sizes."""
    with np.errstate(invalid="ignore"):  # it makes whole numbers of the sizes too, which nobody asks for
        found: Any = matrix_balance(A, permute=False, separate=True)
    return found[0], found[1][0]


def _equal_sizes(A: Array) -> tuple[Array, Array]:
    """Factors of the rows and of the columns that make the largest entry of each about one (Ruiz 2001)."""
    rows, columns = np.ones(len(A)), np.ones(len(A))
    for _ in range(ROUNDS):
        size = np.abs(rows[:, None] * A * columns)
        rows = rows / np.sqrt(np.where(size.max(axis=1) > 0.0, size.max(axis=1), 1.0))
        columns = columns / np.sqrt(np.where(size.max(axis=0) > 0.0, size.max(axis=0), 1.0))
    return rows, columns


def _moved(A: Array, right: Complex) -> tuple[tuple[int, ...], ...]:
    """Of each zero the states that it moves: one on which nothing depends, or all of a rigid motion. right (n, z) : of the zeros."""
    _, block = connected_components(csr_matrix(A != 0.0), directed=True, connection="strong")
    alone = np.bincount(block)[block] == 1
    single = [k for k in np.flatnonzero(alone) if A[k, k] == 0.0][: right.shape[1]]
    size = np.abs(right)
    seen = np.any(size > MOVES * np.max(size, axis=0, initial=0.0), axis=1) & ~alone
    rest = right.shape[1] - len(single)
    return tuple((int(k),) for k in single) + (tuple(np.flatnonzero(seen).tolist()),) * rest


def _matched(known: Complex, values: Complex) -> Index:
    """For each known eigenvalue the place of the nearest computed one, each taken once; large ones first."""
    out, left = np.zeros(len(known), dtype=np.intp), list(range(len(values)))
    for k in np.argsort(-np.abs(known), kind="stable"):
        best = min(left, key=lambda j: abs(values[j] - known[k]))
        out[k] = best
        left.remove(best)
    return out
