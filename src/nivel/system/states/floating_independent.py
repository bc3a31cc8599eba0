"""q = (R, θ of every body, p), v = (Ṙ, ω̄ of every body, ṗ); coordinate partitioning chooses the independent ones among v."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.system.elimination.partition import RELUCTANCE, partition, velocities_named
from nivel.system.states import floating
from nivel.system.system import Array, System


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The machine with modes and the arrays of a partition, which has modal velocities among the independent ones where it can.

    Raises ModelError naming every marker of a flexible body that is at no interface of it.
    """
    system, start = floating.arrange(machine, absolute, y, rank, settings)
    record = system.record
    # modes of unit modal mass move their body by about p/√m; they too are independent where they can
    mass = np.repeat(
        record.bodies.mass[record.flexible.body], np.diff(record.flexible.mode.astype(int), axis=1).ravel()
    )
    modal, wanted = RELUCTANCE * system.size * np.sqrt(mass), velocities_named(settings.independent, system.bodies)
    arrays = partition(system.body_count, len(system.rows), rank, system.size, modal, wanted)
    return replace(system, record=record._replace(partition=arrays)), start
