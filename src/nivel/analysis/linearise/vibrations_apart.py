"""Basis of undamped vibrations, in which linear equations are graded: the stiffness of each motion stands beside its own mass.

States (s, w, x) = T (η, ζ, …). The first columns of T are the vibrations Φ of K φ = ω² M φ, with what of K is symmetrical, on the motions
that nothing holds: s = Z Φ η, w = Z Φ ζ. Behind them stand what drivers as inputs prescribe, and the states of elements. With Φᵀ M Φ = 1

    η̇ = ζ + …        ζ̇ = -(diag ω² + Φᵀ K_a Φ) η - Φᵀ D Φ ζ - …

where K_a is what of the stiffness is not symmetrical. A stiffness is none where it is less than the round-off of the terms that make it,
|Φ|ᵀ |K| |Φ|: a thin strip keeps its slow vibration beside fast ones, however far apart these are.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, eigh

from nivel.analysis.linearise.reduction import ROUND_OFF, Reduction, StateSpace
from nivel.analysis.statics.linear import symmetric
from nivel.lazy import dataclass
from nivel.system.system import Array

# a mass matrix is symmetrical to this share
SYMMETRIC = 1e-9
# vibrations whose ω² is below this share of the largest are told apart once more among themselves
SLOW = 1e-6


@dataclass(frozen=True)
class Graded:
    """A (n, n) in the columns of `basis` (n, n); entries below `noise` (n, n) are round-off."""

    A: Array
    noise: Array
    basis: Array

    def kept(self, some: NDArray[np.intp]) -> Graded:
        """Of these states alone, all of the others being states of elements."""
        chosen = np.ix_(some, some)
        return Graded(self.A[chosen], self.noise[chosen], self.basis[chosen])


def graded(reduction: Reduction, space: StateSpace, signs: Array) -> Graded | None:
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
    A[m : m + h, :h] -= _off_diagonal(symmetric(A[m : m + h, :h]))
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


def _off_diagonal(matrix: Array) -> Array:
    return matrix - np.diag(np.diag(matrix))
