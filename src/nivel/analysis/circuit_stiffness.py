"""Machines whose only stiffness is that of their circuits and modes: `extrapolated-euler` needs no tangents of all else there."""

from __future__ import annotations

from nivel.machine.forces import PointForce, Torque
from nivel.machine.hydraulics import Component
from nivel.machine.machine_record import MachineRecord
from nivel.machine.symbols import find_symbol
from nivel.machine.time_function import signals_of
from nivel.system.hydraulics.components import families_of
from nivel.system.hydraulics.tangent import DERIVED, WITHOUT

MOVING = ("joints", "inputs", "markers", "bodies")  # what signals of the motion are read from


def only_circuits_are_stiff(machine: MachineRecord) -> bool:
    """Whether a machine has circuits with derivatives by hand, and besides them and weight no forces but those given in
    time, no states but sampled ones, and in circuits no commands that follow pressures at once."""
    return (
        bool(machine.hydraulics)
        and not machine.beams
        and all(isinstance(each, PointForce | Torque) for each in machine.forces)
        and all(state.update is not None for state in machine.states)
        and all(block.is_sampled for block in machine.control)
        and set(families_of(machine)) <= {*DERIVED, *WITHOUT}
        and all(_commands_wait(machine, component) for component in machine.hydraulics)
    )


def _commands_wait(machine: MachineRecord, component: Component) -> bool:
    """Whether what may vary in a component follows time, samples or the motion."""
    paths = [path for key in component.functions for path in signals_of(getattr(component, key) or 0.0)]
    return all(find_symbol(path, machine).section in (*MOVING, "states", "control") for path in paths)
