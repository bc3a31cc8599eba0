"""q = (R, θ), v = (Ṙ, ω̄): as assembled."""

from __future__ import annotations

from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.system.system import Array, System


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The same numbers, prepared for `rank` independent rows."""
    del machine, settings
    return absolute.known_rank(rank), y.copy()
