"""Machines without kinematics, inverse dynamics, statics or linear equations: what these analyses refuse, and why."""

from collections.abc import Collection, Iterator
from operator import attrgetter

import numpy as np

from nivel.analysis.assembly.equations import equations
from nivel.analysis.assembly.named_freedoms import coordinate_derivatives, freedoms
from nivel.analysis.preparation.preparation import Prepared
from nivel.elements.contacts.contact import Contact
from nivel.elements.control.units import UnitBlock
from nivel.elements.forces.drive_lines import TransmissionLoss, holds_by_capacity
from nivel.elements.forces.friction import Friction
from nivel.errors import Fault
from nivel.judge.before.refusals import ON_SOIL, Refusal, faults_of, rolling
from nivel.machine.control.order import PartOf, parts_of
from nivel.machine.core.element import ForceElement
from nivel.machine.laws.symbols import find_in, follows_control, is_output
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import StaticsSettings
from nivel.system.beam_nodes import with_nodes
from nivel.words.wording import first_of

MOST = 1500  # velocities of full matrices
ALL = bool  # of elements that are there
BY_DRIVERS = "drivers alone do not determine the motion of a {}: use `nivel run`"
OF_KINEMATICS = (
    rolling("use `nivel run`"),
    Refusal("bodies", "flexible", attrgetter("flexible"), BY_DRIVERS.format("flexible body")),
    Refusal("beams", "", ALL, BY_DRIVERS.format("beam")),
    Refusal("states", "", ALL, "a state has a history, which kinematics does not compute: use `nivel run`"),
)
OF_INVERSE = (
    rolling("drive the wheels with `nivel run` and read the efforts of the drivers"),
    Refusal(
        "bodies",
        "flexible",
        attrgetter("flexible"),
        "the frame of a flexible body does not determine its motion: make the body rigid",
    ),
    Refusal("beams", "", ALL, "drivers do not determine the motion of a beam: leave the beam out"),
    ON_SOIL,
)
# Friction that holds at rest: which of the many equilibria it holds depends on how the machine came there.
MANY = "so there are many equilibria, and the actual one depends on the previous motion"
OF_STATICS = (
    ON_SOIL,
    Refusal(
        "forces",
        "model",
        lambda force: isinstance(force, Friction) and force.model != "coulomb",
        lambda force: (
            f"'{force.model}' holds at rest with any force up to static friction, {MANY}: leave the friction out, use coulomb, "
            f"which exerts no force at rest, or simulate with a damper until the machine rests"
        ),
    ),
    Refusal(
        "forces",
        "",
        holds_by_capacity,
        lambda force: (
            f"a {force.type} holds at rest with any effort up to its greatest one, {MANY}: leave it out, couple what it holds, or "
            f"simulate with a damper until the machine rests"
        ),
    ),
)
# States and blocks whose effect is no smooth function of the state.
NOT_SMOOTH = (
    ON_SOIL,
    Refusal(
        "forces",
        "friction",
        lambda force: isinstance(force, Contact) and force.sticks and force.friction_transition_speed is None,
        "friction of a contact that sticks has no derivative: give a `friction_transition_speed`, as in "
        "`friction_transition_speed: 1 cm/s`, and linear equations have the smooth law of this speed; or leave the friction out",
    ),
    Refusal(
        "states",
        "event",
        lambda state: state.event is not None,
        "a state that an event samples jumps at no given times, so that it has no linear equations: write it as a `rate`, or sample it "
        "with `every`",
    ),
    Refusal(
        "control",
        "type",
        lambda block: isinstance(block, UnitBlock),
        "code of another program has no derivative: leave out the block to open the loop, or write it with blocks of `control`",
    ),
)


