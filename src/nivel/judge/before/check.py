"""Description of a machine before any run: degrees of freedom, redundancy, assembly, conventions."""

from collections.abc import Iterator

import numpy as np

from nivel.analysis.assembly.equations import equations
from nivel.analysis.assembly.named_freedoms import Freedom, named_freedoms
from nivel.analysis.assembly.unique_reactions import ReactionFacts, exact_joints, unique_reactions
from nivel.analysis.plan.beam_facts import BeamFacts, beam_facts
from nivel.analysis.plan.plan import Methods, Plan
from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.run.prepared_state import prepare
from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.errors import SolveError
from nivel.files.joint_parts import rotors_of
from nivel.judge.before import in_words
from nivel.kernels.core.status import OK
from nivel.lazy import Struct, nivel, replace
from nivel.machine.machine_record import MachineRecord
from nivel.system.flexible import bending_bodies
from nivel.system.states.relative import tree_of
from nivel.system.system import Array, System
from nivel.words.wording import set_in_motion

ROUND_OFF = 1e-14  # [m or rad] a smaller gap is none


class JointFacts(Struct):
    """One joint: kind, first and second body, point and z axis of the first marker (global, assembled), convention in words."""

    name: str
    type: str
    first: str
    second: str
    point: tuple[float, ...]
    axis: tuple[float, ...]
    free: int
    rows: tuple[str, ...]
    coordinates: tuple[tuple[str, float, str], ...]  # name, value, unit
    convention: str


class BodyFacts(Struct):
    """One body: mass [kg], principal inertias about the centre of mass [kg m²] (none of a point mass), assembled frame: position [m], turn;
    the modes of a flexible one in words.

    The turn from the global axes is an angle [rad] about a unit axis.
    """

    name: str
    mass: float
    principal_inertia: tuple[float, ...]
    position: tuple[float, ...]
    axis: tuple[float, ...]
    angle: float
    modes: str = ""


class Check(Struct):
    """A machine that was checked and assembled; `str` of it is what `nivel check` shows."""

    name: str
    gravity: tuple[float, ...]
    bodies: tuple[BodyFacts, ...]
    beams: tuple[BeamFacts, ...]
    joints: tuple[JointFacts, ...]
    couplings: tuple[str, ...]  # each in words, as drivers, forces, inputs, states, sensors and events
    drivers: tuple[str, ...]
    forces: tuple[str, ...]
    hydraulics: tuple[str, ...]
    pressures: dict[str, float]  # [Pa] of nodes of circuits at the start, by the name of their result variable
    inputs: tuple[str, ...]
    states: tuple[str, ...]
    control: tuple[str, ...]
    control_size: str  # how many blocks, states and sampled values, in words; empty without a control
    sensors: tuple[str, ...]
    events: tuple[str, ...]
    degrees_of_freedom: int
    position_freedoms: int  # more than those of velocities where wheels roll without slip
    freedoms: tuple[Freedom, ...]  # each in words; empty where they are not named
    exact: tuple[str, ...]  # changes of joints after which no constraint repeats another and every freedom stays
    modes: int  # of flexible bodies, whose coordinates are freedoms too
    constraint_rows: int
    redundant_rows: tuple[str, ...]
    non_unique_joints: tuple[str, ...]
    reactions: tuple[ReactionFacts, ...]  # which components of theirs are unique
    gap: float
    gap_row: str
    moved: tuple[tuple[str, float, float], ...]
    velocity_change: tuple[tuple[str, float, float], ...]
    followed: tuple[str, ...]  # of the bodies whose velocities were changed those for which none was given
    cut: tuple[str, ...]  # joints that stay constraints in relative coordinates
    settings: RunSettings
    reason: str  # for its integrator, where nobody asked for it
    # why no equilibrium was found to start from, and what to try: then it is shown as drawn
    unsettled: tuple[str, str] = ("", "")
    name_notes: tuple[str, ...] = ()  # on parameters that have the name of a unit or of a constant
    remarks: tuple[str, ...] = ()  # on values that are far from those of real machines

    def __repr__(self) -> str:
        extra = f", redundant: {', '.join(self.redundant_rows)}" if self.redundant_rows else ""
        return f"<Check {self.name}: {_freedoms(self)}{extra}>"

    def __str__(self) -> str:
        return "\n".join(_lines(self))


def _freedoms(facts: Check) -> str:
    count = facts.degrees_of_freedom
    modes = f", with {facts.modes} modes of flexible bodies" if facts.modes else ""
    more = f", {facts.position_freedoms} of positions" if facts.position_freedoms != count else ""
    return f"{count} degree{'' if count == 1 else 's'} of freedom{more}{modes}"


