"""A matrix as another program wrote it: numbers, and which node and direction every row is, if the file says so."""

import csv
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from nivel.flexible.model.model import Sparse
from nivel.lazy import Struct, scipy
from nivel.machine.core.vectors import Whole

Label = tuple[int, int]  # node, direction 1 … 6


class FormatError(ValueError):
    """The file is not what it should be; the message says where and why. file : an included file in which the line is, or None."""

    def __init__(self, message: str, line: int = 0) -> None:
        self.line, self.message = line, message
        self.file: Path | None = getattr(line, "file", None)
        super().__init__(f"line {line}: {message}" if line else message)


class FileMatrix(Struct):
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
        values = np.concatenate([values, values[off]])
        rows, columns = np.concatenate([rows, columns[off]]), np.concatenate([columns, rows[off]])
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


WORDS: Final = {"x": 1, "y": 2, "z": 3, "rx": 4, "ry": 5, "rz": 6, **{str(k): k for k in range(1, 7)}}


def read_abaqus(path: Path) -> FileMatrix:
    """A matrix of *MATRIX OUTPUT: lines of row node, direction, column node, direction, value (FORMAT=MATRIX INPUT), or of
    row, column, value (FORMAT=COORDINATE). Symmetric matrices may have one triangle.

    Raises FormatError.
    """
    rows: list[tuple[int, ...]] = []
    values: list[float] = []
    for number, line in text_lines(path):
        text = line.strip()
        if not text or text.startswith(("*", "#")):
            continue
        parts = text.replace(",", " ").split()
        wrong = f"five entries (or three) were expected, got `{text[:60]}`"
        if len(parts) not in (3, 5) or (rows and len(parts) - 1 != len(rows[0])):
            raise FormatError(wrong, number)
        try:
            rows.append(tuple(int(part) for part in parts[:-1]))
            values.append(fortran_number(parts[-1]))
        except ValueError:
            raise FormatError(wrong, number) from None
    if not rows:
        raise FormatError("there is no matrix in this file")
    if len(rows[0]) == 4:
        first = [(row[0], row[1]) for row in rows]
        second = [(row[2], row[3]) for row in rows]
        internal = next((label for label in (*first, *second) if label[0] < 1), None)
        if internal is not None:
            raise FormatError(
                "the matrix has internal nodes (number below 1); write public nodes only, without hybrid elements"
            )
        return from_labelled(first, second, values)
    i, j = np.array(rows, dtype=np.int64).T - 1
    return FileMatrix(from_triplets(i, j, np.array(values), int(max(i.max(), j.max())) + 1))


def read_calculix(path: Path, freedoms: tuple[Label, ...]) -> FileMatrix:
    """A matrix of *FREQUENCY, SOLVER=MATRIXSTORAGE: lines of row, column, value; one triangle. `freedoms`: of the .dof file."""
    try:
        data = np.loadtxt(path, ndmin=2)
    except ValueError as error:
        raise FormatError(f"lines of row, column, value were expected: {error}") from None
    if data.shape[1] != 3:
        raise FormatError(f"lines of row, column, value were expected, got {data.shape[1]} numbers in a line")
    i, j = data[:, 0].astype(np.int64) - 1, data[:, 1].astype(np.int64) - 1
    size = int(max(i.max(), j.max())) + 1
    if size > len(freedoms):
        raise FormatError(
            f"the matrix has {size} rows and the table `freedoms` has {len(freedoms)}: they are of different runs"
        )
    return FileMatrix(from_triplets(i, j, data[:, 2], len(freedoms)), freedoms)


def read_freedoms(path: Path, *, repeated: bool = False) -> tuple[Label, ...]:
    """Node and direction of each row: lines such as ``17.2`` (CalculiX .dof), or a table (.csv) with the columns node and
    direction (1 … 6, or x, y, z, rx, ry, rz). repeated : whether a row of the .dof may stand many times, as of nodes of shells.

    Raises FormatError.
    """
    if path.suffix == ".csv":
        return _from_table(path)
    out: list[Label] = []
    for number, line in text_lines(path):
        text = line.strip()
        if not text:
            continue
        node, _, direction = text.partition(".")
        if not node.isdecimal() or direction.strip() not in WORDS:
            raise FormatError(f"a node and a direction, such as `17.2`, was expected, got `{text[:40]}`", number)
        out.append((int(node), WORDS[direction.strip()]))
    return tuple(out) if repeated and out else _each_once(out)


def _from_table(path: Path) -> tuple[Label, ...]:
    out: list[Label] = []
    with path.open(encoding="utf-8", newline="") as file:
        for number, row in enumerate(csv.DictReader(file, skipinitialspace=True), start=2):
            node, direction = str(row.get("node") or "").strip(), str(row.get("direction") or "").strip()
            if not node.isdecimal() or direction not in WORDS:
                raise FormatError("the columns node and direction (1 … 6 or x … rz) were expected", number)
            out.append((int(node), WORDS[direction]))
    return _each_once(out)


def _each_once(labels: list[Label]) -> tuple[Label, ...]:
    if len(set(labels)) != len(labels):
        double = next(label for k, label in enumerate(labels) if label in labels[:k])
        raise FormatError(f"the degree of freedom {double[0]}.{double[1]} stands twice in the table `freedoms`")
    if not labels:
        raise FormatError("the table `freedoms` is empty")
    return tuple(labels)


def read_matrix_market(path: Path) -> FileMatrix:
    """A real matrix in Matrix Market format, sparse or dense. Raises FormatError."""
    try:
        matrix: Any = scipy.sparse.csc_array(scipy.io.mmread(path))
    except (ValueError, OverflowError) as error:
        raise FormatError(f"this is no Matrix Market file: {error}") from None
    if np.iscomplexobj(matrix.data):
        raise FormatError("the matrix is complex; a real one was expected")
    if matrix.shape[0] != matrix.shape[1]:
        raise FormatError(
            f"the matrix has {matrix.shape[0]} rows and {matrix.shape[1]} columns; a square one was expected"
        )
    return FileMatrix(matrix)
