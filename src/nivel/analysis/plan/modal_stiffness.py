"""Machines whose only stiffness is that of the modes of their flexible bodies: some methods need no tangents of these."""

from __future__ import annotations

from nivel.analysis.plan.circuit_stiffness import only_circuits_are_stiff
from nivel.integrate.catalogue import BY_CIRCUITS, BY_FLEXIBLE_CIRCUITS, BY_MODES, INTEGRATORS, IntegratorFacts
from nivel.machine.forces import PointForce, Torque
from nivel.machine.machine_record import MachineRecord


def only_modes_are_stiff(machine: MachineRecord) -> bool:
    """Whether a machine has flexible bodies, and besides weight no forces but those that are given in time."""
    return (
        machine.is_flexible
        and not machine.beams
        and all(isinstance(each, PointForce | Torque) for each in machine.forces)
    )


def integrator_of(machine: MachineRecord, coordinates: str) -> IntegratorFacts:
    """The integrator of a run of `machine` in these coordinates."""
    name = machine.simulation.integrator
    if name in BY_CIRCUITS and goes_by_circuits(machine, coordinates):
        return (BY_FLEXIBLE_CIRCUITS if machine.is_flexible else BY_CIRCUITS)[name]
    return BY_MODES[name] if name in BY_MODES and goes_by_modes(machine, coordinates) else INTEGRATORS[name]


def goes_by_circuits(machine: MachineRecord, coordinates: str) -> bool:
    """Whether a machine is one for the integrators of BY_CIRCUITS."""
    formulation = machine.simulation.formulation
    return coordinates == "relative" and formulation == "newton-euler" and only_circuits_are_stiff(machine)


def goes_by_modes(machine: MachineRecord, coordinates: str) -> bool:
    """Whether a machine is one for the integrators of BY_MODES."""
    return coordinates == "relative" and only_modes_are_stiff(machine)
