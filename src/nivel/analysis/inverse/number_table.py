"""Tables of numbers as CSV files."""

from __future__ import annotations

import csv
from math import isfinite
from os import PathLike, fspath
from typing import Any

import numpy as np

from nivel.analysis.kinematics.drive import released
from nivel.elements.joints.drivers import Driver
from nivel.errors import Fault, ModelError, refuse
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import UnknownCoordinateError, resolve
from nivel.system.system import Array


def read_table(path: str, option: str) -> tuple[list[str], list[list[float]]]:
    """Names and columns of a table with a line of names. option : that asked for it. Raises ModelError with the line that is wrong."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file) if row]
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ModelError(Fault.at(option, f"the table {path} cannot be read: {reason.lower()}")) from error
    names = [name.strip() for name in rows[0]] if rows else [""]
    columns: list[list[float]] = [[] for _ in names]
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(names):
            raise ModelError(
                Fault.at(option, f"line {number} of {path} has {len(row)} columns, the first line has {len(names)}")
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
        raise ModelError(Fault.at(option, f"{where}: `{text}` is not a number"))
    return value


PLACE, AXES = ("time", "x", "y", "z"), ("e0", "e1", "e2", "e3")


def read_path(path: str) -> tuple[Array, Array, Array | None]:
    """Times (T,) [s], places (T, 3) [m] and Euler parameters (T, 4) or None. Raises ModelError."""
    names, columns = read_table(path, "inverse.path")
    if tuple(names) not in (PLACE, PLACE + AXES) or not columns[0]:
        wanted = f"`{','.join(PLACE)}`, with `{','.join(AXES)}` behind them or not, and then numbers"
        raise ModelError(Fault.at("inverse.path", f"{path} must begin with {wanted}; got `{','.join(names)}`"))
    values = np.array(columns)
    return values[0], values[1:4].T, values[4:].T if len(values) > len(PLACE) else None


TIME = "time"
FEWEST = 4  # points of a spline


def along_trajectory(machine: MachineRecord, path: str | PathLike[str]) -> MachineRecord:
    """The machine with its coordinates driven along the columns of a CSV file: `time` [s], then joint coordinates [rad or m], between
    which splines pass. Drivers of other coordinates stay. Raises ModelError with everything that is wrong."""
    file = fspath(path)
    names, columns = read_table(file, "inverse.trajectory")
    if names[0] != TIME or len(names) < 2:
        raise ModelError(
            _wrong_end(f"the first line of {file} must be `time,JOINT.COORDINATE,…`, got `{','.join(names)}`")
        )
    if len(columns[0]) < FEWEST or columns[0][0] != 0.0:
        raise ModelError(_wrong_end(f"{file} must have at least {FEWEST} lines of numbers, from time 0 on"))
    faults: list[Fault] = []
    drivers: list[Driver] = []
    driven: set[str] = set()
    for name, values in zip(names[1:], columns[1:], strict=True):
        try:
            joint, coordinate = resolve(name, machine.joints)
        except UnknownCoordinateError as error:
            faults.append(_wrong_end(str(error)))
            continue
        driven.add(f"{joint}.{coordinate}")
        table: Any = {"times": columns[0], "values": values, "interpolation": "cubic"}
        drivers.append(Driver(name=f"follow_{joint}_{coordinate}", coordinate=f"{joint}.{coordinate}", value=table))
    refuse(faults)
    kept = tuple(each for each in machine.drivers if each.coordinate not in driven)
    simulation = machine.simulation.replace(duration=columns[0][-1])
    joints = released(machine.joints, driven)
    return machine.replace(joints=joints, drivers=(*kept, *drivers), simulation=simulation)


def _wrong_end(message: str) -> Fault:
    return Fault.at("inverse.trajectory", message)