def not_smooth(machine: MachineRecord, sliding: Collection[str] = (), *, may_slide: bool = False) -> Iterator[Fault]:
    """Forces, states and blocks whose effect is no smooth function of the state. sliding : names of forces that slide at the state, as all
    that have a place for it `may_slide`."""

    def sticks(force: ForceElement) -> bool:
        return isinstance(force, Friction) and force.model == "stiction" and force.name not in sliding and not may_slide

    def holds(force: ForceElement) -> bool:
        slides = force.name in sliding or (may_slide and not isinstance(force, TransmissionLoss))
        return holds_by_capacity(force) and not slides

    held = "has no derivative where it"
    leave = "leave it out, use a damper in the joint, or use `lugre`"
    rows = (
        Refusal("forces", "model", sticks, lambda force: f"'{force.model}' friction {held} sticks: {leave}"),
        Refusal(
            "forces", "", holds, lambda force: f"a {force.type} {held} holds: couple what it holds, or leave it out"
        ),
    )
    yield from faults_of(machine, (*rows, *NOT_SMOOTH))
    for each in parts_of(machine.control):
        if each.part.role in ("sample", "memory") and _reads_reports(each, machine):
            yield Fault.at(
                f"control.{each.block.name}{f'.{each.part.key}' if each.part.key else ''}",
                "a sample of what forces or flows report has no derivative here: read a pressure, a place or a speed, or leave out the "
                "block",
            )


def _reads_reports(each: PartOf, machine: MachineRecord) -> bool:
    """Whether a part reads what is known only when all forces and flows are."""
    own = {other.path for other in parts_of(machine.control)}
    symbols = [find_in(path, machine.index) for path in each.signals if path not in own]
    return any(is_output(symbol, machine.index) or follows_control(symbol, machine.index) for symbol in symbols)


def free_motions(machine: MachineRecord, prepared: Prepared) -> Iterator[Fault]:
    """Motions that are not driven, with coordinates to drive; or that are driven twice."""
    redundancy = prepared.redundancy
    driven = [name for name in redundancy.redundant_rows if name.endswith(".driver")]
    if driven:
        names = ", ".join(name.removesuffix(".driver") for name in driven)
        said = f"the drivers prescribe more motions than there are degrees of freedom: {names} follows from the others"
        yield Fault.at("drivers", f"{said}; leave one out")
        return
    count = redundancy.degrees_of_freedom
    if count == 0:
        return
    free = free_coordinates(machine, prepared)
    what = f"{count} motion{'s are' if count > 1 else ' is'} not driven"
    how = f"drive {' and '.join(free)}, by `drivers` in the file or `--drive`" if free else "add drivers"
    if free and len(free) < count:
        how += f"; {count - len(free)} of them no joint coordinate measures, e.g. the spin of a rod between two ball joints: hold it"
    yield Fault.at("machine", f"{what}, and kinematics needs all of them: {how}; or use `nivel run`")


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


def beside_states(machine: MachineRecord, settings: StaticsSettings) -> Iterator[Fault]:
    """What first-order states have no part in: paths by arc length, vibrations and buckling loads."""
    names = [state.name for state in machine.states if state.rate is not None or state.every is not None]
    names += [block.name for block in machine.control if any(part.role != "signal" for part in block.parts)]
    asked = {"arc_length": settings.arc_length, "modes": settings.modes, "buckling": settings.buckling}
    named = first_of(names, SHOWN)
    for name in (name for name, wanted in asked.items() if wanted and names):
        yield Fault.at(
            f"statics.{name}",
            f"`{name.replace('_', '-')}` knows positions alone, and this machine has first-order states ({named}): leave it out; "
            f"equilibria by load steps, and whether small motions about them grow, are found with the states",
        )


def at_rest(machine: MachineRecord) -> tuple[str, ...]:
    """Sentences on what makes no force at rest."""
    rubbing = [force for force in machine.forces if isinstance(force, Friction)]
    others = [force for force in machine.forces if not isinstance(force, Friction)]
    resting = {
        "dampers exert": [force for force in others if any(getattr(force, name, None) for name in DAMPING)],
        "coulomb friction depends on speed and exerts": rubbing,
        "friction of contacts exerts": [force for force in others if isinstance(force, Contact) and force.friction],
    }
    out = [
        f"{who} no force at rest ({first_of([force.name for force in forces], SHOWN)})"
        for who, forces in resting.items()
        if forces
    ]
    return (*out, *(["events are ignored"] if machine.events else []))


DAMPING = ("damping", "rotational_damping", "viscous")
SHOWN = 4
