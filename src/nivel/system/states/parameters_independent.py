"""q = (R, θ), v = q̇; coordinate partitioning chooses the independent ones among v."""

from __future__ import annotations

from dataclasses import replace

from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.system.elimination.partition import PARAMETERS, partition, velocities_named
from nivel.system.states import parameters
from nivel.system.system import Array, System


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers of the Lagrange equations with the arrays of a partition; the equations choose it at the first state that they are given."""
    system, start = parameters.arrange(machine, absolute, y, rank, settings)
    count, rows = system.body_count, len(system.rows)
    wanted = velocities_named(settings.independent, system.bodies, PARAMETERS)
    arrays = partition(count, rows, rank + count, system.size, wanted=wanted, turns=4)
    return replace(system, record=system.record._replace(partition=arrays)), start
