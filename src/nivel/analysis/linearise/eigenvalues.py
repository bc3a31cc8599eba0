"""Eigenvalues of linear equations, with the zeros that structure makes told apart from those of round-off.

A coordinate on which nothing depends, and a rigid motion, make eigenvalues that are exactly zero, often several with one eigenvector; as
numbers these come out as ± √ε or worse. States are ordered into strongly connected blocks: of a block of one state the eigenvalue is
A_kk; in larger ones the multiplicity of zero follows from the null spaces of the block.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eig
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components

from nivel.system.system import Array

# entries below this share of the largest of their row are round-off
NOTHING = 1e-12
# singular values below this share of the largest, times the root of their number, are zero
ROUND_OFF = 4e-15
# left and right eigenvectors with less in common belong to one chain
CHAINED = 1e-6
# eigenvalues that the ranks say are zero have to be this small, as a share of the largest
SMALL = 1e-3
# eigenvalues by symmetric matrices are this near to those by A, as a share
NEAR = 1e-3
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Eigen:
    """values (n,) in ascending order of magnitude; zero : (n,) exactly zero by structure; right, left (n, n), a column each, with
    leftᴴ right = 1 where values are simple. zeros : of each structural zero, the states that it moves."""

    values: Complex
    zero: NDArray[np.bool_]
    right: Complex
    left: Complex
    zeros: tuple[tuple[int, ...], ...]


def eigenvalues(A: Array, scale: Array, noise: Array | None = None) -> Eigen:
    """Of A (n, n); scale : (n,) sizes of the states, which entries are compared by. noise : (n, n) below which entries are round-off."""
    n = len(A)
    if not n:
        empty = np.zeros((0, 0), dtype=np.complex128)
        return Eigen(np.zeros(0, dtype=np.complex128), np.zeros(0, dtype=bool), empty, empty, ())
    scaled = (A if noise is None else np.where(np.abs(A) > noise, A, 0.0)) * scale / scale[:, None]
    largest = np.abs(scaled).max(axis=1, keepdims=True)
    scaled = np.where(np.abs(scaled) > NOTHING * largest, scaled, 0.0)
    _, block = connected_components(csr_matrix(scaled != 0.0), directed=True, connection="strong")
    known: list[complex] = []
    zeros: list[tuple[int, ...]] = []
    for number in np.unique(block):
        own = np.flatnonzero(block == number)
        values, count = _of_block(scaled[np.ix_(own, own)])
        known += values
        zeros += [tuple(own.tolist())] * count
    found: Any = eig(scaled, left=True, right=True)
    values, left, right = found[0], found[1], found[2]
    order = _matched(np.array(known), values)
    left, right = left[:, order], right[:, order]
    exact = np.array(known, dtype=np.complex128)
    place = np.lexsort((-exact.imag, np.round(np.abs(exact), 12)))
    exact, left, right = exact[place], left[:, place], right[:, place]
    overlap = np.einsum("ij,ij->j", left.conj(), right)
    sure = np.abs(overlap) > 1e-12
    left = left / np.where(sure, overlap.conj(), 1.0)
    return Eigen(exact, exact == 0.0, scale[:, None] * right, left / scale[:, None], tuple(zeros))


def _of_block(A: Array) -> tuple[list[complex], int]:
    """(eigenvalues, how many are exactly zero) of a strongly connected block."""
    if len(A) == 1:
        return [complex(A[0, 0])], int(A[0, 0] == 0.0)
    values = np.linalg.eigvals(A).astype(np.complex128)
    count = _zeros(A)
    order = np.argsort(np.abs(values), kind="stable")
    if count and np.abs(values[order[count - 1]]) > SMALL * np.abs(values).max():
        count = 0
    values[order[:count]] = 0.0
    return [complex(value) for value in values], count


def _zeros(A: Array) -> int:
    """Multiplicity of the eigenvalue zero: its eigenvectors, and one more for each of them that is orthogonal to all left ones, as in a
    rigid motion, whose position and speed make one chain."""
    U, size, Vt = np.linalg.svd(A)
    count = int(np.sum(size <= ROUND_OFF * np.sqrt(len(A)) * size[0]))
    if not count:
        return 0
    left, right = U[:, len(A) - count :], Vt[len(A) - count :].T
    overlap = np.linalg.svd(left.T @ right, compute_uv=False)
    return count + int(np.sum(overlap <= CHAINED))


def _matched(known: Complex, values: Complex) -> NDArray[np.intp]:
    """For each known eigenvalue the place of the nearest computed one, each taken once; large ones first."""
    out, left = np.zeros(len(known), dtype=np.intp), list(range(len(values)))
    for k in np.argsort(-np.abs(known), kind="stable"):
        best = min(left, key=lambda j: abs(values[j] - known[k]))
        out[k] = best
        left.remove(best)
    return out


def with_squares(found: Eigen, squares: Array) -> Eigen:
    """The eigenvalues ± iω of an undamped machine at rest, whose ω² are known better from symmetric matrices, in place of the others."""
    upper = np.flatnonzero(found.values.imag > 0.0)
    upper = upper[np.argsort(found.values[upper].imag, kind="stable")]
    known = np.sort(squares)[len(squares) - len(upper) :]
    if 2 * len(upper) != int(np.sum(~found.zero)) or np.any(known <= 0.0):
        return found
    values = found.values.copy()
    for k, square in zip(upper, known, strict=True):
        if abs(values[k] - 1j * np.sqrt(square)) > NEAR * abs(values[k]):
            return found
        values[k] = 1j * np.sqrt(square)
    lower = np.flatnonzero(found.values.imag < 0.0)
    lower = lower[np.argsort(-found.values[lower].imag, kind="stable")]
    values[lower] = np.conj(values[upper])
    return replace(found, values=values)
