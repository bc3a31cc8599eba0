"""q = (R, θ), v = (Ṙ, ω̄): as assembled; coordinate partitioning chooses the independent ones among v."""

from __future__ import annotations

from dataclasses import replace

from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.system.build import build
from nivel.system.elimination.partition import PARAMETERS, partition, velocities_named
from nivel.system.system import Array, Equations, System


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


# q = (R, θ), v = q̇: seven velocities a body and one normalisation row; partitioning chooses the independent ones among v.


def arrange_parameters(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers of the Lagrange equations in Euler parameters."""
    del settings
    system = build(machine, Equations(7, normalisation=True))
    system.record.constraints.offset[:] = absolute.record.constraints.offset
    count = absolute.body_count
    v = y[7 * count : 13 * count].reshape(count, 6)
    return system.known_rank(rank + count), system.state(y[: 7 * count], v[:, :3], v[:, 3:])


def arrange_independent_parameters(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers of the Lagrange equations with the arrays of a partition; the equations choose it at the first state that they are given."""
    system, start = arrange_parameters(machine, absolute, y, rank, settings)
    count, rows = system.body_count, len(system.rows)
    wanted = velocities_named(settings.independent, system.bodies, PARAMETERS)
    arrays = partition(count, rows, rank + count, system.size, wanted=wanted, turns=4)
    return replace(system, record=system.record._replace(partition=arrays)), start
