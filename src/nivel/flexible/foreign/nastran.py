"""Nastran: DMIG entries of punch files, and GRID entries of bulk data.

Fields of 8 columns, of 16 where the first ends with `*`, or separated by commas. MSC Nastran Quick Reference Guide, DMIG.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np

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
        raise FormatError(f"the number {max(numbers, key=abs):.3g} of a node has more than 18 digits")
    return np.array(numbers, dtype=np.int64), np.array(places, dtype=float).reshape(-1, 3)
