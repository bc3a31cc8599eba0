"""Measurements to which a machine is fitted: from files, or arrays."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike, fspath
from typing import Any, Final

import numpy as np

from nivel.analysis.optimise.identify import Signal
from nivel.errors import Fault, ModelError, refuse
from nivel.files.csv_tables import CsvError, numeric_columns
from nivel.files.measured_file import KINDS
from nivel.files.sources import read_bytes, read_text
from nivel.machine.study.any_quantity import another_measure
from nivel.machine.study.output import SCALAR
from nivel.words.wording import shown

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
