"""Whether the settings of a run go together and with the machine: everything that does not, at once and before anything is compiled."""

from __future__ import annotations

from nivel.analysis.choice import choose_coordinates
from nivel.analysis.refusals import refuse_conserved_drivers
from nivel.analysis.settings import complete
from nivel.errors import Fault, ModelError
from nivel.machine.machine_record import MachineRecord


def disagreements(machine: MachineRecord) -> list[Fault]:
    """The faults of the settings of `machine`, by themselves and with its drivers."""
    faults: list[Fault] = []
    try:
        complete(machine.simulation, choose_coordinates(machine))
    except ModelError as error:
        faults += error.faults
    try:
        refuse_conserved_drivers(machine)
    except ModelError as error:
        faults += error.faults
    return faults
