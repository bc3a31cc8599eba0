"""Choice of the integrator and of the coordinates of a run that leaves them to nivel.

Steps are chosen by their error. `dopri5` begins; where stability bounds its steps, `radau` goes on from that time. Friction that sticks
has `radau` from the start, circuits have `extrapolated-euler`, beams `generalised-alpha`, tyres `rk4` with its fixed step.

For `coordinates: auto` the ones are taken in which an evaluation of the equations costs least. Joints named in `cut` are a wish about
relative coordinates: where these are possible, they are taken. Velocities named in `independent` are one about independent coordinates.

Counted are, in relative coordinates, the bodies of the tree and the rows that are left with the joint velocities on their way to the
ground; in absolute ones the rows with the bodies that they touch; and in both the entries of S. Weights are nanoseconds, fitted to
measured evaluations of the slider-crank, chains and pairs of bodies (`benchmarks/profile_step.py`).
"""

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping
from math import ceil, pi
from typing import Any, cast

import numpy as np

from nivel.analysis.plan.beam_facts import ON_GROUND, goes_by_circuits, only_modes_are_stiff
from nivel.analysis.plan.settings import FRAMES
from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.integrate.catalogue import INTEGRATORS, step_for
from nivel.known import Contact, Contacts, Friction, Stop
from nivel.lazy import nivel
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.machine.uses.coordinate_reference import resolve
from nivel.methods import chooses


def screws_as_couplings(machine: MachineRecord, names: Collection[str]) -> Iterator[tuple[str, str]]:
    """Name of each of these screw joints that can be written as a coupling, and the lines of the machine file for it."""
    for joint in machine.joints:
        if joint.type == "screw" and joint.name in names:
            line = _coupling(machine, joint)
            if line:
                yield joint.name, line


def _coupling(machine: MachineRecord, screw: Joint) -> str:
    """a·r d + (p/2π) a·v φ = 0 of the screw's axis a, the rail's r and the bearing's v, each of which carries its second body."""
    if screw.bodies is None or screw.axis is None:
        return ""
    for shaft, moved in (screw.bodies, screw.bodies[::-1]):
        bearing, rail = _carrying(machine, shaft, "revolute"), _carrying(machine, moved, "translational")
        if bearing is None or rail is None:
            continue
        a, v, r = (np.array(joint.axis, dtype=float) for joint in (screw, bearing, rail))
        a, v, r = a / np.linalg.norm(a), v / np.linalg.norm(v), r / np.linalg.norm(r)
        sides = [1.0 if joint.bodies[1] == body else -1.0 for joint, body in ((bearing, shaft), (rail, moved))]  # type: ignore[index]
        factor = (screw.pitch or 0.0) / (2.0 * pi) * round(float(a @ v)) * round(float(a @ r)) * sides[0] * sides[1]
        coordinates = f"[{rail.name}.displacement, {bearing.name}.angle]"
        return f"{screw.name}: {{type: linear, coordinates: {coordinates}, factors: [1, {factor:.12g}]}}"
    return ""


def _carrying(machine: MachineRecord, body: str, kind: str) -> Joint | None:
    """The joint of a type on a body, if it is placed by an axis."""
    found = [each for each in machine.joints if each.type == kind and each.axis and body in (each.bodies or ())]
    return found[0] if len(found) == 1 else None


# relative: a body, a row, a row and a joint velocity, an entry of S; absolute: a body, a row and a body, an entry of S
TREE_BODY, TREE_ROW, TREE_BLOCK, TREE_ENTRY = 110.0, 40.0, 12.0, 2.0
BODY, BLOCK, ENTRY = 60.0, 15.0, 4.0
# Tangents in relative coordinates are full matrices: of more bodies than this the sparse ones of absolute coordinates are faster.
MOST_DENSE = 60
# What goes on where stability bounds the steps of an explicit method, and the tolerance of a run that names neither.
FOR_STIFF, USUAL_TOLERANCE = "radau", 1e-8
# why a run has its integrator
EXPLICIT = f"no method is named; where it is stiff, {FOR_STIFF} goes on"
STICKING = "friction that sticks is stiff"
STIFF_CIRCUITS = "circuits are stiff, and every step of it costs the same"
GASES = "gas flows at the speed of sound, and stops, within the shortest of fixed steps"
TYRES = "tyres and soil are soft beside a step, and slide and stand without a switch"
STIFF_BEAMS = "beams have rates beyond all steps"
EXPLICIT_BEAMS = "other settings need an explicit method"
TOLERANT = "`tolerance` needs a method that chooses its steps"
FIXED = "other settings depend on a fixed step"