def _lines(facts: Check) -> Iterator[str]:
    """The facts in words, for people."""
    yield f"{facts.name}: {_freedoms(facts)}, gravity {_vector(facts.gravity)} m/s²"
    yield from (f"note: {note}" for note in (*facts.name_notes, *facts.remarks))
    if facts.bodies:
        yield "bodies"
    for body in facts.bodies:
        moments = body.principal_inertia
        inertia = f"principal inertia {_vector(moments, 4)} kg m²" if moments else "a point mass"
        turned = f", turned {np.degrees(body.angle):.4g} deg about {_vector(body.axis)}" if body.angle > 1e-12 else ""
        place = f"frame at {_vector(body.position)} m{turned}"
        bends = f", flexible: {body.modes}" if body.modes else ""
        yield f"  {body.name}: {body.mass:.4g} kg, {inertia}, {place}{bends}"
    if facts.beams:
        yield "beams"
    for beam in facts.beams:
        yield from _beam_lines(beam)
    if facts.joints:
        yield "joints (first body → second body)"
    for joint in facts.joints:
        axis = "" if JOINTS[joint.type].is_ball else f", z axis {_vector(joint.axis)}"
        place = f"at {_vector(joint.point)} m{axis}"
        yield f"  {joint.name}: {joint.type}, {joint.first} → {joint.second}, free motions {joint.free}, {place}"
        for name, value, units in joint.coordinates:
            degrees = f" ({round(np.degrees(value), 9) + 0.0:.4g} deg)" if units == "rad" else ""
            yield f"    {name} = {round(value, 12) + 0.0:.6g} {units}{degrees}"
    for kind, convention in {joint.type: joint.convention for joint in facts.joints if joint.coordinates}.items():
        yield f"  {kind}: {convention}"
    for title in ("couplings", "drivers", "forces", "hydraulics", "inputs", "states", "control", "sensors", "events"):
        elements: tuple[str, ...] = getattr(facts, title)
        if elements:
            yield f"{title}: {facts.control_size}" if title == "control" else title
        yield from (f"  {words}" for words in elements)
    if facts.freedoms:
        yield "degrees of freedom, in this position"
    for freedom in facts.freedoms:
        several = f" ({freedom.count} degrees of freedom)" if freedom.count > 1 else ""
        remedy = f"; to stop that, {freedom.remedy}" if freedom.remedy else ""
        yield f"  {freedom.words}{several}{remedy}"
    yield from _assembly_lines(facts)
    yield from _redundancy_lines(facts)
    cut = f", loops are closed at {', '.join(facts.cut)}" if facts.cut else ", a tree, no joint is a constraint"
    yield f"coordinates: {facts.settings.coordinates}{cut if facts.settings.coordinates == 'relative' else ''}"
    if facts.reason:
        yield f"method: {facts.settings.integrator}, because {facts.reason}"


def _beam_lines(beam: BeamFacts) -> Iterator[str]:
    orders = {1: "", 2: "quadratic ", 3: "cubic "}
    place = f"{beam.length:.6g} m long, from {_vector(beam.start)} to {_vector(beam.end)} m"
    segments, kind = beam.model == "segments", f"{beam.model} " if beam.model.startswith("ancf") else orders[beam.order]
    parts = f"{beam.nodes} rigid segments" if segments else f"{beam.elements} {kind}elements, {beam.nodes} nodes"
    yield f"  {beam.name}: {beam.mass:.4g} kg, {place}, {parts}"
    yield f"    stations {', '.join(beam.stations)}"
    slow, fast = _frequency(beam.first_bending), _frequency(beam.fastest)
    yield f"    vibrates from about {slow} (bending, both ends free) to {fast} (a single {'spring' if segments else 'element'}), unstressed"


def _frequency(value: float) -> str:
    factor, unit = next((each for each in ((1e6, "MHz"), (1e3, "kHz")) if value >= each[0]), (1.0, "Hz"))
    return f"{value / factor:.3g} {unit}"


def _assembly_lines(facts: Check) -> Iterator[str]:
    if facts.moved and facts.gap > ROUND_OFF:
        yield f"assembly: as given, {facts.gap_row} is open by {facts.gap:.3g}; closed by moving"
    else:
        yield f"assembly: closed as given{'; the start values of joints move' if facts.moved else ''}"
    for name, distance, angle in _by_owner(facts, facts.moved):
        yield f"  {name} by {distance:.3g} m and {np.degrees(angle):.3g} deg"
    changed = tuple(each for each in facts.velocity_change if each[0] not in facts.followed)
    for name, speed, rate in _by_owner(facts, changed):
        yield f"  velocity of {name} changed by {speed:.3g} m/s and {rate:.3g} rad/s to fit the joints"
    if facts.followed:
        yield f"  {set_in_motion(facts.followed)}"


