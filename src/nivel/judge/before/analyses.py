"""Machines without kinematics, inverse dynamics, statics or linear equations: what these analyses refuse, and why."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from nivel.analysis.assembly.equations import equations
from nivel.analysis.assembly.freedoms import coordinate_derivatives, freedoms
from nivel.analysis.preparation.preparation import Prepared
from nivel.errors import Fault, ModelError
from nivel.judge.before.refusals import refuse_rolling
from nivel.machine.control.order import PartOf, parts_of
from nivel.machine.control.unit import UnitBlock
from nivel.machine.forces.contact import Contact
from nivel.machine.forces.friction import Friction
from nivel.machine.forces.sticking import holds_by_capacity
from nivel.machine.forces.transmission_loss import TransmissionLoss
from nivel.machine.laws.symbols import find_in, follows_control, is_output
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.statics import StaticsSettings
from nivel.system.beams.nodes import with_nodes


def refuse_what_bends(machine: MachineRecord) -> None:
    """Raises ModelError for bodies whose form, wheels whose way, and states whose values drivers do not determine."""
    refuse_rolling(machine, "use `nivel run`")
    faults = [
        Fault.at(
            f"bodies.{body.name}.flexible",
            "drivers alone do not determine the motion of a flexible body: use `nivel run`",
        )
        for body in machine.bodies
        if body.flexible is not None
    ]
    faults += [
        Fault.at(f"beams.{beam.name}", "drivers alone do not determine the motion of a beam: use `nivel run`")
        for beam in machine.beams
    ]
    faults += [
        Fault.at(
            f"states.{state.name}",
            "a state has a history, which kinematics does not compute: use `nivel run`",
        )
        for state in machine.states
    ]
    if faults:
        raise ModelError(faults)


def refuse_free_motions(machine: MachineRecord, prepared: Prepared) -> None:
    """Raises ModelError where motions are not driven, naming coordinates to drive; or are driven twice."""
    redundancy = prepared.redundancy
    driven = [name for name in redundancy.redundant_rows if name.endswith(".driver")]
    if driven:
        names = ", ".join(name.removesuffix(".driver") for name in driven)
        message = f"the drivers prescribe more motions than there are degrees of freedom: {names} follows from the others; leave "
        "one out"
        raise ModelError(Fault.at("drivers", message))
    count = redundancy.degrees_of_freedom
    if count == 0:
        return
    free = free_coordinates(machine, prepared)
    what = f"{count} motion{'s are' if count > 1 else ' is'} not driven"
    how = f"drive {' and '.join(free)}, by `drivers` in the file or `--drive`" if free else "add drivers"
    if free and len(free) < count:
        how += f"; {count - len(free)} of them no joint coordinate measures, e.g. the spin of a rod between two ball joints: hold it"
    raise ModelError(Fault.at("machine", f"{what}, and kinematics needs all of them: {how}; or use `nivel run`"))


def free_coordinates(machine: MachineRecord, prepared: Prepared) -> list[str]:
    """Joint coordinates that can be chosen apart from each other, as many as there are free motions."""
    motion = equations(with_nodes(machine), measured=True)
    system = motion.system
    motion.evaluate(0.0, prepared.assembly.y)
    found = freedoms(motion)
    places = system.record.joints.coordinate.astype(np.int64).tolist()
    if found is None or not places:
        return []
    chosen = found.independent(coordinate_derivatives(motion, places))
    return [system.layout.coordinates["joint_coordinate"][k] for k in chosen]


def refuse_for_inverse(machine: MachineRecord) -> None:
    """Raises ModelError with everything that has no part in inverse dynamics."""
    refuse_rolling(machine, "drive the wheels with `nivel run` and read the efforts of the drivers")
    faults = [
        Fault.at(
            f"bodies.{body.name}.flexible",
            "the frame of a flexible body does not determine its motion: make the body rigid",
        )
        for body in machine.bodies
        if body.flexible is not None
    ]
    faults += [
        Fault.at(f"beams.{beam.name}", "drivers do not determine the motion of a beam: leave the beam out")
        for beam in machine.beams
    ]
    if faults:
        raise ModelError(faults)


MOST = 1500  # velocities of full matrices


def refuse_jumps(machine: MachineRecord, sliding: Collection[str] = (), *, may_slide: bool = False) -> None:
    """Raises ModelError with all forces and states whose effect is no smooth function of the state. sliding : names of forces that slide at
    the state, as all that have a place for it `may_slide`."""
    faults = [
        Fault.at(
            f"forces.{force.name}.model",
            f"'{force.model}' friction has no derivative where it sticks: leave it out, use a damper in the joint, or use `lugre`",
        )
        for force in machine.forces
        if isinstance(force, Friction) and force.model == "stiction" and force.name not in sliding and not may_slide
    ]
    faults += [
        Fault.at(
            f"forces.{force.name}",
            f"a {force.type} has no derivative where it holds: couple what it holds, or leave it out",
        )
        for force in machine.forces
        if holds_by_capacity(force)
        and force.name not in sliding
        and not (may_slide and not isinstance(force, TransmissionLoss))
    ]
    faults += [
        Fault.at(
            f"forces.{force.name}.friction",
            "friction of a contact that sticks has no derivative: give a `friction_transition_speed`, as in "
            "`friction_transition_speed: 1 cm/s`, and linear equations have the smooth law of this speed; or leave the friction out",
        )
        for force in machine.forces
        if isinstance(force, Contact) and force.sticks and force.friction_transition_speed is None
    ]
    faults += [
        Fault.at(
            f"states.{state.name}.event",
            "a state that an event samples jumps at no given times, so that it has no linear equations: write it as a `rate`, or sample it "
            "with `every`",
        )
        for state in machine.states
        if state.event is not None
    ]
    faults += [
        Fault.at(
            f"control.{block.name}.type",
            "code of another program has no derivative: leave out the block to open the loop, or write it with blocks of `control`",
        )
        for block in machine.control
        if isinstance(block, UnitBlock)
    ]
    faults += [
        Fault.at(
            f"control.{each.block.name}{f'.{each.part.key}' if each.part.key else ''}",
            "a sample of what forces or flows report has no derivative here: read a pressure, a place or a speed, or leave out the block",
        )
        for each in parts_of(machine.control)
        if each.part.role in ("sample", "memory") and _reads_reports(each, machine)
    ]
    if faults:
        raise ModelError(faults)


def _reads_reports(each: PartOf, machine: MachineRecord) -> bool:
    """Whether a part reads what is known only when all forces and flows are."""
    own = {other.path for other in parts_of(machine.control)}
    symbols = [find_in(path, machine.index) for path in each.signals if path not in own]
    return any(is_output(symbol, machine.index) or follows_control(symbol, machine.index) for symbol in symbols)


def refuse_samples(machine: MachineRecord) -> None:
    """Raises ModelError with all states and blocks that are sampled, for what knows motions in continuous time alone."""
    faults = [
        Fault.at(
            f"states.{state.name}.update",
            "a sampled state changes in jumps, which linear equations in continuous time cannot describe: write it as a `rate`",
        )
        for state in machine.states
        if state.update is not None
    ]
    faults += [
        Fault.at(
            f"control.{block.name}.sample_time",
            "a sampled block changes in jumps, which linear equations in continuous time cannot describe: leave out `sample_time` "
            "to make it continuous, or leave out the block to open the loop",
        )
        for block in machine.control
        if block.sample_time is not None
    ]
    if faults:
        raise ModelError(faults)


def refuse_friction(machine: MachineRecord) -> None:
    """Friction that holds at rest: which of the many equilibria it holds depends on how the machine came there."""
    faults = [
        Fault.at(
            f"forces.{force.name}.model",
            f"'{force.model}' holds at rest with any force up to static friction, so there are many equilibria, and the actual one "
            f"depends on the previous motion: leave the friction out, use coulomb, which exerts no force at rest, or simulate with "
            f"a damper until the machine rests",
        )
        for force in machine.forces
        if isinstance(force, Friction) and force.model != "coulomb"
    ]
    faults += [
        Fault.at(
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
        Fault.at(
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