def names_no_integrator(machine: MachineRecord) -> bool:
    """Whether its settings leave the integrator, and how it chooses steps, to nivel."""
    return "integrator" not in machine.simulation.model_fields_set and machine.simulation.step_control == "own"


def integrators_for(machine: MachineRecord) -> tuple[tuple[str, str], ...]:
    """(integrator, why it is taken) for a machine that names none: the first one goes that its other settings allow."""
    if any(fluid.type == "ideal-gas" for fluid in machine.fluids):
        return ((FOR_STIFF, GASES), ("extrapolated-euler", STIFF_CIRCUITS))
    if machine.hydraulics:
        return (("extrapolated-euler", STIFF_CIRCUITS), (FOR_STIFF, TOLERANT))
    if machine.beams:
        impacts = any(isinstance(force, Contact | Contacts | Stop) for force in machine.forces)
        names = (FOR_STIFF, "bdf", "generalised-alpha") if impacts else ("generalised-alpha", FOR_STIFF, "bdf")
        return (*((name, STIFF_BEAMS) for name in names), ("dopri5", EXPLICIT_BEAMS), ("rk4", FIXED))
    if any(force.type in ON_GROUND for force in machine.forces):
        return (("rk4", TYRES), (FOR_STIFF, TOLERANT))
    if any(force.sticks for force in machine.forces):
        return ((FOR_STIFF, STICKING), ("dopri5", STICKING), ("rk4", FIXED))
    return (("dopri5", EXPLICIT), ("rk4", FIXED))


def with_integrator(machine: MachineRecord, name: str, **changes: float) -> MachineRecord:
    """The machine with this integrator and other changes of its settings; with usual ones where it names no tolerance and no step."""
    settings = machine.simulation
    own = {} if "tolerance" in settings.model_fields_set else {"tolerance": USUAL_TOLERANCE}
    if "step" not in settings.model_fields_set and not INTEGRATORS[name].chooses_steps:
        own["step"] = _dividing(_usual_step(machine), settings.output_interval)
    return machine.with_simulation(settings.replace(integrator=name, **{**own, **changes}))


def _usual_step(machine: MachineRecord) -> float:
    """Of fixed length, at first: of beams, whose steps are dear, a thousandth of a long run; that of samples of waves in lines."""
    settings, waves = machine.simulation, [cast(Any, each) for each in machine.hydraulics if each.type == "line"]
    step = max(settings.step, settings.duration / FRAMES) if machine.beams else settings.step
    return min([step, *(each.sample_time for each in waves if each.model == "delay")])