def _by_owner(facts: Check, changes: tuple[tuple[str, float, float], ...]) -> Iterator[tuple[str, float, float]]:
    """Changes of bodies; of the nodes of a beam the largest ones, once."""
    yield from (change for change in changes if "." not in change[0])
    for beam in facts.beams:
        own = [change for change in changes if change[0].startswith(f"{beam.name}.")]
        if len(own) > 1:
            yield f"the nodes of {beam.name}", max(each[1] for each in own), max(each[2] for each in own)
        else:
            yield from own


def _redundancy_lines(facts: Check) -> Iterator[str]:
    if not facts.redundant_rows:
        yield f"constraints: {facts.constraint_rows} rows, no redundant constraints, every reaction is unique"
        return
    yield f"constraints: {facts.constraint_rows} rows, redundant: {', '.join(facts.redundant_rows)}"
    yield f"  the motion does not depend on them; reactions are not unique in: {', '.join(facts.non_unique_joints)}"
    if facts.reactions:
        yield "  on their first bodies, along the axes of their first markers; ranges at the start: as one or another row is left out"
        yield from (f"    {each}" for each in facts.reactions)
    if facts.exact:
        yield f"  exactly constrained, with the same degrees of freedom: {'; '.join(facts.exact)}"


def _vector(values: tuple[float, ...], digits: int = 6) -> str:
    """Components; those at round-off of the largest are shown as 0."""
    largest = max(abs(value) for value in values)
    return "(" + ", ".join(f"{value if abs(value) > 1e-12 * largest else 0.0:.{digits}g}" for value in values) + ")"


def check(plan: Plan) -> Check:
    """Assemble the machine of a plan. Raises ModelError with what is wrong."""
    prepared, unsettled = _prepared(plan.methods)
    own, machine, settings = plan.machine, plan.methods.machine, plan.settings
    system = prepared.absolute.system
    record, redundancy, assembly = system.record, prepared.redundancy, prepared.assembly
    status, _ = prepared.absolute.evaluate(0.0, assembly.y)
    frame = np.zeros(system.layout.width)
    nivel.kernels.output.observe.observe(prepared.absolute.handle.address, 0.0, assembly.y, frame)
    columns = next(v.columns for v in system.layout.variables if v.name == "joint_coordinate")
    reactions = unique_reactions(prepared.absolute, loaded=status == OK) if redundancy.redundant_rows else ()
    modes, rotors = _modes(machine), rotors_of(machine)
    gears = {
        coupling: f"rotor of inertia {record.bodies.inertia_b[system.bodies.index(rotor), 0, 0]:.4g} (SI) that turns with {coordinate}"
        for rotor, (coupling, coordinate) in rotors.items()
    }
    measured = equations(machine, measured=True)
    measured.evaluate(0.0, assembly.y)
    labels = system.layout.coordinates["joint_coordinate"]
    values = dict(zip(labels, zip(frame[columns].tolist(), system.coordinate_units, strict=True), strict=True))
    return Check(
        name=machine.name,
        gravity=tuple(machine.gravity),
        bodies=tuple(
            BodyFacts(
                name,
                float(record.bodies.mass[k]),
                () if system.point_masses[k] else tuple(np.linalg.eigvalsh(record.bodies.inertia_b[k]).tolist()),
                tuple(record.bodies.R[k].tolist()),
                *_turn(record.bodies.theta[k]),
                modes[k],
            )
            for k, name in enumerate(system.bodies)
            if name in own.body_named and name not in rotors
        ),
        beams=tuple(beam_facts(beam) for beam in own.beams),
        joints=tuple(
            _joint(system, k, joint, values) for k, joint in enumerate(machine.joints) if joint.name not in rotors
        ),
        couplings=tuple(
            gears.get(coupling.name) or in_words.coupling_in_words(machine, coupling) for coupling in machine.couplings
        ),
        drivers=tuple(in_words.driver_in_words(driver) for driver in machine.drivers),
        forces=tuple(in_words.force_in_words(machine, force) for force in machine.forces),
        hydraulics=_hydraulics(machine, system),
        pressures={node.variable: float(record.circuit.pressure[k]) for k, node in enumerate(system.nodes)},
        inputs=tuple(in_words.input_in_words(each) for each in machine.inputs),
        states=tuple(in_words.state_in_words(state) for state in machine.states),
        control=tuple(in_words.block_in_words(block) for block in machine.control),
        control_size=in_words.control_in_words(machine.control) if machine.control else "",
        sensors=tuple(in_words.sensor_in_words(sensor) for sensor in machine.sensors),
        events=tuple(in_words.event_in_words(event) for event in machine.events),
        degrees_of_freedom=redundancy.degrees_of_freedom,
        position_freedoms=redundancy.position_freedoms,
        freedoms=named_freedoms(machine, measured),
        exact=exact_joints(machine, measured, redundancy.non_unique_joints) if redundancy.redundant_rows else (),
        modes=len(prepared.motion.system.modes),
        constraint_rows=system.machine_rows,
        redundant_rows=redundancy.redundant_rows,
        non_unique_joints=redundancy.non_unique_joints,
        reactions=reactions,
        gap=assembly.gap,
        gap_row=assembly.gap_row,
        moved=assembly.moved,
        velocity_change=assembly.velocity_change,
        followed=assembly.followed,
        cut=_cut(plan.methods) if settings.coordinates == "relative" else (),
        settings=settings,
        reason=plan.reason,
        unsettled=unsettled,
    )


