"""Small vibrations about an equilibrium: natural frequencies, modes, damping, and linearised buckling loads."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg import eig, eigh

from nivel.analysis.statics import linear
from nivel.analysis.statics.equations import Tangent
from nivel.lazy import dataclass, scipy
from nivel.system.system import Array

# Squares of frequencies ω² = φᵀ K φ below this share of |φ|ᵀ |K| |φ| are round-off: rigid motions. Where forces have no potential all are
# known to such a share of the largest only.
ROUND_OFF = 1e-13
# Squares of frequencies below this share of the largest are zero, since a frequency of 1e-12 of another one is not computed.
NONE = 1e-24
# Machines of up to so many unknowns get their damping: the eigenvalues of a full matrix of twice the size.
DAMPED = 400


@dataclass(frozen=True)
class Vibrations:
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
    squares, shapes = linear.lowest(tangent, count, tangent.M)
    known = np.einsum("ik,ik->k", np.abs(shapes), np.abs(tangent.K) @ np.abs(shapes))
    still = (np.abs(squares) <= ROUND_OFF * known) | (np.abs(squares) <= NONE * linear.fastest(tangent))
    if not linear.has_potential(tangent):
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
    if not linear.is_small(tangent):
        return linear.fastest(tangent)
    Z = tangent.free_directions
    if not Z.shape[1]:
        return 0.0
    values = eigh(linear.symmetric(Z.T @ (tangent.K @ Z)), linear.symmetric(Z.T @ (tangent.M @ Z)), eigvals_only=True)
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
    K0, dK = linear.symmetric(before.K), linear.symmetric(after.K - before.K)
    if linear.is_small(before, count):
        Z = before.free_directions
        if not Z.shape[1]:
            return np.zeros(0), np.zeros((size, 0))
        try:
            values, vectors = eigh(linear.symmetric(-(Z.T @ (dK @ Z))), linear.symmetric(Z.T @ (K0 @ Z)))
        except np.linalg.LinAlgError:
            raise linear.PivotError from None
        return _positive(values, Z @ vectors, count)
    found = linear.saddle_factors(before)

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
