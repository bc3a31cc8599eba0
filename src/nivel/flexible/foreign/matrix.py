"""A matrix as another program wrote it: numbers, and which node and direction every row is, if the file says so."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from nivel.flexible.model.mass import Sparse
from nivel.lazy import dataclass

Whole = NDArray[np.int64]
Label = tuple[int, int]  # node, direction 1 … 6


class FormatError(ValueError):
    """The file is not what it should be; the message says where and why. file : an included file in which the line is, or None."""

    def __init__(self, message: str, line: int = 0) -> None:
        self.line, self.message = line, message
        self.file: Path | None = getattr(line, "file", None)
        super().__init__(f"line {line}: {message}" if line else message)


@dataclass(frozen=True)
class FileMatrix:
    """`matrix` (N, N); `labels`: node and direction (1 … 6) of each row, or None where the file does not say."""

    matrix: Sparse
    labels: tuple[Label, ...] | None = None

    def ordered(self, labels: Sequence[Label]) -> Sparse:
        """The matrix with rows in the order of `labels`; rows that it lacks are zero."""
        if self.labels is None:
            return self.matrix
        place = {label: k for k, label in enumerate(self.labels)}
        at = np.array([place.get(label, -1) for label in labels], dtype=np.int64)
        has = np.flatnonzero(at >= 0)
        pick = sp.csr_array((np.ones(len(has)), (has, at[has])), shape=(len(labels), len(place)))
        return sp.csc_array(pick @ self.matrix @ pick.T)


def from_triplets(
    rows: Whole, columns: Whole, values: NDArray[np.float64], size: int, *, triangle: bool | None = None
) -> Sparse:
    """The matrix of triplets (from 0). triangle : whether the file has one triangle of a symmetric matrix; None: it has
    where no entry off the diagonal has a mirror image.
    """
    if triangle is None:
        off = rows != columns
        triangle = not np.isin(rows[off] * size + columns[off], columns[off] * size + rows[off]).any()
    if triangle:
        off = rows != columns
        rows, columns, values = (
            np.concatenate([rows, columns[off]]),
            np.concatenate([columns, rows[off]]),
            np.concatenate([values, values[off]]),
        )
    return sp.csc_array((values, (rows, columns)), shape=(size, size))


def from_labelled(
    rows: Sequence[Label], columns: Sequence[Label], values: Sequence[float], *, triangle: bool | None = None
) -> FileMatrix:
    """The matrix of entries whose rows and columns are labels, which become its rows in ascending order."""
    labels = tuple(sorted({*rows, *columns}))
    place = {label: k for k, label in enumerate(labels)}
    i, j = (np.array([place[label] for label in side], dtype=np.int64) for side in (rows, columns))
    return FileMatrix(from_triplets(i, j, np.array(values, dtype=float), len(labels), triangle=triangle), labels)


def text_lines(path: Path) -> Iterator[tuple[int, str]]:
    """Numbered lines of a text file without their ends. Bytes that are no UTF-8 (titles) are passed over."""
    with path.open(encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, start=1):
            yield number, line.rstrip("\r\n")


def fortran_number(text: str) -> float:
    """A number as Nastran and Fortran write it: ``1.5``, ``1.5D+06``, ``1.5+6``. Finite. Raises ValueError."""
    try:
        value = float(text)
    except ValueError:
        text = text.strip().upper().replace("D", "E")
        at = max(text.rfind("+"), text.rfind("-"))
        value = float(text if at <= 0 or "E" in text else f"{text[:at]}E{text[at:]}")
    if not math.isfinite(value):
        raise ValueError(f"a finite number was expected, got `{text}`")
    return value
