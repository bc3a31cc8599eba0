"""Tables of inputs in files of columns: `time`, and a column with the input's name, or one called `value`."""

import csv
import re
from collections.abc import Mapping
from functools import partial
from os import PathLike, fspath
from typing import Final

import numpy as np

from nivel.errors import Fault, ModelError, gathered, refuse
from nivel.files.measured_file import KINDS, MeasuredError, measured_columns
from nivel.files.reader import read_text
from nivel.files.sources import read_bytes
from nivel.machine.laws.varying_value import Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.signals.input import Input
from nivel.machine.units.quantity import ANY, Kind, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.machine.uses.coordinate_reference import unknown_name

# `time`, `lever [deg]`, `lever (deg)`
HEAD: Final = re.compile(r"\s*(?P<name>[^\[\(]*?)\s*(?:[\[\(](?P<unit>[^\]\)]*)[\]\)])?\s*")


def read_input_table(path: str | PathLike[str], name: str) -> Table:
    """The table of the input `name` in a CSV, MAT or Parquet file, or a recording (MDF4, MCAP).

    A CSV file has a line of names, each with a unit in brackets or without, SI then, and lines of numbers.
    Raises ModelError with every fault, each with its line.
    """
    file = fspath(path)
    if file.lower().endswith(KINDS):
        return _measured_table(file, name)
    rows = [(at, row) for at, row in enumerate(csv.reader(read_text(file).splitlines()), 1) if any(map(str.strip, row))]
    if not rows:
        raise ModelError(Fault(file, 1, 1, "", "the file is empty; its first line should be: time,value"))
    line, head = rows[0]
    heads = [HEAD.fullmatch(each) for each in head]
    names = ["" if each is None else each["name"] for each in heads]
    units = ["" if each is None else each["unit"] or "" for each in heads]
    column = names.index(name) if name in names else 1 if len(names) == 2 and names[1] == "value" else 0
    if not names or names[0] != "time" or column == 0:
        wanted = f"a first line `time,{name}` or `time,value` was expected, got `{','.join(head)}`"
        raise ModelError(Fault(file, line, 1, "", wanted))
    faults: list[Fault] = []
    times = [_number(row, 0, units[0], "time", Fault(file, at, 1, "", ""), faults) for at, row in rows[1:]]
    values = [_number(row, column, units[column], ANY, Fault(file, at, 1, "", ""), faults) for at, row in rows[1:]]
    if not faults and not times:
        faults.append(Fault(file, line, 1, "", "no line of numbers follows the names"))
    for k in range(1, len(times)):
        if not faults and times[k] <= times[k - 1]:
            message = f"times increase; {times[k]:g} s does not come after {times[k - 1]:g} s"
            faults.append(Fault(file, rows[k + 1][0], 1, "", message))
    refuse(faults)
    return Table(tuple(times), tuple(values))


def _measured_table(file: str, name: str) -> Table:
    """The table in a binary file: its first column is the time, which is called so or `t`."""
    try:
        found = measured_columns(read_bytes(file), file, name)
    except MeasuredError as problem:
        raise ModelError(Fault(file, 0, 0, file, str(problem))) from None
    names = list(found)
    column = name if name in names else names[1] if len(names) == 2 and names[1] == "value" else ""
    if names[0].lower() not in ("time", "t") or not column:
        listing = ", ".join(names[:12])
        raise ModelError(
            Fault(file, 0, 0, file, f"a first column `time` and a column `{name}` were expected; there are {listing}")
        )
    columns = []
    for key, kind in ((names[0], "time"), (column, ANY)):
        values, unit = found[key]
        try:
            factor = read_quantity(f"1 {unit}", kind, {}) if unit else 1.0
        except ExpressionError as problem:
            raise ModelError(Fault(file, 0, 0, file, f"the unit of the column `{key}`: {problem}")) from None
        columns.append(factor * values)
    times, values = columns
    wrong = np.flatnonzero(~(np.isfinite(times) & np.isfinite(values)))
    back = np.flatnonzero(np.diff(times) <= 0.0)
    if len(wrong):
        raise ModelError(Fault(file, 0, 0, file, f"row {int(wrong[0]) + 1} has no number"))
    if len(back):
        k = int(back[0])
        raise ModelError(
            Fault(file, 0, 0, file, f"times increase; {times[k + 1]:g} s does not come after {times[k]:g} s")
        )
    return Table(tuple(times.tolist()), tuple(values.tolist()))


def with_signals(machine: MachineRecord, signals: Mapping[str, float | str | PathLike[str] | Table]) -> MachineRecord:
    """The machine whose inputs follow these numbers, tables or files.

    Raises ModelError with all faults.
    """
    known, faults = [each.name for each in machine.inputs], []
    changed = {each.name: each for each in machine.inputs}
    for name, given in signals.items():
        with gathered(faults, partial(_of_input, name, given)):
            changed[name] = _followed(changed.get(name), given, name, known)
    refuse(faults)
    return machine.replace(inputs=tuple(changed.values()))


def _followed(each: Input | None, given: float | str | PathLike[str] | Table, name: str, known: list[str]) -> Input:
    if each is None:
        raise ModelError(Fault.at(f"inputs.{name}", unknown_name("input", name, known)))
    return each.replace(signal=_signal(given, name))


def _signal(given: float | str | PathLike[str] | Table, name: str) -> float | Table:
    if isinstance(given, float | int | Table):
        return given
    try:
        return float(fspath(given))
    except ValueError:
        return read_input_table(given, name)


def _of_input(name: str, given: object, fault: Fault) -> Fault:
    """A fault of the record of an input, told with the file that the table came from."""
    if fault.line or not isinstance(given, str | PathLike):
        return fault
    return Fault.at(f"inputs.{name}", f"{fspath(given)}: {fault.message}")


def _number(row: list[str], column: int, unit: str, kind: Kind, place: Fault, faults: list[Fault]) -> float:
    """A cell in SI; 0 with a fault where it is none."""
    if column >= len(row):
        faults.append(Fault(place.file, place.line, 1, "", f"there is no column {column + 1} in this line"))
        return 0.0
    text = row[column].strip()
    try:
        return read_quantity(f"{text} {unit}".strip(), kind, {})
    except ExpressionError as problem:
        message = f"a number was expected, got `{text}`: {problem}"
        faults.append(Fault(place.file, place.line, 1, "", message))
        return 0.0
