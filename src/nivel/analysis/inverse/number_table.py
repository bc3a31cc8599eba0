"""Tables of numbers as CSV files."""

from __future__ import annotations

import csv
from math import isfinite

from nivel.errors import Fault, ModelError


def read_table(path: str, option: str) -> tuple[list[str], list[list[float]]]:
    """Names and columns of a table with a line of names. option : that asked for it. Raises ModelError with the line that is wrong."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file) if row]
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ModelError(_fault(option, f"the table {path} cannot be read: {reason.lower()}")) from error
    names = [name.strip() for name in rows[0]] if rows else [""]
    columns: list[list[float]] = [[] for _ in names]
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(names):
            raise ModelError(
                _fault(option, f"line {number} of {path} has {len(row)} columns, the first line has {len(names)}")
            )
        for column, text in zip(columns, row, strict=True):
            column.append(_number(text, option, f"line {number} of {path}"))
    return names, columns


def _number(text: str, option: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not isfinite(value):
        raise ModelError(_fault(option, f"{where}: `{text}` is not a number"))
    return value


def _fault(option: str, message: str) -> Fault:
    return Fault.at(option, message)
