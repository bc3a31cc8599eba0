"""The method of a machine that is moved in steps of one length and names none, by its fastest rate: live, stepped, in C libraries and FMUs.

The default is explicit, which costs least. It is left where a step turns the fastest rate by more than it follows: rates at the start are
eigenvalues of the equations there (`nivel.judge.during.growth`); those of contacts and end stops that may touch later follow from
their stiffness and the masses beside them, those of beams from their elements, those of slack ropes from the same machine with taut ones.
What comes in its place is implicit, with steps of one length and one cost.
"""

from collections.abc import Iterable, Iterator
from math import sqrt

import numpy as np

from nivel.analysis.plan.beam_facts import fastest_frequency
from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan, plan_run
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.prepared_state import prepare
from nivel.elements.contacts.contact import Contact, Contacts
from nivel.elements.contacts.heap import spheres_between
from nivel.elements.contacts.pairs import tangent_stiffness
from nivel.elements.forces.actuators import Stop
from nivel.elements.forces.ropes import Rope, length_of
from nivel.elements.forces.shafts import BeltDrive, Shaft
from nivel.errors import ModelError, SolveError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.judge.during.growth import Fastest, fastest
from nivel.lazy import Struct, replace
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, resolve
from nivel.system.joint_frames import as_placed
from nivel.system.states.relative import bodies_of
from nivel.system.system import Array

# The largest rate times step that an explicit method of order four follows to some digits; of impacts, which last for half a turn: thirty
# steps in each.
FOLLOWED, IN_IMPACTS = 1.0, np.pi / 30.0
# A step that is longer than its bound by less than this follows as well; in words both would be the same.
NEARLY = 1.001
# Turns of a body in a step [rad] beyond which forces that depend on its angle are not resolved.
TURNED = 3.0
# The length of a slack rope as a share of its way, when it is taken as taut.
TAUT = 0.999
IMPLICIT = "ros2"
# loads at which the stiffness of a contact is taken, as multiples of the weight
HIT = 10.0
STANDARD_GRAVITY = 9.81
NONE_GOES = "no implicit method goes with its other settings"


class Rate(Struct):
    """The fastest rate [1/s] of something, the step [s] with which an explicit method follows it, and what it is of, in words."""

    rate: float
    followed: float
    what: str


def fitted(plan: Plan, prepared: Prepared, listener: Listener | None = None) -> tuple[Plan, Prepared]:
    """The plan and its machine made ready, with another integrator where none was asked for and its own misses the fastest rate.

    The plan says in `reason` why it has its integrator. Raises SolveError as preparing does.
    """
    if not plan.is_open or plan.machine.hydraulics:
        return plan, prepared
    found = fastest_rate(plan, prepared, prepared.start, 0.0)
    if found is None or plan.settings.step <= NEARLY * found.followed:
        return replace(plan, reason=_explicit(plan, found)), prepared
    machine, reason = plan.machine, _implicit(plan, found)
    try:
        new = plan_run(machine.with_simulation(machine.simulation.replace(integrator=IMPLICIT)))
        build(run_entries(new), listener)
        return replace(new, reason=reason), prepare(new.methods)
    except ModelError:
        return replace(plan, reason=f"{reason}; {NONE_GOES}"), prepared


def _explicit(plan: Plan, found: Rate | None) -> str:
    if found is None:
        return "the machine has no rates that could be found, and names no integrator"
    return f"nothing is faster than {found.rate:.2g}/s ({found.what}), which steps of {plan.settings.step:.3g} s follow"


def _implicit(plan: Plan, found: Rate) -> str:
    name, step = plan.settings.integrator, plan.settings.step
    digits = next((n for n in (2, 3, 4) if float(f"{found.followed:.{n}g}") < step), 5)
    too_fast = f"steps of {name} would have to be below {found.followed:.{digits}g} s, not {step:.3g} s"
    return f"{found.what} has a rate of {found.rate:.2g}/s, for which {too_fast}"


def fastest_rate(plan: Plan, prepared: Prepared, y: Array, t: float) -> Rate | None:
    """That which needs the shortest steps, in the state y at time t [s] or, of what may touch, ever; None where nothing is known."""
    rates = [*_of_contacts(plan.machine), *_of_play(plan.machine), *_of_beams(plan.machine)]
    now = _at(prepared, y, t)
    if now is not None:
        rates.append(Rate(now.rate, FOLLOWED / now.rate, now.part or "the motion"))
    rates += [each for each in (_of_turning(prepared, y, t), _of_slack_ropes(plan.machine)) if each is not None]
    return min(rates, key=lambda each: each.followed, default=None)


def _at(prepared: Prepared, y: Array, t: float) -> Fastest | None:
    """The fastest rate in a state, without the feedback of constraints, which is as fast as the step."""
    feedback = prepared.motion.system.record.control.stabilise
    kept = feedback.copy()
    feedback[:2] = 0.0
    found = fastest(prepared.motion, t, y)
    feedback[:] = kept
    return found


