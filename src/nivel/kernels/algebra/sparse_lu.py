"""Sparse linear systems without symmetry but with a symmetric pattern: L U in a fixed order, symbolic part done once in Python.

The order and all tables come from `nivel.system.elimination.factor_plan`. Unknowns that are eliminated one after the other and meet the
same later
ones form a *block* ("supernode": Davis 2006, "Direct Methods for Sparse Linear Systems", §4.8). Its rows of U are one dense panel, its
columns of L another:

             size      beside
    size   [ D         U ]   panel of U: D becomes L\\U of itself, width = size + beside
    beside [ L ]             panel of L, transposed order of U's columns

What a block leaves to later ones, A -= L U, is added row by row into their panels ("right-looking": Golub, Van Loan 2013, §3.2). The
unknowns beside it are cut into *parts*: those that follow each other within one later block, so indices are read once a part.

The kernels work on float64 and on complex128 alike.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from nivel.kernels.algebra.lu import magnitude
from nivel.kernels.algebra.rows import clear
from nivel.kernels.core.arrays import U1
from nivel.native.function import leaf

# A pivot this small against the sum of what was taken from it is round-off: the row depends on those before it.
DEPENDENT = 1e-13


class SparseLU(NamedTuple):
    """Tables of the factors of one pattern. N unknowns, S blocks, P parts; *place* is the number of an unknown in the order."""

    order: U1  # (N,) order[k] is the unknown eliminated as k-th
    upper_from: U1  # entries of A, by number in the pattern, that start in U ...
    upper_at: U1  # ... and where
    lower_from: U1  # those that start in L
    lower_at: U1
    first: U1  # (S+1,) first place of each block
    width: U1  # (S,) of its panel of U
    U_start: U1  # (S,) first entry of its panel in U, row by row
    L_start: U1  # (S,) the same of L; as many columns as the block has unknowns
    part_start: U1  # (S+1,) first part beside each block
    part_first: U1  # (P,) first place
    part_count: U1  # (P,) unknowns
    part_block: U1  # (P,) block that they belong to
    target_start: U1  # (S,) first target of each block
    target: U1  # for each pair of parts of a block (row, column): where L U of the two begins, in U, or in L left of the diagonal


@leaf
def _subtract(target, factor, row):
    for j in range(target.shape[0]):
        target[j] -= factor * row[j]


@leaf
def factorise_sparse_lu(tables, value, L, U, Dinv, work):
    """Factors of A, whose entries are `value` in the order of the plan's pattern (`row_start`, `column`).

    L, U, Dinv (N,) : written; Dinv holds the inverses of the pivots in order. work : (N + the largest width,).
    Returns -1, or the unknown whose pivot is zero, not finite or round-off: below DEPENDENT times the sum of what eliminations took from
    it. Neither the units of rows nor those of columns matter to this bound.
    """
    _enter(tables, value, L, U, Dinv)
    for k in range(tables.width.shape[0]):
        failed = _eliminate_block(tables, k, U, Dinv)
        if failed >= 0:
            return np.int64(tables.order[failed])
        _eliminate_beside(tables, k, L, U, Dinv, work)
    return -1


@leaf
def _enter(tables, value, L, U, Dinv):
    """Put the entries of A where the factors start from; Dinv counts what is taken from each pivot."""
    clear(L)
    clear(U)
    clear(Dinv)
    for e in range(tables.upper_from.shape[0]):
        U[tables.upper_at[e]] = value[tables.upper_from[e]]
    for e in range(tables.lower_from.shape[0]):
        L[tables.lower_at[e]] = value[tables.lower_from[e]]


@leaf
def _eliminate_block(tables, k, U, Dinv):
    """The panel of U of block k, row by row. Returns -1, or the place of a pivot that is none."""
    first = np.int64(tables.first[k])
    size = np.int64(tables.first[k + 1]) - first
    width = np.int64(tables.width[k])
    start = np.int64(tables.U_start[k])
    for i in range(size):
        row = U[start + i * width : start + (i + 1) * width]
        taken = np.real(Dinv[first + i])
        for p in range(i):
            if row[p] != 0.0:
                factor = row[p] * Dinv[first + p]
                row[p] = factor
                above = U[start + p * width : start + (p + 1) * width]
                taken += magnitude(factor * above[i])
                _subtract(row[p + 1 : width], factor, above[p + 1 : width])
        pivot = magnitude(row[i])
        if not (pivot > DEPENDENT * taken and pivot < np.inf):
            return first + i
        Dinv[first + i] = 1.0 / row[i]
    return -1


@leaf
def _eliminate_beside(tables, k, L, U, Dinv, work):
    """The panel of L of block k, and what it takes from later blocks."""
    first = np.int64(tables.first[k])
    size = np.int64(tables.first[k + 1]) - first
    width = np.int64(tables.width[k])
    start = np.int64(tables.U_start[k])
    parts, end = np.int64(tables.part_start[k]), np.int64(tables.part_start[k + 1])
    below = np.int64(tables.L_start[k])
    diagonal = size
    target = np.int64(tables.target_start[k])
    row = work[:width]
    for i in range(parts, end):
        later = tables.part_block[i]
        for r in range(np.int64(tables.part_count[i])):
            lower = L[below : below + size]
            for p in range(size):
                row[p] = lower[p]
            for p in range(size, width):
                row[p] = 0.0
            for p in range(size):
                if row[p] != 0.0:
                    factor = row[p] * Dinv[first + p]
                    lower[p] = factor
                    above = U[start + p * width : start + (p + 1) * width]
                    _subtract(row[p + 1 : width], factor, above[p + 1 : width])
            Dinv[np.int64(tables.part_first[i]) + r] += magnitude(row[diagonal])
            column = size
            for j in range(parts, end):
                count = np.int64(tables.part_count[j])
                at = np.int64(tables.target[target + j - parts])
                block = tables.part_block[j]
                if block < later:
                    at += r * (np.int64(tables.first[block + 1]) - np.int64(tables.first[block]))
                    _add(L[at : at + count], row[column : column + count])
                else:
                    at += r * np.int64(tables.width[later])
                    _add(U[at : at + count], row[column : column + count])
                column += count
            below += size
            diagonal += 1
        target += end - parts


@leaf
def _add(target, row):
    for j in range(target.shape[0]):
        target[j] += row[j]


@leaf
def solve_sparse_lu(tables, L, U, Dinv, b, work):
    """Overwrite b (N,), numbered as the unknowns, with the solution. work : as in `factorise_sparse_lu`."""
    N = tables.order.shape[0]
    y = work[:N]
    for k in range(N):
        y[k] = b[tables.order[k]]
    for k in range(tables.width.shape[0]):
        _forward(tables, k, L, U, y)
    for n in range(tables.width.shape[0]):
        _backward(tables, tables.width.shape[0] - 1 - n, U, Dinv, y, work[N:])
    for k in range(N):
        b[tables.order[k]] = y[k]


@leaf
def _less(total, a, b):
    for j in range(b.shape[0]):
        total -= a[j] * b[j]
    return total


@leaf
def _forward(tables, k, L, U, y):
    """y of block k, and what it takes from later ones: L y = b."""
    first = np.int64(tables.first[k])
    size = np.int64(tables.first[k + 1]) - first
    width = np.int64(tables.width[k])
    start = np.int64(tables.U_start[k])
    known = y[first : first + size]
    for i in range(1, size):
        known[i] = _less(known[i], U[start + i * width : start + i * width + i], known[:i])
    below = np.int64(tables.L_start[k])
    for i in range(np.int64(tables.part_start[k]), np.int64(tables.part_start[k + 1])):
        place = np.int64(tables.part_first[i])
        for r in range(np.int64(tables.part_count[i])):
            y[place + r] = _less(y[place + r], L[below : below + size], known)
            below += size


@leaf
def _backward(tables, k, U, Dinv, y, beside):
    """Solution of block k from that of later ones: U x = y."""
    first = np.int64(tables.first[k])
    size = np.int64(tables.first[k + 1]) - first
    width = np.int64(tables.width[k])
    start = np.int64(tables.U_start[k])
    column = size
    for i in range(np.int64(tables.part_start[k]), np.int64(tables.part_start[k + 1])):
        place = np.int64(tables.part_first[i])
        for r in range(np.int64(tables.part_count[i])):
            beside[column] = y[place + r]
            column += 1
    # rows one beside the other, then columns: no sum waits for the one before it
    for i in range(size):
        row = U[start + i * width + size : start + (i + 1) * width]
        y[first + i] = _less(y[first + i], row, beside[size:width])
    for n in range(size):
        i = size - 1 - n
        x = y[first + i] * Dinv[first + i]
        y[first + i] = x
        for p in range(i):
            y[first + p] -= U[start + p * width + i] * x
