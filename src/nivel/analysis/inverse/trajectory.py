"""Joint trajectories from a table: drivers that follow them."""

from __future__ import annotations

from os import PathLike, fspath
from typing import Any

from nivel.analysis.inverse.number_table import read_table
from nivel.analysis.kinematics.drive import released
from nivel.errors import Fault, ModelError, refuse
from nivel.machine.joints.driver import Driver
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import UnknownCoordinateError, resolve

TIME = "time"
FEWEST = 4  # points of a spline


def along_trajectory(machine: MachineRecord, path: str | PathLike[str]) -> MachineRecord:
    """The machine with its coordinates driven along the columns of a CSV file: `time` [s], then joint coordinates [rad or m], between
    which splines pass. Drivers of other coordinates stay. Raises ModelError with everything that is wrong."""
    file = fspath(path)
    names, columns = read_table(file, "inverse.trajectory")
    if names[0] != TIME or len(names) < 2:
        raise ModelError(_fault(f"the first line of {file} must be `time,JOINT.COORDINATE,…`, got `{','.join(names)}`"))
    if len(columns[0]) < FEWEST or columns[0][0] != 0.0:
        raise ModelError(_fault(f"{file} must have at least {FEWEST} lines of numbers, from time 0 on"))
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
    refuse(faults)
    kept = tuple(each for each in machine.drivers if each.coordinate not in driven)
    simulation = machine.simulation.replace(duration=columns[0][-1])
    joints = released(machine.joints, driven)
    return machine.replace(joints=joints, drivers=(*kept, *drivers), simulation=simulation)


def _fault(message: str) -> Fault:
    return Fault.at("inverse.trajectory", message)