def with_scales(machine: MachineRecord, scales: Mapping[str, float]) -> MachineRecord:
    """The machine whose states and control blocks of these names have these scales."""

    def scaled(records: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(each.replace(scale=scales[each.name]) if each.name in scales else each for each in records)

    return machine.replace(states=scaled(machine.states), control=scaled(machine.control))


def with_dividing_step(machine: MachineRecord) -> MachineRecord:
    """The machine whose fixed steps, where `step` is not given, divide `output_interval`."""
    settings, interval = machine.simulation, machine.simulation.output_interval
    is_chosen = chooses(settings.integrator, settings.step_control)
    if interval is None or is_chosen or "step" in settings.model_fields_set:
        return machine
    return machine.with_simulation(settings.replace(step=_dividing(settings.step, interval)))


def _dividing(step: float, interval: float | None) -> float:
    """The longest step [s] up to this one that divides an output interval, where there is one."""
    return step if interval is None else interval / ceil(interval / step * (1.0 - 1e-9))


def choose_coordinates(machine: MachineRecord) -> str:
    """The coordinates of a run of `machine`: its own; for `auto` relative where joints are named in `cut`, independent
    where velocities are named in `independent`, else the ones that cost least, of those that its formulation knows.
    """
    machine = nivel.system.beam_nodes.with_nodes(machine)
    settings = machine.simulation
    if settings.coordinates != "auto":
        return settings.coordinates
    if settings.independent:
        return "independent"
    if settings.formulation == "lagrange" or not machine.joints:
        return "absolute"
    if settings.cut:
        return "relative"
    facts = INTEGRATORS[settings.integrator]
    if step_for(settings.integrator, "circuits") and goes_by_circuits(machine, "relative"):
        # there derivatives are found by hand
        return "relative"
    if machine.is_flexible:
        # there ROS2 needs no matrix of all modes
        return "relative" if step_for(settings.integrator, "modes") and only_modes_are_stiff(machine) else "absolute"
    if facts.needs == "whole steps" or (facts.residual and len(machine.bodies) > MOST_DENSE):
        return "absolute"
    if not (facts.residual or machine.shares_mass) and slides(machine, "relative", settings.formulation):
        # accelerations by the residual, which explicit methods need for nothing else, cost three times as much or more
        return "absolute"
    return "relative" if _relative_cost(machine) < _absolute_cost(machine) else "absolute"


def choose_cut(machine: MachineRecord) -> SimulationSettings:
    """Settings of a run of `machine` in relative coordinates, with the joints that are cut.

    Methods of the rates cut where it leaves the fewest rows. Those that solve for multipliers at the ends of a step err by what the
    reactions of cut joints do in between: they cut at the lightest bodies (20 times less energy error on the spatial slider-crank).
    """
    settings, facts = machine.simulation, INTEGRATORS[machine.simulation.integrator]
    frictions = [force for force in machine.forces if isinstance(force, Friction) or force.sticks]
    if frictions and (not facts.residual or any(force.sticks for force in frictions)):
        # friction needs forces that explicit methods, and with stiction all, know one by one, and bodies carried by beams have none
        sliders = (joint.name for joint in machine.joints if JOINTS[joint.type].rail)
        settings = settings.replace(cut=tuple(dict.fromkeys((*settings.cut, *sliders))))
    if machine.simulation.cut or not facts.residual or facts.first_order:
        return settings
    tree = nivel.system.states.relative.tree_of(machine, settings, heavy_first=True)
    return settings.replace(cut=tuple(machine.joints[k].name for k in tree.cut))


def slides(machine: MachineRecord, coordinates: str, formulation: str, cut: SimulationSettings | None = None) -> bool:
    """Whether with these methods a beam carries a body that slides along it. cut : as `choose_cut` has it, where it is known."""
    if coordinates != "relative" or not any(JOINTS[joint.type].rail for joint in machine.joints):
        return False
    machine = nivel.system.beam_nodes.with_nodes(machine)
    return nivel.system.states.relative.has_sliders(
        machine, (cut or choose_cut(machine)).replace(formulation=formulation)
    )


def _rows(machine: MachineRecord) -> list[tuple[str, int, set[str]]]:
    """Owner, number of rows and bodies of every joint, coupling and driver."""
    bodies = {joint.name: set(nivel.system.states.relative.bodies_of(machine, joint)) for joint in machine.joints}
    rows = [
        (joint.name, len(nivel.elements.joints.JOINTS[joint.type].of(joint).rows), bodies[joint.name])
        for joint in machine.joints
    ]
    for coupling in machine.couplings:
        terms = zip(coupling.terms, coupling.kinds, strict=True)
        named = [resolve(reference, machine.joints, kind)[0] for (reference, _), kind in terms]
        rows.append((coupling.name, 1, set().union(*(bodies[name] for name in named))))
    for driver in machine.drivers:
        touched: set[str] = set()
        if driver.coordinate is not None:
            touched = bodies[resolve(driver.coordinate, machine.joints)[0]]
        rows.append((driver.name, driver.row_count, touched))
    return [(owner, count, touched - {"ground"}) for owner, count, touched in rows]


def _entries(places: Iterable[tuple[int, Iterable[object]]]) -> int:
    """Entries of S: pairs of rows that share a place."""
    shared: Counter[object] = Counter()
    for count, where in places:
        for place in where:
            shared[place] += count
    return sum(count * (count + 1) // 2 for count in shared.values())


def _absolute_cost(machine: MachineRecord) -> float:
    rows = _rows(machine)
    blocks = sum(count * len(touched) for _, count, touched in rows)
    entries = _entries((count, touched) for _, count, touched in rows)
    return BODY * len(machine.bodies) + BLOCK * blocks + ENTRY * entries


def _relative_cost(machine: MachineRecord) -> float:
    tree = nivel.system.states.relative.tree_of(machine, machine.simulation)
    number = {body.name: k for k, body in enumerate(machine.bodies)}
    branch_of = {branch.child: branch for branch in tree.branches}
    carried = {
        machine.joints[branch.joint].name
        for branch in tree.branches
        if branch.joint != nivel.system.elimination.topology.FREE
    }
    cost, left = TREE_BODY * len(machine.bodies), []
    for owner, count, touched in _rows(machine):
        if owner in carried:
            continue
        columns: set[tuple[int, int]] = set()
        for name in touched:
            at = number[name]
            while at in branch_of and (at, 0) not in columns:
                branch = branch_of[at]
                kind = (
                    "free"
                    if branch.joint == nivel.system.elimination.topology.FREE
                    else machine.joints[branch.joint].type
                )
                columns |= {(at, k) for k in range(nivel.system.states.tree_nodes.tree_joint(kind).velocities)}
                at = branch.parent
        cost += count * (TREE_ROW + TREE_BLOCK * len(columns))
        left.append((count, columns))
    return cost + TREE_ENTRY * _entries(left)