def _prepared(methods: Methods) -> tuple[Prepared, tuple[str, str]]:
    """The machine ready to run: as drawn where no equilibrium is found to start from, and then why and what to try."""
    try:
        return prepare(methods), ("", "")
    except SolveError as error:
        machine = methods.machine
        if machine.simulation.start != "equilibrium":
            raise
        drawn = machine.replace(simulation=machine.simulation.replace(start="as-given"))
        return prepare(replace(methods, machine=drawn)), (error.message, error.advice)


def _hydraulics(machine: MachineRecord, system: System) -> tuple[str, ...]:
    """Components in words, pressures at the start, and how many states there are."""
    if not machine.hydraulics:
        return ()
    record = system.record
    pressures = [f"{node.name} {record.circuit.pressure[k] / 1e5:.4g} bar" for k, node in enumerate(system.nodes)]
    names = {component.name for component in machine.hydraulics}
    count = sum(not fact.integral and fact.name.partition(".")[0] in names for fact in system.states)
    return (
        *(in_words.component_in_words(component) for component in machine.hydraulics),
        f"start: {', '.join(pressures)}",
        f"{count} state{'s' * (count != 1)} of components",
        *_without_slopes(machine),
    )


def _without_slopes(machine: MachineRecord) -> Iterator[str]:
    """What it costs that derivatives of some components are not known by hand."""
    if without := nivel.system.circuit_elements.without_slopes(machine):
        names = ", ".join(f"{each.name} ({each.type})" for each in without)
        has = "has" if len(without) == 1 else "have"
        yield (
            f"{names} {has} no derivatives by hand: with `extrapolated-euler` every step computes those of the whole machine, which "
            "takes longer for large machines; other integrators take as long as without"
        )


def _cut(methods: Methods) -> tuple[str, ...]:
    """Joints that stay constraints in relative coordinates; those that constrain nothing are none."""
    cut = [methods.machine.joints[k] for k in tree_of(methods.machine, methods.cut).cut]
    return tuple(joint.name for joint in cut if JOINTS[joint.type].of(joint).rows)


def _modes(machine: MachineRecord) -> list[str]:
    """The modes of each body in words, empty where it is rigid."""
    out = [""] * len(machine.bodies)
    for each in bending_bodies(machine):
        if each.beam:
            continue
        frequencies = each.reduced.frequencies
        span = f"{frequencies.min():.4g} to {frequencies.max():.4g} Hz" if len(frequencies) else "rigid"
        without = f", without {' and '.join(each.neglected)}" if each.neglected else ""
        out[each.body] = f"{len(frequencies)} modes, {span}{without}"
    return out


def _turn(theta: Array) -> tuple[tuple[float, ...], float]:
    """Axis and angle [0, π] of Euler parameters (4,)."""
    theta = theta if theta[0] >= 0.0 else -theta
    sine = float(np.linalg.norm(theta[1:]))
    axis = theta[1:] / sine if sine > 0.0 else np.array([0.0, 0.0, 1.0])
    return tuple(axis.tolist()), 2.0 * float(np.arctan2(sine, theta[0]))


def _joint(system: System, k: int, joint: Joint, values: dict[str, tuple[float, str]]) -> JointFacts:
    record, name, kind, made = system.record, joint.name, joint.type, JOINTS[joint.type].of(joint)
    first = int(record.joints.first_marker[k])
    bodies = [*system.bodies, "ground"]
    second = bodies[int(record.markers.body[first + 1])]
    if JOINTS[kind].rail:
        second = second.rpartition(".")[0]  # the beam, not a node of it
    return JointFacts(
        name=name,
        type=kind,
        first=bodies[int(record.markers.body[first])],
        second=second,
        point=tuple(record.markers.r[first].tolist()),
        axis=tuple(record.markers.A[first, :, 2].tolist()),
        free=made.free,
        rows=tuple(f"{name}.{row}" for row in made.rows),
        coordinates=tuple((label, *values[label]) for label in values if label.startswith(f"{name}.")),
        convention=made.convention,
    )
