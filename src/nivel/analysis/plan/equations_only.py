"""A machine with settings that mean nothing but its equations of motion: for analyses that integrate nothing."""

from __future__ import annotations

from nivel.analysis.plan.choice import choose_coordinates
from nivel.machine.machine_record import MachineRecord


def neutral(machine: MachineRecord, coordinates: str, start: str = "as-given") -> tuple[MachineRecord, str]:
    """The machine in these coordinates, with settings of no method, and the coordinates that were chosen."""
    simulation = machine.simulation.replace(
        integrator="rk4",
        step=min(machine.simulation.step, machine.simulation.duration),
        output_interval=None,
        formulation="newton-euler",
        coordinates=coordinates,
        stabilisation="direct",
        rotations="euler-parameters",
        baumgarte=None,
        start=start,
        step_control="own",
    )
    changed = machine.replace(simulation=simulation)
    # joint coordinates measure what spins
    joined = coordinates == "auto" and machine.joints and not machine.is_flexible and not machine.beams
    chosen = "relative" if joined else choose_coordinates(changed)
    return changed.replace(simulation=simulation.replace(coordinates=chosen)), chosen
