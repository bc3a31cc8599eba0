"""Tables that stand in files, CSV, MAT or Parquet: a column of values over a column of times, each with its unit."""

import csv
import io
import re
from collections.abc import Callable, Iterator, Mapping
from itertools import islice
from typing import Any, Final

import numpy as np

from nivel.errors import Fault
from nivel.files.code import WITH_LAWS, mappings_with
from nivel.files.measured_file import KINDS, MeasuredError, measured_columns
from nivel.files.outline import section_of
from nivel.files.sources import Sources
from nivel.files.tree import Path, Tree
from nivel.lazy import Struct
from nivel.machine.core.record import unknown_word
from nivel.machine.units.quantity import ANY, read_quantity, shown
from nivel.machine.units.tree import TIME, ExpressionError

KEYS: Final = ("csv", "column", "units", "time", "time_units", "time_offset", "of", "interpolation")
MOST_ROWS: Final = 20_000_000
_HEADING: Final = re.compile(r"\s*(?P<name>.*?)\s*(?:[\[(](?P<units>[^\])]*)[\])])?\s*")


Reader = Callable[[dict[str, Any], Any, str], Any]


class Column(Struct):
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
        for path, table in list(mappings_with(("csv",), section_of(tree, section), (section,))):
            with_table(tree, sources, path, table, _fill)


def with_table(tree: Tree, sources: Sources, path: Path, table: dict[str, Any], read: Reader) -> Any:
    """What `read` makes of a mapping with `csv: FILE`, of content and name of the file; None where that has faults, which go to
    `tree.faults`."""
    binary = str(table["csv"]).lower().endswith(KINDS)
    found = (sources.content if binary else sources.text)(tree, (*path, "csv"), table["csv"], breaks=path)
    if found is None:
        return None
    try:
        return read(table, *found)
    except CsvError as problem:
        if problem.line:
            tree.faults.append(Fault(found[1], problem.line, 1, ".".join(map(str, path)), str(problem)))
            tree.broken.add(path)
        else:
            tree.report((*path, problem.key), str(problem), breaks=path)
        return None


def column_values(table: Mapping[str, Any], content: str | bytes, file: str) -> list[Any]:
    """The numbers of the `column` of a file, with the `units` of a table. Raises CsvError."""
    column = table.get("column")
    given = _Rows(content, least=1) if isinstance(content, str) else _Measured(content, file, column)
    name = given.names[0] if column is None and len(given.names) == 1 else column
    (found,) = given.columns(_known(name, given.names, "column", file))
    return _with_units(found, table.get("units"), "units")


def _known(name: object, names: list[str], key: str, file: str) -> str:
    """The name of a column under `key` of a table, one of the `names` of its file. Raises CsvError."""
    if name is None:
        listing = ", ".join(f"`{each}`" for each in names)
        raise CsvError(f"`column` is missing: `{file}` has {listing}")
    if name not in names:
        raise CsvError(f"in `{file}`, {unknown_word(str(name), names, 'column')}", key)
    return str(name)


def numeric_columns(content: str | bytes, file: str) -> dict[str, tuple[list[float], str]]:
    """Numbers of all columns in SI units with the unit of their heading, by name. Raises CsvError."""
    given = _Rows(content) if isinstance(content, str) else _Measured(content, file)
    found = zip(given.names, given.columns(*given.names), strict=True)
    return {
        name: ([float(read_quantity(each, ANY, {})) for each in _with_units(column, None, "csv")], column.units or "")
        for name, column in found
    }


def _fill(table: dict[str, Any], content: str | bytes, file: str) -> None:
    """Replace what is said of the file by its columns. Raises CsvError."""
    for key in table:
        if key not in KEYS:
            raise CsvError(unknown_word(str(key), KEYS, "key"), str(key))
    given = _Rows(content) if isinstance(content, str) else _Measured(content, file, table.get("column"))
    names = given.names
    first = _known(table.get("time", names[0]), names, "time", file)
    chosen = _known(table.get("column", names[1] if len(names) == 2 else None), names, "column", file)
    of, interpolation = table.get("of", TIME), table.get("interpolation")
    points, values = given.columns(first, chosen)
    offset = _offset(table.get("time_offset"))
    if offset and of != TIME:
        raise CsvError(f"`time_offset` belongs to times; the table is over `{of}`", "time_offset")
    if offset:
        unit = points.units if table.get("time_units") is None else table["time_units"]
        points = Column([value + offset / _factor(unit) for value in points.numbers], points.lines, points.units)
    new: dict[str, Any] = {
        "times" if of == TIME else "points": _with_units(points, table.get("time_units"), "time_units"),
        "values": _with_units(values, table.get("units"), "units"),
    }
    for k in range(1, len(points.numbers)):
        if not points.numbers[k] > points.numbers[k - 1]:
            same = "; delete one of both rows" if points.numbers[k] == points.numbers[k - 1] else ""
            raise CsvError(
                f"`{first}` increases; {points.numbers[k]:g} does not come after {points.numbers[k - 1]:g}{same}",
                line=points.lines[k],
            )
    table.clear()
    table.update(new)
    if of != TIME:
        table["of"] = of
    if interpolation is not None:
        table["interpolation"] = interpolation


