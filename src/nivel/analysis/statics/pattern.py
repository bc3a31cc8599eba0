"""Blocks of a sparse matrix of fixed pattern, scaled, as often as its numbers change: where they stand is found once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix

from nivel.system.system import Array

Index = NDArray[np.int64]


class Block:
    """Rows and columns of a matrix whose entries stand in an array, in the order of `row` and `column`.

    rows, columns : numbers that are taken, in this order. scales : factors of all rows and columns of the whole matrix.
    """

    def __init__(self, row: Index, column: Index, rows: Index, columns: Index, scales: tuple[Array, Array]) -> None:
        self.shape = (len(rows), len(columns))
        new_row, new_column = (
            _renumbered(each, len(scale)) for each, scale in zip((rows, columns), scales, strict=True)
        )
        taken = np.flatnonzero((new_row[row] >= 0) & (new_column[column] >= 0))
        r, c = new_row[row[taken]], new_column[column[taken]]
        order = np.lexsort((r, c))
        self._taken, self._row = taken[order], r[order].astype(np.int32)
        self._start = np.searchsorted(c[order], np.arange(len(columns) + 1)).astype(np.int32)
        self._factor = scales[0][row[self._taken]] * scales[1][column[self._taken]]

    def of(self, value: Array, factor: float = 1.0) -> Any:
        """The block for entries `value`, times a factor."""
        return csc_matrix((value[self._taken] * self._factor * factor, self._row, self._start), shape=self.shape)


def _renumbered(chosen: Index, size: int) -> Index:
    """Place of each number among those chosen, or -1."""
    out = np.full(size, -1, dtype=np.int64)
    out[chosen] = np.arange(len(chosen))
    return out
