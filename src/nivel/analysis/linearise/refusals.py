"""Machines without linear equations: friction that may stick, states that change in jumps."""

from __future__ import annotations

from nivel.errors import Fault, ModelError
from nivel.machine.forces import Contact, Friction, holds_by_capacity
from nivel.machine.machine_record import MachineRecord

MOST = 1500  # velocities of full matrices


def refuse_jumps(machine: MachineRecord) -> None:
    """Raises ModelError with all forces and states whose effect is no smooth function of the state."""
    faults = [
        Fault(
            "",
            0,
            0,
            f"forces.{force.name}.model",
            f"'{force.model}' friction has no derivative where it sticks: leave it out, use a damper in the joint, or use `lugre`",
        )
        for force in machine.forces
        if isinstance(force, Friction) and force.model != "lugre"
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"forces.{force.name}",
            f"a {force.type} has no derivative where it holds: couple what it holds, or leave it out",
        )
        for force in machine.forces
        if holds_by_capacity(force)
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"forces.{force.name}.friction",
            "friction of a contact that sticks has no derivative: give a `friction_transition_speed`, as in "
            "`friction_transition_speed: 1 cm/s`, and linear equations have the smooth law of this speed; or leave the friction out",
        )
        for force in machine.forces
        if isinstance(force, Contact) and force.sticks and force.friction_transition_speed is None
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"states.{state.name}.update",
            "a sampled state changes in jumps, which linear equations in continuous time cannot describe: write it as a `rate`",
        )
        for state in machine.states
        if state.update is not None
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"control.{block.name}.sample_time",
            "a sampled block changes in jumps, which linear equations in continuous time cannot describe: leave out `sample_time` "
            "to make it continuous, or leave out the block to open the loop",
        )
        for block in machine.control
        if block.sample_time is not None
    ]
    if faults:
        raise ModelError(faults)
