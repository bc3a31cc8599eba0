"""Nastran: DMIG entries of punch files, and GRID entries of bulk data.

Fields of 8 columns, of 16 where the first ends with `*`, or separated by commas. MSC Nastran Quick Reference Guide, DMIG.

Nastran OUTPUT4 files (.op4), text and binary, dense and sparse. MSC Nastran DMAP guide, OUTPUT4.
A matrix is a header record, one record for each column that is not empty, and a record of a column one beyond the last. In
sparse records the values come in strings, each with its length and first row packed in one word, or in two (BIGMAT).
"""

import re
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np
import scipy.sparse as sp

from nivel.flexible.foreign.matrix import FileMatrix, FormatError, Label, fortran_number, from_labelled, text_lines
from nivel.lazy import dataclass, field

SYMMETRIC: Final = 6


@dataclass
class _Entries:
    form: int = SYMMETRIC
    rows: list[Label] = field(default_factory=list)
    columns: list[Label] = field(default_factory=list)
    values: list[float] = field(default_factory=list)


def read_dmig(path: Path) -> dict[str, FileMatrix]:
    """All real DMIG matrices of a file, by name. Scalar points count as direction 1.

    Raises FormatError.
    """
    found: dict[str, _Entries] = {}
    for line, fields in entries(path):
        if fields[0].upper() != "DMIG":
            continue
        try:
            _read(found, fields)
        except (ValueError, IndexError) as error:
            raise FormatError(str(error) or "this DMIG entry cannot be read", line) from None
    for name, each in found.items():
        if len({*zip(each.rows, each.columns, strict=True)}) < len(each.values):
            raise FormatError(
                f"elements of the matrix {name} stand twice; a symmetric one (form 6) has one triangle only"
            )
    return {
        name: from_labelled(each.rows, each.columns, each.values, triangle=each.form == SYMMETRIC)
        for name, each in found.items()
        if each.values
    }


def _read(found: dict[str, _Entries], fields: list[str]) -> None:
    name = fields[1].upper()
    if fields[2] == "0":
        form, kind = int(fields[3]), int(fields[4])
        if kind > 2:
            raise ValueError(f"the matrix {name} is complex; a real stiffness or mass matrix was expected")
        found[name] = _Entries(form)
        return
    if name not in found:
        raise ValueError(f"the matrix {name} has no header entry (DMIG, {name}, 0, …)")
    each = found[name]
    column = (int(fields[2]), int(fields[3] or 0) or 1)
    for at in range(5, len(fields), 4):
        group = [*fields[at : at + 3], "", "", ""][:3]
        if not any(group):
            continue
        row = (int(group[0]), int(group[1] or 0) or 1)
        value = fortran_number(group[2])
        if each.form == SYMMETRIC and row > column:
            row_, column_ = column, row  # one triangle, whichever the file has
        else:
            row_, column_ = row, column
        each.rows.append(row_)
        each.columns.append(column_)
        each.values.append(value)


def read_grids(path: Path) -> tuple[list[int], list[list[float]]]:
    """Numbers and places of the GRID entries of bulk data.

    Raises FormatError where a point is in a local coordinate system.
    """
    numbers, places = [], []
    for line, fields in entries(path):
        if fields[0].upper() != "GRID":
            continue
        _, number, frame, x, y, z, moved = [*fields, *[""] * 7][:7]
        if frame not in ("", "0") or moved not in ("", "0"):
            message = f"GRID {number} is in a local coordinate system; write all points in the basic system"
            raise FormatError(message, line)
        try:
            numbers.append(int(number))
            places.append([fortran_number(each) if each else 0.0 for each in (x, y, z)])
        except ValueError as error:
            raise FormatError(f"this GRID entry cannot be read: {error}", line) from None
    return numbers, places


def entries(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Bulk data entries with their continuations: the line where each starts, and its fields; field 0 is its name.

    Continuation markers are left out; a large-field entry has its fields in the same order.
    """
    fields: list[str] = []
    start = 0
    for number, text in text_lines(path):
        line = text.split("$")[0].rstrip()
        if not line:
            continue
        part = _fields(line)
        first = part[0].rstrip("*").strip()
        if fields and (first == "" or first.startswith("+")):
            fields += part[1:]
            continue
        if fields:
            yield start, fields
        fields, start = [first, *part[1:]], number
    if fields:
        yield start, fields


def _fields(line: str) -> list[str]:
    """Fields of one line without the last one, which only marks the continuation. Of a line of large fields there are four."""
    if "," in line:
        parts = [part.strip() for part in line.split(",")]
        return [*parts, *[""] * 9][: 5 if parts[0].endswith("*") else 9]
    line = line.expandtabs(8)
    width, count = (16, 4) if line[:8].rstrip().endswith("*") else (8, 8)
    cells = [line[8 + width * k : 8 + width * (k + 1)].strip() for k in range(count)]
    return [line[:8].strip(), *cells]


def table(numbers: list[int], places: list[list[float]]) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (n,) and places (n, 3) as arrays. Raises FormatError where a number has more than 18 digits."""
    if numbers and max(map(abs, numbers)) >= 10**18:
        raise FormatError(f"the number {str(max(numbers, key=abs))[:18]}… of a node has more than 18 digits")
    return np.array(numbers, dtype=np.int64), np.array(places, dtype=float).reshape(-1, 3)


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
