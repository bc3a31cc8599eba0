"""Contacts whose friction is smooth: for analyses in which nothing comes to rest, as of equilibria and of small motions."""

from __future__ import annotations

from typing import Final

from nivel.machine.forces.contact import Contact
from nivel.machine.machine_record import MachineRecord

TRANSITION: Final = 1e-3  # [m/s] where no `friction_transition_speed` is given


def with_smooth_contacts(machine: MachineRecord) -> MachineRecord:
    """The machine with `friction_model: coulomb` in every contact that would stick: at rest it exerts no friction."""
    forces = tuple(
        force.replace(
            friction_model="coulomb",
            static_friction=None,
            friction_transition_speed=force.friction_transition_speed or TRANSITION,
        )
        if isinstance(force, Contact) and force.sticks
        else force
        for force in machine.forces
    )
    return machine if forces == tuple(machine.forces) else machine.replace(forces=forces)
