"""Order and pattern of the elimination of constraint rows: done once a machine, in Python; the kernels only follow it."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct
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
    position = {row: k for k, row in enumerate(order)}
    at = [position[row] for row in block_row]

    columns: list[set[int]] = [{k} for k in range(count)]
    pairs: list[tuple[int, int, int, int]] = []
    for blocks in of_body.values():
        for n, a in enumerate(blocks):
            for b in blocks[: n + 1]:
                low, high = (at[a], at[b]) if at[a] < at[b] else (at[b], at[a])
                columns[high].add(low)
                pairs.append((high, low, a, b))
                if a != b and high == low:
                    pairs.append((high, low, b, a))  # a row that touches a body twice
    S_start, S_row = _compressed(in_order := [sorted(column) for column in columns])
    places = ((k, row) for k, column in enumerate(in_order) for row in column)
    entry = {place: number for number, place in enumerate(places)}
    pair = sorted((entry[high, low], a, b) for high, low, a, b in pairs)
    P = _row_patterns(columns)
    L_columns: list[list[int]] = [[] for _ in range(count)]
    for k, pattern in enumerate(P):
        for j in pattern:
            L_columns[j].append(k)
    L_start, L_row = _compressed(L_columns)
    filled = L_start[:-1].tolist()
    P_entry = []
    for pattern in P:
        for j in pattern:
            P_entry.append(filled[j])
            filled[j] += 1
    P_start, P_column = _compressed(P)
    return Elimination(
        order=_index(order),
        pair=_index([(a, b, target) for target, a, b in pair]).reshape(-1, 3),
        S_start=S_start,
        S_row=S_row,
        L_start=L_start,
        L_row=L_row,
        P_start=P_start,
        P_column=P_column,
        P_entry=_index(P_entry),
    )


def _row_patterns(columns: Sequence[set[int]]) -> list[list[int]]:
    """Pattern of every row of L by climbing the elimination tree from the entries of S (Davis 2006, §4.3)."""
    count = len(columns)
    parent = [-1] * count
    patterns: list[list[int]] = []
    for k in range(count):
        seen = {k}
        for start in columns[k]:
            i = start
            while i not in seen and i < k:
                seen.add(i)
                if parent[i] == -1:
                    parent[i] = k
                i = parent[i]
        patterns.append(sorted(seen - {k}))
    return patterns


def _compressed(lists: Sequence[Sequence[int]]) -> tuple[Index, Index]:
    start = np.zeros(len(lists) + 1, dtype=np.uint32)
    start[1:] = np.cumsum([len(entries) for entries in lists])
    return start, _index([value for entries in lists for value in entries])


def _index(values: Sequence[object]) -> Index:
    return np.ascontiguousarray(np.array(values, dtype=np.uint32))
