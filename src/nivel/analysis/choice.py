"""What `coordinates: auto` means for a machine."""

from __future__ import annotations

from nivel.machine.machine_record import MachineRecord


def choose_coordinates(machine: MachineRecord) -> str:
    """The coordinates of a run of `machine`: its own, or for `auto` the fastest that fit its formulation."""
    asked = machine.simulation.coordinates
    return "absolute" if asked == "auto" else asked
