"""The method of a run whose machine names none, by the fastest rate of the machine.

The default is explicit and has steps of one length, which costs least. It is left where a step turns the fastest rate by more than it
follows: rates at the start are eigenvalues of the equations there (`nivel.analysis.failures.fastest`); those of contacts and end stops
that may touch later follow from their stiffness and the masses beside them, those of beams from their elements, those of slack ropes from
the same machine with taut ones. What comes in its place is implicit: with steps that it chooses, or for live operation, stepping and C
libraries with steps of one length and one cost. A long run of a slow machine, with more than a million steps, has an explicit method
that chooses its steps.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from nivel.analysis.failures.fastest import Fastest, fastest
from nivel.analysis.plan.beam_facts import fastest_frequency
from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan, plan_run
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.dynamics import RunOutcome
from nivel.analysis.run.preparation import prepare
from nivel.errors import ModelError, SolveError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.kernels.core.status import NOT_FINITE
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.forces import BeltDrive, Contact, Contacts, Rope, Shaft, Stop, is_sticking
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, resolve
from nivel.methods import chooses
from nivel.system.forces.contacts import tangent_stiffness
from nivel.system.forces.heaps import spheres_between
from nivel.system.forces.ropes import length_as_placed
from nivel.system.states.relative import bodies_of
from nivel.system.system import Array

# The largest rate times step that an explicit method of order four follows to some digits; of impacts, which last for half a turn: thirty
# steps in each.
FOLLOWED, IN_IMPACTS = 1.0, np.pi / 30.0
# A step that is longer than its bound by less than this follows as well; in words both would be the same.
NEARLY = 1.001
# Turns of a body in a step [rad] beyond which forces that depend on its angle are not resolved.
TURNED = 3.0
# A run of so many steps, which are below this share of what its fastest rate asks for, has steps that are chosen.
MANY, SLOW, OF_SLOW = 1e6, 1e-3, "dopri5"
# The length of a slack rope as a share of its way, when it is taken as taut.
TAUT = 0.999
# What comes in place of it, the first that goes with the machine and its other settings; the latter for vibrations of many modes.
CHOSEN, OF_MODES = ("radau", "bdf", "generalised-alpha"), ("generalised-alpha", "radau", "bdf")
FIXED = ("ros2",)
# loads at which the stiffness of a contact is taken, as multiples of the weight
HIT = 10.0
# Shares of the swing of a contact in which friction stops what it can hold; chosen steps pass over it where nothing changes.
STOPPING = 1e-3
STANDARD_GRAVITY = 9.81
NONE_GOES = "no implicit method goes with its other settings"


@dataclass(frozen=True)
class Rate:
    """The fastest rate [1/s] of something, the step [s] with which an explicit method follows it, and what it is of, in words."""

    rate: float
    followed: float
    what: str


class FasterError(Exception):
    """What a run that names no integrator became too fast for."""

    def __init__(self, found: Rate) -> None:
        super().__init__(found.what)
        self.found = found


def refuse_faster(plan: Plan, prepared: Prepared, finished: RunOutcome) -> None:
    """Raise FasterError where steps of the plan do not follow the rates in the state that a run has come to: of a part, or of the motion
    where it has grown beyond all numbers. A motion alone may be fast at a singular position, where no method helps."""
    if finished.last is None or finished.asked_to_stop:
        return
    time, y = finished.last
    turning = _of_turning(prepared, y, time)
    if turning is not None and plan.settings.step > turning.followed and not chooses(*_method(plan)):
        raise FasterError(replace(turning, what=f"{turning.what} (at t = {time:.4g} s)"))
    found = _at(prepared, y, time)
    if found is None or not plan.settings.step > FOLLOWED / found.rate:
        return
    if found.part or finished.status == NOT_FINITE:
        what = f"{found.part or 'the motion'} (at t = {time:.4g} s)"
        raise FasterError(Rate(found.rate, FOLLOWED / found.rate, what))


def fitted(
    plan: Plan, prepared: Prepared, *, fixed: bool = False, listener: Listener | None = None
) -> tuple[Plan, Prepared]:
    """The plan and its machine made ready, with another integrator where none was asked for and its own misses the fastest rate.

    fixed : steps of one length and one cost. The plan says in `reason` why it has its integrator.
    Raises SolveError as preparing does.
    """
    if not plan.is_open:
        return plan, prepared
    found = fastest_rate(plan, prepared, prepared.start, 0.0)
    if found is None or plan.settings.step <= NEARLY * found.followed:
        slow = None if fixed else _of_slow(plan, found)
        if slow is None:
            return replace(plan, reason=_explicit(plan, found)), prepared
        build(run_entries(slow), listener)
        return slow, prepare(slow.methods)
    return implicit(plan, prepared, found, fixed=fixed, listener=listener)


def fitting(plan: Plan, prepared: Prepared) -> Plan:
    """The plan that a run of it will have."""
    if not plan.is_open:
        return plan
    found = fastest_rate(plan, prepared, prepared.start, 0.0)
    if found is None or plan.settings.step <= NEARLY * found.followed:
        return _of_slow(plan, found) or replace(plan, reason=_explicit(plan, found))
    return next(
        _implicit_plans(plan, found, fixed=False), replace(plan, reason=f"{_implicit(plan, found)}; {NONE_GOES}")
    )


def implicit(
    plan: Plan, prepared: Prepared, found: Rate, *, fixed: bool = False, listener: Listener | None = None
) -> tuple[Plan, Prepared]:
    """The same with an implicit integrator because of a rate; as it is where none goes with the machine."""
    for new in _implicit_plans(plan, found, fixed=fixed):
        build(run_entries(new), listener)
        try:
            return new, prepare(new.methods)
        except ModelError:  # of what only a machine that was assembled shows
            continue
    return replace(plan, reason=f"{_implicit(plan, found)}; {NONE_GOES}"), prepared


def _implicit_plans(plan: Plan, found: Rate, *, fixed: bool) -> Iterator[Plan]:
    """The same run with other integrators, those first that fit best."""
    machine = plan.machine
    modes = bool(machine.beams or machine.is_flexible) and not _touching(machine)
    for name in FIXED if fixed else OF_MODES if modes else CHOSEN:
        try:
            new = plan_run(_stopping_soon(machine.replace(simulation=machine.simulation.replace(integrator=name))))
        except ModelError:
            continue
        yield replace(new, reason=_implicit(plan, found))


def _of_slow(plan: Plan, found: Rate | None) -> Plan | None:
    """The same run with steps that are chosen, where steps of one length would be many times more than its rates ask for."""
    step, machine = plan.settings.step, plan.machine
    given = "step" in machine.simulation.model_fields_set
    if given or not plan.settings.duration > MANY * step or (found is not None and step > SLOW * found.followed):
        return None
    try:
        new = plan_run(machine.replace(simulation=machine.simulation.replace(integrator=OF_SLOW)))
    except ModelError:
        return None
    rate = "nothing has a rate" if found is None else f"nothing is faster than {found.rate:.2g}/s ({found.what})"
    count = f"{plan.settings.duration / step:.2g}"
    return replace(new, reason=f"{rate}, for which {count} steps of {plan.settings.integrator} are too many")


def _method(plan: Plan) -> tuple[str, str]:
    return plan.settings.integrator, plan.machine.simulation.step_control


def _stopping_soon(machine: MachineRecord) -> MachineRecord:
    """The machine with a shorter `step`, where none is given and steps are chosen: within two of it friction stops what it can hold, which
    must be over before an impact is."""
    settings = machine.simulation
    rates = [each.rate for each in _of_contacts(machine, sticking=True)]
    if not rates or "step" in settings.model_fields_set or not chooses(settings.integrator, settings.step_control):
        return machine
    return machine.replace(simulation=settings.replace(step=min(settings.step, STOPPING / max(rates))))


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


def _touching(machine: MachineRecord) -> list[Contact | Contacts | Stop]:
    return [each for each in machine.forces if isinstance(each, Contact | Contacts | Stop)]


def _of_contacts(machine: MachineRecord, *, sticking: bool = False) -> Iterator[Rate]:
    """Of contacts hit by some times the weight of what touches, of their friction near rest, and of end stops. sticking : of contacts that
    stick alone."""
    gravity = float(np.linalg.norm(machine.gravity)) or STANDARD_GRAVITY
    for each in _touching(machine):
        if sticking and not is_sticking(each):
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
    return _mass(machine, force.bodies or (force.body,), turns=False)


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
    ways = {each.name: length_as_placed(machine, each) for each in machine.forces if isinstance(each, Rope)}
    slack = {
        each.name: (each.length or ways[each.name]) > ways[each.name]
        for each in machine.forces
        if isinstance(each, Rope) and each.stiffness and (each.length or ways[each.name]) >= ways[each.name]
    }
    if not slack:
        return None
    forces = [each.replace(length=TAUT * ways[each.name]) if each.name in slack else each for each in machine.forces]
    try:
        taut = plan_run(machine.replace(forces=tuple(forces), simulation=machine.simulation.replace(start="as-given")))
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
