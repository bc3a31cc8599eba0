"""Machines without inverse dynamics: bodies that bend, wheels that roll."""

from __future__ import annotations

from nivel.analysis.plan.nonholonomic_refusals import refuse_rolling
from nivel.errors import Fault, ModelError
from nivel.machine.machine_record import MachineRecord


def refuse_for_inverse(machine: MachineRecord) -> None:
    """Raises ModelError with everything that has no part in inverse dynamics."""
    refuse_rolling(machine, "drive the wheels with `nivel run` and read the efforts of the drivers")
    faults = [
        Fault(
            "",
            0,
            0,
            f"bodies.{body.name}.flexible",
            "the frame of a flexible body does not determine its motion: make the body rigid",
        )
        for body in machine.bodies
        if body.flexible is not None
    ]
    faults += [
        Fault("", 0, 0, f"beams.{beam.name}", "drivers do not determine the motion of a beam: leave the beam out")
        for beam in machine.beams
    ]
    if faults:
        raise ModelError(faults)
