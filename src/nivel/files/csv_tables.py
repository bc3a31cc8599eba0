"""Tables that stand in CSV files: a column of values over a column of times, each with its unit."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from nivel.errors import Fault
from nivel.files.outline import section_of
from nivel.files.python_laws import WITH_LAWS
from nivel.files.sources import Sources
from nivel.files.tree import Path, Tree
from nivel.machine.core.record import unknown_word
from nivel.machine.units.quantity import ANY, read_quantity, shown
from nivel.machine.units.tree import TIME, ExpressionError

KEYS: Final = ("csv", "column", "units", "time", "time_units", "of", "interpolation")
MOST_ROWS: Final = 100_000
_HEADING: Final = re.compile(r"\s*(?P<name>.*?)\s*(?:[\[(](?P<units>[^\])]*)[\])])?\s*")


@dataclass(frozen=True)
class Column:
    """Numbers of a column, the line of each in its file, and the unit that its heading names."""

    numbers: list[float]
    lines: list[int]
    units: str


class CsvError(Exception):
    """What is wrong with a CSV file; `key`: of the table that asks for it; `line`: of the file, or 0."""

    def __init__(self, message: str, key: str = "csv", line: int = 0) -> None:
        super().__init__(message)
        self.key, self.line = key, line


def read_csv_tables(tree: Tree, sources: Sources) -> None:
    """Put the columns of `csv: cycle.csv` into each table, as `times` or `points` and `values`. Faults go to `tree.faults`."""
    for section in WITH_LAWS:
        for path, table in list(_tables(section_of(tree, section), (section,))):
            found = sources.text(tree, (*path, "csv"), table["csv"])
            if found is None:
                tree.broken.add(path)
                continue
            try:
                _fill(table, *found)
            except CsvError as problem:
                if problem.line:
                    tree.faults.append(Fault(found[1], problem.line, 1, ".".join(map(str, path)), str(problem)))
                    tree.broken.add(path)
                else:
                    tree.report((*path, problem.key), str(problem))
                    tree.broken.add(path)


def _tables(value: Any, path: Path) -> Iterator[tuple[Path, dict[str, Any]]]:
    """Every mapping under `value` that names a CSV file."""
    if isinstance(value, dict):
        if "csv" in value:
            yield path, value
        for key, each in value.items():
            yield from _tables(each, (*path, key))
    elif isinstance(value, list):
        for at, each in enumerate(value):
            yield from _tables(each, (*path, at))


def _fill(table: dict[str, Any], text: str, file: str) -> None:
    """Replace what is said of the file by its columns. Raises CsvError."""
    for key in table:
        if key not in KEYS:
            raise CsvError(unknown_word(str(key), KEYS, "key"), str(key))
    columns = _columns(text)
    names = list(columns)
    first = table.get("time", names[0])
    chosen = table.get("column", names[1] if len(names) == 2 else None)
    for key, name in (("time", first), ("column", chosen)):
        if name is None:
            listing = ", ".join(f"`{each}`" for each in names)
            raise CsvError(f"`column` is missing: `{file}` has {listing}")
        if name not in columns:
            raise CsvError(f"in `{file}`, {unknown_word(str(name), names, 'column')}", key)
    of, interpolation = table.get("of", TIME), table.get("interpolation")
    points, values = columns[str(first)], columns[str(chosen)]
    new: dict[str, Any] = {
        "times" if of == TIME else "points": _with_units(points, table.get("time_units"), "time_units"),
        "values": _with_units(values, table.get("units"), "units"),
    }
    for k in range(1, len(points.numbers)):
        if not points.numbers[k] > points.numbers[k - 1]:
            raise CsvError(
                f"`{first}` increases; {points.numbers[k]:g} does not come after {points.numbers[k - 1]:g}",
                line=points.lines[k],
            )
    table.clear()
    table.update(new)
    if of != TIME:
        table["of"] = of
    if interpolation is not None:
        table["interpolation"] = interpolation


def _columns(text: str) -> dict[str, Column]:
    """The columns by the names of their headings. Raises CsvError."""
    lines = text.splitlines()
    heading = next((line for line in lines if line.strip()), "")
    delimiter = max(",;\t", key=heading.count)
    rows = [
        (number, row)
        for number, row in enumerate(csv.reader(io.StringIO(text), delimiter=delimiter), 1)
        if any(each.strip() for each in row)
    ]
    if len(rows) < 2 or len(rows[0][1]) < 2:
        raise CsvError("a heading with two columns or more, separated by commas, and rows of numbers were expected")
    if len(rows) > MOST_ROWS:
        raise CsvError(f"{len(rows)} rows; up to {MOST_ROWS} are taken")
    columns: dict[str, Column] = {}
    for at, heading in enumerate(rows[0][1]):
        found = _HEADING.fullmatch(heading)
        assert found is not None  # it fits every text
        name, units = found["name"], found["units"] or ""
        if not name or _number(name, delimiter) is not None:
            raise CsvError(
                f"the first row names the columns, such as `time [s]{delimiter} angle [deg]`; got {shown(heading)}",
                line=rows[0][0],
            )
        if name in columns:
            raise CsvError(f"the column `{name}` stands twice", line=rows[0][0])
        columns[name] = Column([], [], units)
        for number, row in rows[1:]:
            value = _number(row[at], delimiter) if at < len(row) else None
            if value is None:
                got = shown(row[at]) if at < len(row) else "nothing"
                raise CsvError(f"a number was expected in the column `{name}`, got {got}", line=number)
            columns[name].numbers.append(value)
            columns[name].lines.append(number)
    return columns


def _number(text: str, delimiter: str) -> float | None:
    """The number in a cell; where columns are separated by semicolons, a comma is a decimal point."""
    try:
        value = float(text.replace(",", ".") if delimiter == ";" else text)
    except ValueError:
        return None
    return value if abs(value) < float("inf") else None


def _with_units(column: Column, units: object, key: str) -> list[Any]:
    """The numbers in SI; the first as a text with its unit, which is held against what is expected. Raises CsvError."""
    unit = column.units if units is None else units
    if unit in ("", "-", "1", None):
        return list(column.numbers)
    try:
        factor = read_quantity(f"1 {unit}", ANY, {})
    except ExpressionError as problem:
        raise CsvError(f"the unit {shown(unit)}: {problem}", key if units is not None else "csv") from None
    first, *others = column.numbers
    return [f"{first!r} {unit}", *(factor * each for each in others)]
