"""A machine with settings that mean nothing but its equations of motion: for analyses that integrate nothing."""

from __future__ import annotations

from typing import Final

from nivel.analysis.plan.choice import choose_coordinates
from nivel.elements.contacts.contact import Contact, Contacts
from nivel.elements.forces.friction import Friction
from nivel.machine.machine_record import MachineRecord

TRANSITION: Final = 1e-3  # [m/s] where no `friction_transition_speed` is given


def with_smooth_contacts(machine: MachineRecord) -> MachineRecord:
    """The machine with `friction_model: coulomb` in every contact that would stick: at rest it exerts no friction."""
    forces = tuple(
        force.replace(
            friction_model="coulomb",
            static_friction=None,
            rolling_resistance=0.0,
            patch_radius=None,
            friction_transition_speed=force.friction_transition_speed or TRANSITION,
        )
        if isinstance(force, Contact) and force.sticks
        else force
        for force in machine.forces
    )
    return machine if forces == tuple(machine.forces) else machine.replace(forces=forces)


def without_sticking(machine: MachineRecord) -> tuple[MachineRecord, tuple[str, ...]]:
    """The machine without its contacts and without friction of joints that sticks, and the names of what is left out: their efforts at rest
    are no function of the state. Raises ModelError where something reads one of them."""
    left = tuple(
        force.name
        for force in machine.forces
        if isinstance(force, Contact | Contacts) or (isinstance(force, Friction) and force.model == "stiction")
    )
    forces = tuple(force for force in machine.forces if force.name not in left)
    return (machine.replace(forces=forces) if left else machine), left


def neutral(machine: MachineRecord, coordinates: str, start: str = "as-given") -> tuple[MachineRecord, str]:
    """The machine in these coordinates, with settings of no method, and the coordinates that were chosen."""
    machine = with_smooth_contacts(machine)
    given = machine.simulation
    step, interval = min(given.step, given.duration), given.output_interval
    simulation = given.replace(
        integrator="rk4",
        step=step,
        # one below a step that nobody gave is that of an integrator that chooses its own
        output_interval=None if interval is None or interval < step else interval,
        formulation="newton-euler",
        coordinates=coordinates,
        stabilisation="direct",
        rotations="euler-parameters",
        baumgarte=None,
        independent=(),
        start=start,
        step_control="own",
    )
    changed = machine.replace(simulation=simulation)
    # joint coordinates measure what spins
    joined = coordinates == "auto" and machine.joints and not machine.is_flexible and not machine.beams
    chosen = "relative" if joined else choose_coordinates(changed)
    return changed.replace(simulation=simulation.replace(coordinates=chosen)), chosen
