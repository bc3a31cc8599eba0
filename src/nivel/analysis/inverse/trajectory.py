"""Joint trajectories from a table: drivers that follow them."""

from __future__ import annotations

import csv
from os import PathLike, fspath
from typing import Any

from nivel.errors import Fault, ModelError
from nivel.machine.coordinate_reference import UnknownCoordinateError, resolve
from nivel.machine.driver import Driver
from nivel.machine.machine_record import MachineRecord

TIME = "time"
FEWEST = 4  # points of a spline


def along_trajectory(machine: MachineRecord, path: str | PathLike[str]) -> MachineRecord:
    """The machine with its coordinates driven along the columns of a CSV file: `time` [s], then joint coordinates [rad or m], between
    which splines pass. Drivers of other coordinates stay. Raises ModelError with everything that is wrong."""
    names, columns = _read(fspath(path))
    faults: list[Fault] = []
    drivers: list[Driver] = []
    driven: set[str] = set()
    for name, values in zip(names[1:], columns[1:], strict=True):
        try:
            joint, coordinate = resolve(name, machine.joints)
        except UnknownCoordinateError as error:
            faults.append(_fault(str(error)))
            continue
        driven.add(f"{joint}.{coordinate}")
        table: Any = {"times": columns[0], "values": values, "interpolation": "cubic"}
        drivers.append(Driver(name=f"follow_{joint}_{coordinate}", coordinate=f"{joint}.{coordinate}", value=table))
    if faults:
        raise ModelError(faults)
    kept = tuple(each for each in machine.drivers if each.coordinate not in driven)
    simulation = machine.simulation.replace(duration=columns[0][-1])
    return machine.replace(drivers=(*kept, *drivers), simulation=simulation)


def _read(path: str) -> tuple[list[str], list[list[float]]]:
    """Header and columns of the table."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file) if row]
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ModelError(_fault(f"the trajectory {path} cannot be read: {reason.lower()}")) from error
    names = [name.strip() for name in rows[0]] if rows else []
    if not names or names[0] != TIME or len(names) < 2:
        raise ModelError(_fault(f"the first line of {path} must be `time,JOINT.COORDINATE,…`, got `{','.join(names)}`"))
    columns: list[list[float]] = [[] for _ in names]
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(names):
            raise ModelError(_fault(f"line {number} of {path} has {len(row)} columns, the first line has {len(names)}"))
        for column, text in zip(columns, row, strict=True):
            try:
                column.append(float(text))
            except ValueError:
                raise ModelError(_fault(f"line {number} of {path}: `{text}` is not a number")) from None
    if len(columns[0]) < FEWEST or columns[0][0] != 0.0:
        raise ModelError(_fault(f"{path} must have at least {FEWEST} lines of numbers, from time 0 on"))
    return names, columns


def _fault(message: str) -> Fault:
    return Fault("", 0, 0, "inverse.trajectory", message)
