"""Whether the settings of a run go together and with the machine: everything that does not, at once and before anything is compiled."""

from __future__ import annotations

from collections.abc import Callable

from nivel.analysis.choice import choose_coordinates
from nivel.analysis.refusals import (
    refuse_conserved_drivers,
    refuse_flexible_lagrange,
    refuse_for_shared_mass,
    refuse_friction_at_jumps,
    refuse_rough_motions,
    refuse_stiction_over_steps,
)
from nivel.analysis.settings import complete
from nivel.errors import Fault, ModelError
from nivel.machine.machine_record import MachineRecord


def disagreements(machine: MachineRecord) -> list[Fault]:
    """The faults of the settings of `machine`, by themselves and with its elements."""
    coordinates, formulation = choose_coordinates(machine), machine.simulation.formulation
    checks: list[Callable[[], object]] = [
        lambda: complete(machine.simulation, coordinates),
        lambda: refuse_for_shared_mass(machine, formulation, coordinates),
        lambda: refuse_flexible_lagrange(machine, formulation),
        lambda: refuse_conserved_drivers(machine),
        lambda: refuse_stiction_over_steps(machine),
        lambda: refuse_rough_motions(machine),
        lambda: refuse_friction_at_jumps(machine),
    ]
    faults: list[Fault] = []
    for check in checks:
        try:
            check()
        except ModelError as error:
            faults += error.faults
    return faults
