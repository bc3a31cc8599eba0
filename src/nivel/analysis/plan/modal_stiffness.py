"""Machines whose only stiffness is that of the modes of their flexible bodies: some methods need no tangents of these."""

from __future__ import annotations

from collections.abc import Iterator

from nivel.analysis.plan.soft_forces import is_soft
from nivel.elements.circuits.component import Component
from nivel.elements.forces.loads import PointForce, Torque
from nivel.integrate.catalogue import INTEGRATORS, step_for
from nivel.integrate.facts import IntegratorFacts
from nivel.lazy import nivel
from nivel.machine.laws.symbols import find_symbol
from nivel.machine.laws.time_function import signals_of
from nivel.machine.machine_record import MachineRecord

MOVING = ("joints", "inputs", "markers", "bodies")  # what signals of the motion are read from


def only_circuits_are_stiff(machine: MachineRecord) -> bool:
    """Whether a machine has circuits with derivatives by hand, and besides them and weight no forces but soft ones and those given in
    time, no continuous states, and in circuits no commands that follow pressures at once."""
    return (
        bool(machine.hydraulics)
        and not machine.beams
        and all(is_soft(machine, each) for each in machine.forces)
        and all(state.update is not None for state in machine.states)
        and all(part.role != "state" for block in machine.control for part in block.parts)
        and nivel.system.circuit_elements.has_slopes(machine)
        and all(_waits(machine, path) for component in machine.hydraulics for path in _signals(component))
    )


def _signals(component: Component) -> Iterator[str]:
    """The paths of what a component follows."""
    for key in component.functions:
        yield from signals_of(getattr(component, key) or 0.0)


def _waits(machine: MachineRecord, path: str) -> bool:
    """Whether a signal follows the time, samples or the motion: what acts on a circuit is not back within a step."""
    blocks, open_paths = {block.name: block for block in machine.control}, [path]
    while open_paths:
        symbol = find_symbol(open_paths.pop(), machine)
        if symbol.section != "control" and symbol.section not in (*MOVING, "states"):
            return False
        # blocks may follow each other, and their own parts: each is looked at once
        if symbol.section == "control" and (block := blocks.pop(symbol.name, None)) is not None:
            present = [part.function for part in block.parts if part.role == "signal"]
            open_paths += [each for function in present for each in signals_of(function)]
    return True


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
    by_circuits = step_for(name, "flexible circuits" if machine.is_flexible else "circuits")
    if by_circuits and goes_by_circuits(machine, coordinates):
        return by_circuits
    by_modes = step_for(name, "modes")
    return by_modes if by_modes and goes_by_modes(machine, coordinates) else INTEGRATORS[name]


def goes_by_circuits(machine: MachineRecord, coordinates: str) -> bool:
    """Whether a machine is one for integrators that take derivatives of circuits by hand."""
    formulation = machine.simulation.formulation
    return coordinates == "relative" and formulation == "newton-euler" and only_circuits_are_stiff(machine)


def goes_by_modes(machine: MachineRecord, coordinates: str) -> bool:
    """Whether a machine is one for integrators that take derivatives of modes alone."""
    return coordinates == "relative" and only_modes_are_stiff(machine)
