"""Inputs over time as parameters: values of a table between which they change along straight lines (direct shooting)."""

from collections.abc import Mapping
from os import PathLike, fspath
from typing import Any, Final

import numpy as np

from nivel.analysis.optimise.evaluations import Box
from nivel.analysis.optimise.identify import Signal
from nivel.errors import Fault, ModelError, refuse
from nivel.files.csv_tables import CsvError, numeric_columns
from nivel.files.measured_file import KINDS
from nivel.files.sources import read_bytes, read_text
from nivel.lazy import Struct
from nivel.machine.laws.varying_value import Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.study.any_quantity import another_measure
from nivel.machine.study.parameter import SCALAR
from nivel.words.wording import shown, unknown_word


class Course(Struct):
    """Inputs as tables, the paths of whose values are the parameters. names : of the inputs; times : (n,) [s] of the corners."""

    record: MachineRecord
    box: Box
    names: tuple[str, ...]
    times: tuple[float, ...]

    def tables(self, values: Mapping[str, float]) -> dict[str, Table]:
        """The inputs for values by path."""
        rows = {name: tuple(values[_path(name, k)] for k in range(len(self.times))) for name in self.names}
        return {name: Table(times=self.times, values=row) for name, row in rows.items()}


def course_of(record: MachineRecord, inputs: Mapping[str, int], duration: float) -> Course:
    """inputs : by name into how many pieces, all of one length, the duration [s] is cut; the same of all. Raises ModelError."""
    known, faults = {each.name: each for each in record.inputs}, []
    for name, pieces in inputs.items():
        if name not in known:
            faults.append(Fault.at("inputs", unknown_word(name, list(known), "input")))
        elif not isinstance(pieces, int) or isinstance(pieces, bool) or pieces < 1:
            faults.append(Fault.at(f"inputs.{name}", f"a number of pieces was expected, got {shown(pieces)}"))
        elif not np.isfinite(known[name].range).all():
            message = f"the input `{name}` needs a range, within which it is looked for: range: [-10, 10]"
            faults.append(Fault.at(f"inputs.{name}.range", message))
    if not inputs:
        faults.append(Fault.at("inputs", "name the inputs and their pieces, {'push': 10}"))
    if len({*inputs.values()}) > 1 and not faults:
        faults.append(Fault.at("inputs", "all inputs are cut into the same number of pieces"))
    refuse(faults)
    (pieces,) = {*inputs.values()}
    times = tuple(float(t) for t in np.linspace(0.0, duration, pieces + 1))
    paths, low, high, start, changed = [], [], [], [], []
    for each in record.inputs:
        if each.name not in inputs:
            changed.append(each)
            continue
        rest = min(max(0.0, each.range[0]), each.range[1])
        changed.append(each.replace(signal=Table(times=times, values=(rest,) * len(times))))
        paths += [_path(each.name, k) for k in range(len(times))]
        low += [each.range[0]] * len(times)
        high += [each.range[1]] * len(times)
        start += [rest] * len(times)
    box = Box(tuple(paths), np.array(low), np.array(high), np.array(start))
    names = tuple(each.name for each in record.inputs if each.name in inputs)
    return Course(record.replace(inputs=tuple(changed)), box, names, times)


def _path(name: str, k: int) -> str:
    return f"inputs.{name}.signal.values.{k}"


Columns = tuple[np.ndarray, np.ndarray, str]  # times [s], values in SI units, and the unit of the heading

TIME: Final = "time"


def signals_of(data: str | PathLike[str] | Mapping[str, Any], deviations: Mapping[str, float]) -> list[Signal]:
    """data : a file with a column `time` and columns with names of results; or (times, values) by name. Numbers without history (`SCALAR`)
    need no times: columns of repeated measurements, or one or more numbers by name. Raises ModelError."""
    given = _arrays(data) if isinstance(data, Mapping) else _columns(fspath(data))
    there = ", ".join(f"`{name}`" for name in given)
    faults = [
        Fault.at(f"deviations.{name}", f"there are no measurements of `{name}`; there are {there}")
        for name in deviations
        if name not in given
    ]
    faults += [
        Fault.at(f"deviations.{name}", f"a number above zero in SI units was expected, got {shown(value)}")
        for name, value in deviations.items()
        if name in given and not (isinstance(value, int | float) and value > 0.0)
    ]
    if not given:
        faults.append(Fault.at("data", "there are no measurements"))
    refuse(faults)
    return [Signal(name, times, values, deviations.get(name), units) for name, (times, values, units) in given.items()]


def _arrays(data: Mapping[str, Any]) -> dict[str, Columns]:
    out, faults = {}, []
    for name, pair in data.items():
        try:
            both = (np.zeros(np.size(pair)), pair) if SCALAR.fullmatch(name) else pair
            times, values = (np.asarray(each, dtype=float).ravel() for each in both)
        except (TypeError, ValueError):
            faults.append(Fault.at(f"data.{name}", f"times and values were expected, got {shown(pair)}"))
            continue
        if not np.isfinite([*times, *values]).all():
            faults.append(Fault.at(f"data.{name}", "times and values have numbers that are not finite"))
        elif len(times) != len(values):
            message = f"as many numbers as times were expected, got {len(values)} over {len(times)}"
            faults.append(Fault.at(f"data.{name}", message))
        out[name] = (times, values, "")
    refuse(faults)
    return out


def _columns(file: str) -> dict[str, Columns]:
    content = read_bytes(file) if file.lower().endswith(KINDS) else read_text(file)
    try:
        columns = numeric_columns(content, file)
    except CsvError as problem:
        raise ModelError(Fault(file, problem.line, 1 if problem.line else 0, "", str(problem))) from None
    if all(SCALAR.fullmatch(name) for name in columns):
        return {name: (np.zeros(len(values)), np.array(values), units) for name, (values, units) in columns.items()}
    if TIME not in columns:
        message = f"a column `time` is missing; there are {', '.join(f'`{name}`' for name in columns)}"
        raise ModelError(Fault(file, 1, 1, "", message))
    times, units = columns.pop(TIME)
    if wrong := another_measure(f"1 {units}" if units else "0", "s"):
        raise ModelError(Fault(file, 1, 1, TIME, wrong))
    return {name: (np.array(times), np.array(values), units) for name, (values, units) in columns.items()}
