"""q = (R, θ), v = (Ṙ, ω̄): as assembled; coordinate partitioning chooses the independent ones among v."""

from __future__ import annotations

from dataclasses import replace

from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.system.elimination.partition import partition, velocities_named
from nivel.system.system import Array, System


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The same numbers, prepared for `rank` independent rows."""
    del machine, settings
    return absolute.known_rank(rank), y.copy()


def arrange_independent(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The same numbers with the arrays of a partition; the equations choose it at the first state that they are given."""
    del machine
    system = absolute.known_rank(rank)
    wanted = velocities_named(settings.independent, system.bodies)
    arrays = partition(system.body_count, len(system.rows), rank, system.size, wanted=wanted)
    return replace(system, record=system.record._replace(partition=arrays)), y.copy()
