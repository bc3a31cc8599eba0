"""Lagrange equations in Euler angles: q = (R, φ of every body, p), v = q̇: with the modes of flexible bodies, which start undeformed."""

from __future__ import annotations

from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings import SimulationSettings
from nivel.system.states import euler_angles
from nivel.system.states.floating import bent
from nivel.system.system import Array, System


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """Numbers of the Lagrange equations in Euler angles, with modes.

    Raises ModelError naming every marker of a flexible body that is at no interface of it.
    """
    return bent(machine, *euler_angles.arrange(machine, absolute, y, rank, settings))
