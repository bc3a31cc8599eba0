"""What has no linear equations: friction that may stick, states that change in jumps; and the machine with neutral settings."""

from __future__ import annotations

from nivel.analysis.choice import choose_coordinates
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
    if faults:
        raise ModelError(faults)


def neutral(machine: MachineRecord, coordinates: str, start: str) -> tuple[MachineRecord, str]:
    """The machine with settings that mean nothing but its equations of motion in these coordinates, and the coordinates chosen."""
    simulation = machine.simulation.replace(
        integrator="rk4",
        formulation="newton-euler",
        coordinates=coordinates,
        stabilisation="direct",
        rotations="euler-parameters",
        baumgarte=None,
        start=start,
        output_interval=None,
        step_control="own",
    )
    changed = machine.replace(simulation=simulation)
    # joint coordinates measure what spins
    joined = coordinates == "auto" and machine.joints and not machine.is_flexible and not machine.beams
    chosen = "relative" if joined else choose_coordinates(changed)
    return changed.replace(simulation=simulation.replace(coordinates=chosen)), chosen