class _Rows:
    """The rows of a CSV file. Raises CsvError."""

    def __init__(self, text: str, least: int = 2) -> None:
        heading = next((line for line in text.splitlines() if line.strip()), "")
        self.text, self.delimiter = text, max(",;\t", key=heading.count)
        rows = self._rows()
        self.line, head = next(rows, (0, []))
        if len(head) < least or next(rows, None) is None:
            columns = "two columns or more, separated by commas," if least > 1 else "names of columns"
            raise CsvError(f"a heading with {columns} and rows of numbers were expected")
        self.names: list[str] = []
        self.units: list[str] = []
        for each in head:
            found = _HEADING.fullmatch(each)
            assert found is not None  # it fits every text
            name = found["name"]
            if not name or _number(name, self.delimiter) is not None:
                raise CsvError(
                    f"the first row names the columns, such as `time [s]{self.delimiter} angle [deg]`; got {shown(each)}",
                    line=self.line,
                )
            if name in self.names:
                raise CsvError(f"the column `{name}` stands twice", line=self.line)
            self.names.append(name)
            self.units.append(found["units"] or "")

    def _rows(self) -> Iterator[tuple[int, list[str]]]:
        reader = csv.reader(io.StringIO(self.text), delimiter=self.delimiter)
        return ((number, row) for number, row in enumerate(reader, 1) if any(each.strip() for each in row))

    def columns(self, *wanted: str) -> list[Column]:
        """Columns by their names; the others may hold anything."""
        places = [self.names.index(name) for name in wanted]
        out = [Column([], [], self.units[at]) for at in places]
        for number, row in islice(self._rows(), 1, None):
            for column, at in zip(out, places, strict=True):
                value = _number(row[at], self.delimiter) if at < len(row) else None
                if value is None:
                    got = shown(row[at]) if at < len(row) else "nothing"
                    raise CsvError(f"a number was expected in the column `{self.names[at]}`, got {got}", line=number)
                column.numbers.append(value)
                column.lines.append(number)
            if len(out[0].numbers) > MOST_ROWS:
                raise CsvError(f"more than {MOST_ROWS} rows")
        return out


class _Measured:
    """The columns of a binary file. Raises CsvError."""

    def __init__(self, content: bytes, file: str, column: object = None) -> None:
        try:
            self.found = measured_columns(content, file, None if column is None else str(column))
        except MeasuredError as problem:
            raise CsvError(f"`{file}`: {problem}") from None
        self.names = list(self.found)

    def columns(self, *wanted: str) -> list[Column]:
        """Columns by their names."""
        out = []
        for name in wanted:
            values, unit = self.found[name]
            bad = np.flatnonzero(~np.isfinite(values))
            if len(bad):
                raise CsvError(f"the column `{name}` has no number in row {int(bad[0]) + 1}")
            out.append(Column(values.tolist(), [0] * len(values), unit))
        return out


def _offset(given: object) -> float:
    """[s] that is added to all times. Raises CsvError."""
    if given is None:
        return 0.0
    try:
        return read_quantity(given, "time", {})
    except ExpressionError as problem:
        raise CsvError(f"an offset such as `-12 s` was expected: {problem}", "time_offset") from None


def _number(text: str, delimiter: str) -> float | None:
    """The number in a cell; where columns are separated by semicolons, a comma is a decimal point."""
    try:
        value = float(text.replace(",", ".") if delimiter == ";" else text)
    except ValueError:
        return None
    return value if abs(value) < float("inf") else None


def _factor(unit: object) -> float:
    """One unit of the times [s]."""
    try:
        return 1.0 if unit in ("", "-", "1", None) else read_quantity(f"1 {unit}", "time", {})
    except ExpressionError:
        return 1.0  # it is refused where the numbers get their unit


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
