"""Order and pattern of the elimination of constraint rows: done once a machine, in Python; the kernels only follow it."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nivel.lazy import Struct
from nivel.machine.core.vectors import Whole
from nivel.system.elimination.factor_plan import minimum_degree

Index = NDArray[np.uint32]
Groups = tuple[tuple[int, ...], ...]


class Elimination(Struct):
    """Index arrays of `nivel.kernels.record.record.Saddle`, see there."""

    order: Index
    pair: Index
    S_start: Index
    S_row: Index
    L_start: Index
    L_row: Index
    P_start: Index
    P_column: Index
    P_entry: Index


def plan(rows: Sequence[Sequence[int]], block_row: Sequence[int], block_body: Sequence[int]) -> Elimination:
    """Elimination of all rows. Its arrays are only read: machines of one structure share them.

    rows : the rows of each joint (or normalisation), kept together; block_row, block_body : row and body of every block of C_q.
    """
    return _planned(tuple(tuple(group) for group in rows), tuple(block_row), tuple(block_body))


@lru_cache(maxsize=8)
def _planned(rows: Groups, block_row: tuple[int, ...], block_body: tuple[int, ...]) -> Elimination:
    count = sum(len(group) for group in rows)
    group_of = {row: g for g, group in enumerate(rows) for row in group}
    of_body: dict[int, list[int]] = {}
    for block, body in enumerate(block_body):
        of_body.setdefault(body, []).append(block)
    neighbours: list[set[int]] = [set() for _ in rows]
    for blocks in of_body.values():
        around = {group_of[block_row[block]] for block in blocks}
        for g in around:
            neighbours[g] |= around - {g}
    groups, _ = minimum_degree([len(group) for group in rows], neighbours, {})
    order = [row for g in groups for row in rows[g]]
    position = np.empty(count, dtype=np.int64)
    position[order] = np.arange(count)
    at = position[list(block_row)]
    # (entry by row and column of S, the two blocks) of all pairs of blocks of one body
    pairs = [np.zeros((0, 4), dtype=np.int64)]
    for size in {len(blocks) for blocks in of_body.values()}:
        blocks = np.array([each for each in of_body.values() if len(each) == size])
        a, b = (blocks[:, k].ravel() for k in np.tril_indices(size))
        pairs.append(np.column_stack([np.maximum(at[a], at[b]), np.minimum(at[a], at[b]), a, b]))
        twice = (a != b) & (at[a] == at[b])  # a row that touches a body twice
        pairs.append(np.column_stack([at[a], at[b], b, a])[twice])
    high, low, a, b = np.concatenate(pairs).T
    diagonal = np.arange(count) * (count + 1)
    keys, entry = np.unique(np.concatenate([high * count + low, diagonal]), return_inverse=True)
    pair = np.column_stack([a, b, entry[: len(a)]])[np.lexsort([b, a, entry[: len(a)]])]
    S_start, S_row = _starts(keys // count, count), keys % count
    P_start, P_column = _row_patterns(S_start, S_row)
    by_column = np.argsort(P_column, kind="stable")
    P_entry = np.empty_like(by_column)
    P_entry[by_column] = np.arange(len(by_column))
    row_of = np.repeat(np.arange(count), np.diff(P_start))
    return Elimination(
        order=_index(order),
        pair=_index(pair),
        S_start=_index(S_start),
        S_row=_index(S_row),
        L_start=_index(_starts(P_column, count)),
        L_row=_index(row_of[by_column]),
        P_start=_index(P_start),
        P_column=_index(P_column),
        P_entry=_index(P_entry),
    )


def _starts(ascending: Whole, count: int) -> Whole:
    """(count + 1,) where each of the numbers from 0 on begins."""
    return np.cumsum(np.bincount(ascending + 1, minlength=count + 1))


def _row_patterns(S_start: Whole, S_row: Whole) -> tuple[Whole, Whole]:
    """Pattern of every row of L by climbing the elimination tree from the entries of S (Davis 2006, §4.3)."""
    columns, ends = S_row.tolist(), S_start.tolist()
    parent = [-1] * (len(ends) - 1)
    found, starts = list[int](), [0]
    for k in range(len(parent)):
        seen = {k}
        for start in columns[ends[k] : ends[k + 1]]:
            i = start
            while i not in seen:
                seen.add(i)
                if parent[i] == -1:
                    parent[i] = k
                i = parent[i]
        seen.remove(k)
        found += sorted(seen)
        starts.append(len(found))
    return np.array(starts), np.array(found, dtype=np.int64)


def _index(values: ArrayLike) -> Index:
    return np.ascontiguousarray(values, dtype=np.uint32)
