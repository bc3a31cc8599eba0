"""Nastran OUTPUT4 files (.op4), text and binary, dense and sparse. MSC Nastran DMAP guide, OUTPUT4.

A matrix is a header record, one record for each column that is not empty, and a record of a column one beyond the last. In
sparse records the values come in strings, each with its length and first row packed in one word, or in two (BIGMAT).
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np
import scipy.sparse as sp

from nivel.flexible.foreign.matrix import FileMatrix, FormatError, fortran_number

SINGLE, DOUBLE = 1, 2
PACKED: Final = 65536
NUMBER: Final = re.compile(r"[-+]?\d*\.\d*(?:[EDed][-+]?\d+|[-+]\d+)?")
Columns = list[tuple[int, list[int], list[float]]]


def read_op4(path: Path) -> dict[str, FileMatrix]:
    """All real matrices of a file, by name; symmetric ones that have one triangle are completed.

    Raises FormatError.
    """
    content = path.read_bytes()
    try:
        found = dict(_text(content.decode("ascii")) if _is_text(content) else _binary(content))
    except (struct.error, IndexError, UnicodeDecodeError, ValueError) as error:
        if isinstance(error, FormatError):
            raise
        raise FormatError(f"this is no OUTPUT4 file, or it ends too early ({error})") from None
    if not found:
        raise FormatError("there is no matrix in this file")
    return found


def _is_text(content: bytes) -> bool:
    return content[:200].isascii() and b"\x00" not in content[:200]


def _matrix(rows: int, columns: int, form: int, data: Columns) -> FileMatrix:
    i = np.concatenate([np.array(r, dtype=np.int64) for _, r, _ in data] or [np.zeros(0, dtype=np.int64)])
    j = np.concatenate([np.full(len(r), c, dtype=np.int64) for c, r, _ in data] or [np.zeros(0, dtype=np.int64)])
    values = np.concatenate([np.array(v) for _, _, v in data] or [np.zeros(0)])
    if rows != columns:
        raise FormatError(f"the matrix has {rows} rows and {columns} columns; a square one was expected")
    matrix = sp.csc_array((values, (i, j)), shape=(rows, columns))
    one_side = form == 6 and (sp.tril(matrix, -1).nnz == 0) != (sp.triu(matrix, 1).nnz == 0)
    if one_side:
        matrix = sp.csc_array(matrix + matrix.T - sp.diags_array(matrix.diagonal()))
    return FileMatrix(matrix)


def _text(content: str) -> Iterator[tuple[str, FileMatrix]]:
    lines = iter(content.splitlines())
    for header in lines:
        if not header.strip():
            continue
        columns, rows, form, kind = (int(header[8 * k : 8 * k + 8]) for k in range(4))
        if kind > DOUBLE:
            raise FormatError("the matrix is complex; a real one was expected")
        name = header[32:40].strip().upper()
        data = _text_columns(lines, columns, kind, most=abs(rows), big=rows < 0)
        yield name, _matrix(abs(rows), columns, form, data)


def _text_columns(lines: Iterator[str], count: int, kind: int, *, most: int, big: bool) -> Columns:
    """The columns of a matrix of `most` rows."""
    out: Columns = []
    per_value = 1 if kind == SINGLE else 2  # words
    for line in lines:
        column, first, words = (int(line[8 * k : 8 * k + 8]) for k in range(3))
        if column > count:
            _values(lines, 1)
            return out
        if first > 0:
            number = _at_most(most, words // per_value)
            out.append((column - 1, list(range(first - 1, first - 1 + number)), _values(lines, number)))
            continue
        while words > 0:
            string = _next(lines)
            if big:
                length, row = int(string[:8]) - 1, int(string[8:16])
                words -= length + 2
            else:
                packed = int(string)
                length, row = packed // PACKED - 1, packed % PACKED
                words -= length + 1
            number = _at_most(most, length // per_value)
            out.append((column - 1, list(range(row - 1, row - 1 + number)), _values(lines, number)))
    raise FormatError("the file ends within a matrix")


def _next(lines: Iterator[str]) -> str:
    for line in lines:
        return line
    raise FormatError("the file ends within a matrix")


def _at_most(most: int, number: int) -> int:
    """The number of values in a column, which has no more than rows. Raises FormatError."""
    if number > most:
        raise FormatError(f"a column of {number} values does not fit into {most} rows")
    return number


def _values(lines: Iterator[str], count: int) -> list[float]:
    """The next `count` numbers; fields may touch each other."""
    out: list[float] = []
    while len(out) < count:
        out += [fortran_number(each) for each in NUMBER.findall(_next(lines))]
    return out


def _binary(content: bytes) -> Iterator[tuple[str, FileMatrix]]:
    """Fortran records between two marks of their length; header of 24 bytes, either end of words first."""
    order = "<" if struct.unpack_from("<i", content)[0] == 24 else ">"
    records = _records(content, order)
    for record in records:
        columns, rows, form, kind = struct.unpack_from(f"{order}4i", record)
        if kind > DOUBLE:
            raise FormatError("the matrix is complex; a real one was expected")
        name = record[16:24].decode("ascii").strip().upper()
        yield name, _matrix(abs(rows), columns, form, _binary_columns(records, columns, kind, order, big=rows < 0))


def _records(content: bytes, order: str) -> Iterator[bytes]:
    at = 0
    while at + 4 <= len(content):
        (length,) = struct.unpack_from(f"{order}i", content, at)
        yield content[at + 4 : at + 4 + length]
        at += length + 8


def _binary_columns(records: Iterator[bytes], count: int, kind: int, order: str, *, big: bool) -> Columns:
    out: Columns = []
    per_value, dtype = (1, f"{order}f4") if kind == SINGLE else (2, f"{order}f8")
    for record in records:
        column, first, words = struct.unpack_from(f"{order}3i", record)
        if column > count:
            return out
        if first > 0:
            values = np.frombuffer(record, dtype, words // per_value, 12)
            out.append((column - 1, list(range(first - 1, first - 1 + len(values))), values.tolist()))
            continue
        at, end = 12, 12 + 4 * words
        while at < end:
            if big:
                length, row = struct.unpack_from(f"{order}2i", record, at)
                length, at = length - 1, at + 8
            else:
                (packed,) = struct.unpack_from(f"{order}i", record, at)
                length, row, at = packed // PACKED - 1, packed % PACKED, at + 4
            values = np.frombuffer(record, dtype, length // per_value, at)
            out.append((column - 1, list(range(row - 1, row - 1 + len(values))), values.tolist()))
            at += 4 * length
    raise FormatError("the file ends within a matrix")
