"""Rotation vectors from the orientation at the start: ψ = 0 there, so every body may turn by nearly a full turn in any direction.

A rotation vector of the orientation itself (|ψ| ≤ π at the start) would leave as little as half a turn.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.record.record import ROTATION_VECTOR
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.system.states.three_coordinates import arranged
from nivel.system.system import Array, System


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers of the Lagrange equations in rotation vectors; ψ̇ = ω̄ at the start."""
    del machine, settings
    count = absolute.body_count
    unturned = np.tile((1.0, 0.0, 0.0, 0.0), (count, 1))
    angular_velocity = y[7 * count : 13 * count].reshape(count, 6)[:, 3:]
    start = np.zeros((count, 3))
    return arranged(absolute.known_rank(rank), y, ROTATION_VECTOR, unturned, unturned, start, angular_velocity)
