"""Elements of a machine in statics: what is refused, what makes no force at rest, and with which coordinates it is solved."""

from __future__ import annotations

from nivel.analysis.plan.choice import choose_coordinates
from nivel.analysis.plan.smooth_contacts import with_smooth_contacts
from nivel.analysis.statics.free_coordinates import holding_free
from nivel.errors import Fault, ModelError
from nivel.machine.forces import Contact, Friction, holds_by_capacity
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.statics import StaticsSettings


def refuse_friction(machine: MachineRecord) -> None:
    """Friction that holds at rest: which of the many equilibria it holds depends on how the machine came there."""
    faults = [
        Fault(
            "",
            0,
            0,
            f"forces.{force.name}.model",
            f"'{force.model}' holds at rest with any force up to static friction, so there are many equilibria, and the actual one "
            f"depends on the previous motion: leave the friction out, use coulomb, which exerts no force at rest, or simulate with "
            f"a damper until the machine rests",
        )
        for force in machine.forces
        if isinstance(force, Friction) and force.model != "coulomb"
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"forces.{force.name}",
            f"a {force.type} holds at rest with any effort up to its greatest one, so there are many equilibria, and the actual one "
            f"depends on the previous motion: leave it out, couple what it holds, or simulate with a damper until the machine rests",
        )
        for force in machine.forces
        if holds_by_capacity(force)
    ]
    if faults:
        raise ModelError(faults)


def refuse_with_states(machine: MachineRecord, settings: StaticsSettings) -> None:
    """What first-order states have no part in: paths by arc length, vibrations and buckling loads."""
    names = [state.name for state in machine.states if state.rate is not None or state.every is not None]
    names += [block.name for block in machine.control if any(part.role != "signal" for part in block.parts)]
    asked = {"arc_length": settings.arc_length, "modes": settings.modes, "buckling": settings.buckling}
    faults = [
        Fault(
            "",
            0,
            0,
            f"statics.{name}",
            f"`{name.replace('_', '-')}` knows positions alone, and this machine has first-order states ({_named(names)}): leave it out; "
            f"equilibria by load steps, and whether small motions about them grow, are found with the states",
        )
        for name, wanted in asked.items()
        if wanted and names
    ]
    if faults:
        raise ModelError(faults)


def at_rest(machine: MachineRecord) -> tuple[str, ...]:
    """Sentences on what makes no force at rest."""
    rubbing = [force.name for force in machine.forces if isinstance(force, Friction)]
    damping = [
        force.name
        for force in machine.forces
        if not isinstance(force, Friction) and any(getattr(force, name, None) for name in DAMPING)
    ]
    out = []
    if damping:
        out.append(f"dampers exert no force at rest ({_named(damping)})")
    if rubbing:
        out.append(f"coulomb friction depends on speed and exerts no force at rest ({_named(rubbing)})")
    touching = [force.name for force in machine.forces if isinstance(force, Contact) and force.friction]
    if touching:
        out.append(f"friction of contacts exerts no force at rest ({_named(touching)})")
    if machine.events:
        out.append("events are ignored")
    return tuple(out)


DAMPING = ("damping", "rotational_damping", "viscous")
SHOWN = 4


def _named(names: list[str]) -> str:
    return ", ".join(names[:SHOWN]) + (f" and {len(names) - SHOWN} more" if len(names) > SHOWN else "")


def for_statics(machine: MachineRecord, settings: StaticsSettings) -> tuple[MachineRecord, str]:
    """The machine with simulation settings that mean nothing but the equations of statics, and the coordinates."""
    duration = settings.duration or 1.0
    simulation = machine.simulation.replace(
        integrator="generalised-alpha",
        formulation="newton-euler",
        coordinates=settings.coordinates,
        stabilisation="direct",
        rotations="euler-parameters",
        baumgarte=None,
        independent=(),
        start="as-given",
        duration=duration,
        step=min(settings.interval, duration),
        output_interval=None,
        step_control="own",
    )
    neutral = holding_free(with_smooth_contacts(machine).with_simulation(simulation))
    coordinates = choose_coordinates(neutral)
    return neutral.with_simulation(neutral.simulation.replace(coordinates=coordinates)), coordinates