def _of_contacts(machine: MachineRecord) -> Iterator[Rate]:
    """Of contacts hit by some times the weight of what touches, of their friction near rest, and of end stops."""
    gravity = float(np.linalg.norm(machine.gravity)) or STANDARD_GRAVITY
    for each in machine.forces:
        if not isinstance(each, Contact | Contacts | Stop):
            continue
        kind = "end stop" if isinstance(each, Stop) else "contact"
        mass = _mass_at(machine, each)
        stiffness = tangent_stiffness(machine, each, HIT * mass * gravity)
        if stiffness is not None and stiffness > 0.0:
            rate = sqrt(stiffness / mass)
            yield Rate(rate, IN_IMPACTS / rate, f"the {kind} {each.name}")
        if not isinstance(each, Stop) and each.friction > 0.0 and each.friction_transition_speed is not None:
            rate = each.friction * gravity / each.friction_transition_speed
            yield Rate(rate, INTEGRATORS["rk4"].held / rate, f"the friction of the contact {each.name}")


def _mass_at(machine: MachineRecord, force: Contact | Contacts | Stop) -> float:
    """What two bodies that touch move against each other, the ground being at rest: the mass 1/Σ 1/m, of angles the like of moments of
    inertia, at least [kg or kg m²]."""
    if isinstance(force, Contacts):
        lightest = sorted(
            spheres_between(machine, force), key=lambda name: mass_properties(machine.body_named[name]).mass
        )
        return _mass(machine, lightest[:2], turns=False)
    if isinstance(force, Stop):
        return _mass_of(machine, force.coordinate)
    return _mass(machine, [machine.touching[name].body for name in force.bodies or (str(force.body),)], turns=False)


def _mass_of(machine: MachineRecord, reference: str) -> float:
    """The same of the bodies of a joint coordinate."""
    joint, coordinate = resolve(reference, machine.joints)
    names = bodies_of(machine, next(each for each in machine.joints if each.name == joint))
    return _mass(machine, names, turns=COORDINATE_KINDS[coordinate] == "angle")


def _mass(machine: MachineRecord, names: Iterable[str | None], *, turns: bool) -> float:
    bodies = [machine.body_named[name] for name in names if name is not None and name in machine.body_named]
    its = [mass_properties(body) for body in bodies]
    parts = [float(np.linalg.eigvalsh(each.inertia)[-1]) if turns else each.mass for each in its]
    return 1.0 / sum(1.0 / part for part in parts if part > 0.0) if any(part > 0.0 for part in parts) else np.inf


def _of_play(machine: MachineRecord) -> Iterator[Rate]:
    """Of shafts with play and chains with slack, which may be apart at the time: springs between two coordinates."""
    for each in machine.forces:
        if isinstance(each, Shaft) and each.backlash and each.against is not None:
            factors = (1.0, each.ratio)
        elif isinstance(each, BeltDrive) and each.slack:
            factors = each.radii
        else:
            continue
        coordinates = (each.coordinate, str(each.against))
        moved = sum(factor**2 / _mass_of(machine, one) for factor, one in zip(factors, coordinates, strict=True))
        rate = sqrt(each.stiffness * moved)
        if rate > 0.0:
            yield Rate(rate, IN_IMPACTS / rate, f"the {each.type} {each.name}")


def _of_turning(prepared: Prepared, y: Array, t: float) -> Rate | None:
    """Of the body that turns fastest."""
    system = prepared.motion.system
    count = system.body_count
    if not count or not np.isfinite(y).all():
        return None
    prepared.motion.evaluate(t, y)
    speeds = np.linalg.norm(np.real(system.record.bodies.omega[:count]), axis=1)
    if not np.isfinite(speeds).all() or not speeds.max() > 0.0:
        return None
    fastest_body = int(np.argmax(speeds))
    rate = float(speeds[fastest_body])
    return Rate(rate, TURNED / rate, f"the turning of {system.bodies[fastest_body]}")


def _of_slack_ropes(machine: MachineRecord) -> Rate | None:
    """Of ropes that are slack as placed, or just not: they are as stiff as others when they become taut."""
    ropes = [each for each in machine.forces if isinstance(each, Rope)]
    ways = {each.name: length_of(each, [as_placed(machine, end) for end in each.ends]) for each in ropes}
    slack = {
        each.name: (each.length or ways[each.name]) > ways[each.name]
        for each in ropes
        if each.stiffness and (each.length or ways[each.name]) >= ways[each.name]
    }
    if not slack:
        return None
    forces = [each.replace(length=TAUT * ways[each.name]) if each.name in slack else each for each in machine.forces]
    try:
        simulation = machine.simulation.replace(start="as-given")
        taut = plan_run(machine.replace(forces=tuple(forces), simulation=simulation), stepwise=True)
        its = prepare(taut.methods)
    except (ModelError, SolveError):
        return None
    found = _at(its, its.start, 0.0)
    if found is None:
        return None
    share = IN_IMPACTS if slack.get(found.part) else FOLLOWED
    return Rate(found.rate, share / found.rate, found.part or "the motion")


def _of_beams(machine: MachineRecord) -> Iterator[Rate]:
    for beam in machine.beams:
        rate = 2.0 * np.pi * fastest_frequency(beam, beam.properties)
        yield Rate(rate, FOLLOWED / rate, f"an element of the beam {beam.name}")
