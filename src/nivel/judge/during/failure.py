"""Failures by the status of a run: what is said of each, in one table: when it failed, where by joint and coordinate, and what to try."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from nivel.analysis.assembly.unknown_groups import unknown_name
from nivel.analysis.plan.beam_facts import too_fast
from nivel.judge.during.growth import grown_motion, jump_advice
from nivel.judge.during.stop import (
    Status,
    Stop,
    Told,
    broken_function,
    broken_signals,
    has_drifted,
    is_far_from_singular,
    mass_left,
    named_row,
    owner_of,
    repeated_by,
    unit_of,
    worst_row,
)
from nivel.kernels.elements import friction as columns
from nivel.system.system import System

# Below this share of its mass a frame has none left.
NO_MASS = 1e-9
# Integrators that choose their steps, for stiff forces.
FOR_STIFF = ("radau", "bdf")
# In place of an integrator, where positions follow from drivers.
KINEMATICS = "kinematics"
# A step above this share of the time is not one that became too small to be told from none.
TINY = 1e-9
OF_UNIT = "Look at what the unit is given, and at its own messages; `nivel run --allow-code` runs it as it is."
# What a method ends with where a force jumps.
NO_STEP = (Status.NOT_CONVERGED, Status.STEP_TOO_SMALL)


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # of a state that may be beyond all bounds
def failure(stop: Stop) -> Told:
    """(message, advice) of a run that failed."""
    status = Status(stop.status)
    unit = next(filter(None, (unit.failure for unit in stop.motion.system.units)), "")
    told = (unit, OF_UNIT) if unit else next(filter(None, (tell(stop) for tell in FAILURES[status])))
    # an iteration on the rates of the state that does not converge says itself what to do
    iterated = status == Status.NOT_CONVERGED and not len(stop.motion.system.record.residual.vdot)
    if not stop.chosen_by and not iterated and (grown := grown_motion(stop.motion, stop.time, stop.step, stop.y)):
        # what failed in the end failed because of that
        told = too_fast(stop.beams, stop.step) or grown
    message, advice = told
    if status in NO_STEP and stop.jumping:
        advice = f"{jump_advice(stop.jumping)} {advice}"
    return f"stopped at t = {stop.time:.6g} s: {message}", advice


def _broken(stop: Stop) -> Told | None:
    """A function without a value."""
    return broken_function(stop.motion, stop.time, stop.step, stop.y)


def _out_of_reach(stop: Stop) -> Told:
    """Where a motion is so fast, by a slip of a unit or a force without bounds, that no run follows it to the end."""
    stiff = " or ".join(f"`integrator: {name}`" for name in FOR_STIFF if name != stop.chosen_by)
    return (
        f"steps of {stop.step:.2g} s are the longest that meet the tolerance, and the end is out of reach with them",
        f"Is a unit wrong, of gravity, a mass, a stiffness or a load? Vibrations that do not matter ask for {stiff}. "
        f"If the motion is meant, take a shorter `duration`.",
    )


def _crawls(stop: Stop) -> Told:
    return f"steps have shrunk to {stop.step:.2g} s, and the end is out of reach", jump_advice(stop.jumping)


def _named(kind: Callable[[System], Sequence[str]], message: str, advice: str) -> Callable[[Stop], Told | None]:
    """What is said of the one among these of a machine that failed, whose name is {name}."""

    def tell(stop: Stop) -> Told | None:
        names = kind(stop.motion.system)
        if stop.number >= len(names):
            return None
        name = names[stop.number]
        return message.format(name=name), advice.format(name=name)

    return tell


def _no_step(stop: Stop) -> Told | None:
    """Where an integrator that chooses its steps finds none that is small enough."""
    if not stop.chosen_by:
        return None
    stop.evaluate()
    singular = stop.status == Status.SINGULAR or not is_far_from_singular(stop.motion)
    reason = {
        Status.SINGULAR: "leads out of a singular position",
        Status.NOT_FINITE: "leads to a state of numbers",
        Status.NOT_CONVERGED: "lets the corrector converge",
    }.get(Status(stop.status), "meets the tolerance")
    if stop.chosen_by == KINEMATICS:
        message = f"no position follows on this one, however short the step; {worst_row(stop.motion)}"
    else:
        short = f"down to {stop.step:.2g} s" if stop.step > 0.0 else "however short"
        message = f"no step from here, {short}, {reason}; {worst_row(stop.motion)}"
    if singular:
        return message, (
            "The machine is in or near a singular position, where constraints depend on each other: two links in line, or a loop folded "
            "flat? Start the run elsewhere, or move a joint by a small amount so that the machine does not pass through it exactly."
            + (" Fixed steps pass over it, as those of --integrator rk4." if stop.chosen_by != KINEMATICS else "")
        )
    if stop.chosen_by == KINEMATICS:
        return message, (
            "Do the drivers ask for a position that the machine does not have, or jumps one of them here? Look at their values near this "
            "time, or start from another position."
        )
    stiff = " or ".join(f"`integrator: {name}`" for name in FOR_STIFF if name != stop.chosen_by)
    return message, (
        f"Does a force or a law jump here, or grow without bounds? Give it a smooth passage of finite length. A very stiff force asks for "
        f"{stiff}. A larger `tolerance` may also help, or an integrator of fixed step."
    )


def _met(stop: Stop) -> Told | None:
    """Where a step passes a singular position, and its end or a frame inside it is there."""
    if not stop.chosen_by or not stop.step > TINY * max(stop.time, 1e-300):
        return None
    row = stop.motion.system.rows[stop.number]
    return (
        f"the constraint {row} depends on the others at the end of the step of some {stop.step:.2g} s from here, or in a frame inside it: "
        f"there the machine is in a singular position, and reactions cannot be found",
        f"Steps pass it, but nothing can be stored in it: another `output_interval` does, when no frame falls there. Or move a joint by a "
        f"small amount so that the machine does not pass through it exactly: look at {owner_of(row)}.",
    )


def _singular(stop: Stop) -> Told | None:
    row = stop.motion.system.rows[stop.number]
    healthy = stop.motion.holds(stop.time, stop.y) and is_far_from_singular(stop.motion)
    if healthy or has_drifted(stop.motion):
        return (
            f"a step of {stop.step:.3g} s from here leads to a position that the machine does not have "
            f"({row} depends on the other constraints there); {worst_row(stop.motion)}",
            f"The step is too large for this motion, or a force too stiff for it: try --step {stop.step / 10:.3g}. If it stops near "
            f"this time again, the machine comes to a singular position there: look at {owner_of(row)}.",
        )
    return (
        f"the constraint {row} depends on the others here, the machine is in a singular position",
        f"Look at {owner_of(row)} in this position: two links in line, or a loop folded flat? Start the run elsewhere, "
        f"or move a joint by a small amount so that the machine does not pass through it exactly. "
        f"A body whose inertia is many orders too small for its mass looks the same.",
    )


_no_mass_left = _named(
    lambda system: system.bodies,
    "the modes of {name} take up all the mass and inertia of its frame, and more with its bending",
    "Reduce its model with `reference: mean-axis`, whose modes carry no momentum, or take fewer `modes` of {name}; in mean axes it "
    "is geometric stiffness that takes mass while the body bends: `stiffening: false`, or a beam in place of {name}.",
)


def _mass_used_up(stop: Stop) -> Told | None:
    """Where accelerations without bounds, of a frame that has no mass left beside its modes, look like a singular position, or like a
    force that jumps."""
    stop.evaluate()
    record = stop.motion.system.record
    share = [mass_left(record, f) for f in range(len(record.flexible.body))]
    if not share or min(share) > NO_MASS:
        return None
    record.control.failure[0] = record.flexible.body[int(np.argmin(share))]
    return _no_mass_left(stop)


def _open(stop: Stop) -> Told | None:
    """Where joints cannot be put together, or are open beyond what drift can be, and positions do not tell why."""
    stop.evaluate()
    found = (
        f"cannot be closed by changes of positions, {named_row(stop.motion.system, stop.number)} least of all"
        if stop.status == Status.NOT_CLOSED
        else "are open by a tenth of the machine, or of their directions"
    )
    return (
        f"after a step of {stop.step:.3g} s from here joints {found}; {worst_row(stop.motion)}",
        f"The step is too long for this motion, or a driver pulls the machine to where it cannot follow: try --step "
        f"{stop.step / 10:.3g}. If it stops near this time again, the machine jams in a singular position: look at what the drivers "
        f"prescribe.",
    )


def _contradiction(stop: Stop) -> Told | None:
    system, control = stop.motion.system, stop.motion.system.record.control
    repeated = repeated_by(stop.motion, stop.number)
    if not len(repeated):
        return _drift(stop)
    owners = dict.fromkeys(system.row_owner[row] for row in repeated[::-1])  # drivers stand last
    message = (
        f"the constraint {system.rows[stop.number]}, which repeated others at the start, contradicts them now "
        f"(open by {system.record.constraints.C[stop.number]:.3g}); it should follow from {', '.join(owners)}"
    )
    if any(system.rows[row].endswith((".driver", ".coupling")) for row in (*repeated, stop.number)):
        same = (
            "Do two drivers, or a driver and the joints or couplings around it, prescribe the same motion differently?"
        )
        return message, f"{same} Remove one of them."
    if control.stabilise[2] > 0.0:
        return message, (
            "The joints fit together where the run started, and not here: is the loop, by its lengths and axes, mobile everywhere? "
            "`nivel check` proposes joints with which nothing is redundant. A position where the motion branches is passed by fixed "
            f"steps, --integrator rk4. With --step {stop.step / 10:.3g} an error of steps is smaller."
        )
    closes = "take --stabilisation direct, which closes all constraints"
    return message, f"That is drift: {closes}, or --step {stop.step / 10:.3g}."


def _slow_multipliers(stop: Stop) -> Told | None:
    saddle = stop.motion.system.record.saddle
    diagonal = saddle.S[saddle.S_start[1:].astype(int) - 1]
    slow, fast = (
        stop.motion.system.rows[saddle.row[saddle.order[int(pick(diagonal))]]] for pick in (np.argmin, np.argmax)
    )
    iterations = int(stop.motion.system.record.control.iterations[0])
    return (
        f"the augmented Lagrangian finds no multipliers within {iterations} iterations: what {slow} and {fast} move, or what they depend "
        f"on, differs too much in mass",
        "Try a greater `penalty: {factor: 1e8}` or more `iterations`; `formulation: newton-euler` needs neither. Constraints that "
        "contradict each other look the same.",
    )


def _fast_bristles(stop: Stop) -> Told | None:
    record, name = stop.motion.system.record, stop.motion.system.frictions[stop.number]
    numbers = record.friction.number[stop.number]
    rate = record.coordinates.rate[int(record.friction.columns[stop.number, columns.COORDINATE])]
    speed = abs(float(rate * numbers[columns.ARM]))
    relaxation = numbers[columns.STIFFNESS] * speed / numbers[columns.KINETIC]
    return (
        f"the bristles of {name} relax with the rate bristle_stiffness v/coefficient = {relaxation:.3g}/s at the speed "
        f"{speed:.3g} m/s, faster than a step of {stop.step:.3g} s can follow; the friction would be wrong from here on",
        f"The step has to be below 2.7 coefficient/(bristle_stiffness v): try --step {1.5 / relaxation:.2g} or, for higher speeds to "
        f"come, less; or a smaller bristle_stiffness of {name}; or `model: stiction`.",
    )


def _off_rail(stop: Stop) -> Told | None:
    """Of a slider whose place along a beam, as last found, is at an end of it, or nowhere."""
    system, coordinates = stop.motion.system, stop.motion.system.record.coordinates
    place = system.record.joints.coordinate.tolist().index(stop.number)
    name = system.layout.coordinates["joint_coordinate"][place]
    length = float(coordinates.station[coordinates.start[stop.number + 1] - 1])
    at = float(coordinates.reference[stop.number])
    if min(at, length - at) > 0.1 * length:
        return (
            f"{name} has no nearest place on its beam: the slider is farther from the line than its radius of curvature",
            "Look whether the beam bends too sharply there, or the joint is torn open; a smaller step may help.",
        )
    end = "end" if at > 0.5 * length else "start"
    return (
        f"{name} leaves its beam at the {end}: it was at {at:.6g} m, the beam is {length:.6g} m long",
        f"Hold it before the end with a force of the type `stop` on `{name}`, end the run there with an event, or make the beam longer.",
    )


def _no_solution(stop: Stop) -> Told | None:
    """Where Newton's iteration for accelerations and multipliers finds nothing."""
    if not len(stop.motion.system.record.residual.vdot):
        return None
    stalled = unknown_name(stop.motion.system, stop.number)
    stop.evaluate()
    message = f"Newton's iteration finds no solution within a step of {stop.step:.3g} s: it stalls at {stalled}; {worst_row(stop.motion)}"
    record = stop.motion.system.record
    iterated = len(record.newton.compliance) > 0 and record.control.iterations[0] > 1
    settle = "Multipliers of bodies that differ much in mass settle with a greater `penalty: {factor: 1e8}`. "
    or_direct = "" if len(record.residual.interval.start) else ", or direct"
    return message, (settle if iterated else "") + (
        f"Try --step {stop.step / 4:.3g}, or a method that makes steps as short as it takes: radau, or generalised-alpha with "
        f"--step-control error. With `stabilisation: none` round-off may keep it from its tolerance: then `corrector: {{tolerance: "
        f"1e-8}}`{or_direct}. If it stops here again, the machine comes to a position that it cannot pass, or a force jumps: look "
        f"at {stalled}."
    )


