"""What has no linear equations: friction that may stick, states that change in jumps."""

from __future__ import annotations

from nivel.errors import Fault, ModelError
from nivel.machine.forces import Friction
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
            f"'{force.model}' friction has no slope where it sticks: leave it out, give the joint a damper, or take `lugre`",
        )
        for force in machine.forces
        if isinstance(force, Friction) and force.model != "lugre"
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"states.{state.name}.update",
            "a sampled state changes in jumps, which linear equations in continuous time do not know: write it as a `rate`",
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
            "a sampled block changes in jumps, which linear equations in continuous time do not know: without `sample_time` it is "
            "continuous, and without the block the loop is open",
        )
        for block in machine.control
        if block.sample_time is not None
    ]
    if faults:
        raise ModelError(faults)