def _not_converged(stop: Stop) -> Told | None:
    stop.evaluate()
    return (
        f"the iteration of the corrector does not converge within a step of {stop.step:.3g} s: the motion changes too much in it, or a "
        f"force is too stiff; {worst_row(stop.motion)}",
        f"Try --step {stop.step / 10:.3g}; or, where `iteration: functional`, `corrector: {{iteration: newton}}`, which stiff forces do "
        f"not limit. With a tolerance near round-off (1e-13) no iteration may come to an end: then a larger `tolerance` of `corrector`.",
    )


def _not_a_number(stop: Stop) -> Told | None:
    stop.evaluate()
    if broken := broken_signals(stop.motion):
        advice = "Look at what the block is given: a root or logarithm of a negative number, a division by zero."
        return f"{', '.join(broken)} {'is' if len(broken) == 1 else 'are'} no longer a number", advice
    return (
        f"the state after a step of {stop.step:.3g} s is no longer a number; {worst_row(stop.motion)}",
        f"Try a smaller step, for instance --step {stop.step / 10:.3g}; if it stops at the same time, look at the forces near it.",
    )


def _drift(stop: Stop) -> Told:
    """Where a row of a redundant machine that repeats no other one opens."""
    system = stop.motion.system
    return (
        f"{named_row(system, stop.number)} is open by {system.record.constraints.C[stop.number]:.3g} {unit_of(system, stop.number)}: what "
        f"steps of {stop.step:.3g} s miss of this motion has added up",
        f"Try --step {stop.step / 10:.3g}, or --stabilisation direct, which closes constraints. If it is a linkage with more joints than "
        f"it needs, beside a position where its motion branches, --coordinates absolute or --integrator rk4 pass it.",
    )


# what is not a number spoils pivots as well, so it is looked for first
_FIRST: Final = (_broken, lambda stop: too_fast(stop.beams, stop.step))
FAILURES: Final[dict[Status, tuple[Callable[[Stop], Told | None], ...]]] = {
    Status.OUT_OF_REACH: (_out_of_reach,),
    Status.CRAWLS: (_crawls,),
    Status.SINGULAR: (*_FIRST, _mass_used_up, _met, _no_step, _singular),
    Status.NOT_FINITE: (*_FIRST, _mass_used_up, _no_step, _not_a_number),
    Status.FRICTION_DIVERGES: (
        _named(
            lambda system: system.frictions,
            "no friction {name} is consistent with the reactions that it causes: the joint jams, or its normal load would grow without "
            "bounds",
            "Look at {name}: a smaller coefficient; in a joint a longer bearing_length, a smaller radius, or a normal_load. "
            "With Coulomb friction and rigid bodies some positions have no solution (Painlevé). Within a step that is far too long for a "
            "stiff spring it looks the same: then try a shorter --step.",
        ),
    ),
    Status.BRISTLE_TOO_FAST: (_fast_bristles,),
    Status.CONTRADICTION: (_contradiction,),
    Status.ROTATION_SINGULAR: (
        _named(
            lambda system: system.bodies,
            "the rotation coordinates of {name} come to a singular position, where they cannot follow its motion",
            "Three rotation coordinates are singular somewhere: Euler angles where the axes of the first and the third angle are parallel, "
            "a rotation vector at a full turn from the start. The motion goes on: take --rotations euler-parameters, which never are.",
        ),
    ),
    Status.NOT_CONVERGED: (*_FIRST, _mass_used_up, _no_step, _no_solution, _not_converged),
    Status.STEP_TOO_SMALL: (*_FIRST, _mass_used_up, _no_step, _not_a_number),
    Status.EVENT_NOT_FINITE: (
        _named(
            lambda system: system.events,
            "the value of the event {name} is no longer a number",
            "Look at `when` of {name}: a division by zero, or a root or logarithm of a negative number?",
        ),
        *(*_FIRST, _no_step, _not_a_number),
    ),
    Status.MULTIPLIERS_NOT_FOUND: (_slow_multipliers,),
    Status.NO_MASS_LEFT: (_broken, _no_mass_left),
    Status.NOT_ON_RAIL: (_off_rail,),
    Status.NOT_CLOSED: (*_FIRST, _no_step, _open),
    Status.OPEN: (*_FIRST, _no_step, _open),
    Status.NO_VOLUME: (
        _broken,
        _named(
            lambda system: [node.name for node in system.nodes],
            "the volume {name} has no fluid left in it, or no room for it",
            "A step too long for the flows there empties it: try a shorter one, or `integrator: radau`. If it stops here again, look at "
            "the size of the volume, and whether a cylinder is pushed beyond its stroke.",
        ),
        *(*_FIRST, _no_step, _not_a_number),
    ),
}
