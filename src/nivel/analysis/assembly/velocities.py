"""Velocities at the start: those that are given are kept, all others follow with the least kinetic energy.

What the constraints and the rates of joints and drivers ask for is an impulse at the start: of all motions that fit, the machine takes the
one whose change has the least kinetic energy (Bertrand and Kelvin; Routh 1905, Rigid Dynamics, part 1, art. 374–389), found by least
squares in the velocities whitened by the mass matrix. Where what is given does not fit by itself, it is changed as little as possible,
in lengths of the machine and radians.
"""

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.closing import OPEN, Wishes, least_change
from nivel.analysis.assembly.equations import MotionEquations
from nivel.errors import Fault, ModelError, refuse
from nivel.kernels.core.status import OK
from nivel.kernels.elements import friction as columns
from nivel.machine.core.vectors import cross
from nivel.machine.machine_record import MachineRecord
from nivel.system.system import Array, System

# Given velocities are changed so much less willingly than others, and only where they do not fit.
RELUCTANT = 1e-3
# Weights of bodies count up to this one: least squares take smaller shares for round-off.
MOST_WEIGHT = 1e3
# The second solution takes the round-off of the first one away.
SOLUTIONS = 2
# Bodies lighter than this share of the largest mass count as heavy as that, where velocities cannot be found otherwise.
LIGHTEST = 1e-2
# Changes below this share of the largest velocity are round-off.
ROUND_OFF = 1e-12
# [s] in which impulses act: forces do nothing in it.
INSTANT = 1e-9


def consistent_velocities(
    machine: MachineRecord, motion: MotionEquations, t: float, y: Array, wishes: Wishes
) -> tuple[Array, Array]:
    """The state y with velocities that fit the joints, and their changes (B, 6): (Ṙ [m/s], ω̄ [rad/s]).

    Raises ModelError naming rows and start rates that cannot have the rates asked of them.
    """
    system, record = motion.system, motion.system.record
    count, rows = system.body_count, slice(0, system.machine_rows)
    bodies = system.record.bodies
    before = np.hstack([bodies.Rdot[:count] / system.size, bodies.omega_b[:count]])  # Ṙ in lengths of the machine
    chosen, rates = [q for _, q, _ in wishes.rates], np.array([rate for _, _, rate in wishes.rates])
    units = [1.0 if name.partition(".")[2].startswith("angle") else system.size for name, _, _ in wishes.rates]
    scale = np.append(record.constraints.scale[rows], units)
    new = before
    for ways in _ways(machine, system, wishes):
        new = before
        _set_velocities(motion, t, y, new)
        for _ in range(SOLUTIONS):
            target = np.append(-record.constraints.Cdot[rows], rates - record.coordinates.rate[chosen])
            change = least_change(motion, target, chosen, scale, ways).reshape(count, 6)
            change[np.abs(change) <= ROUND_OFF * np.abs(before).max(initial=0.0)] = 0.0
            new = new + change
            _set_velocities(motion, t, y, new)
        if not _left_open(system).size and not _missed(system, wishes):
            break
    _refuse_impossible_rates(system, wishes)
    state = _set_velocities(motion, t, y, new)
    return state, (new - before) * np.repeat([system.size, 1.0], 3)


def taken_along(motion: MotionEquations, t: float, y: Array) -> tuple[Array, Array]:
    """The state y in which no rigid freewheel without a capacity falls behind, and the changes (B, 6) of velocities as above: those by the
    impulses that such freewheels exert in an instant."""
    system, record = motion.system, motion.system.record
    friction, none = record.friction, np.zeros((system.body_count, 6))
    if not len(friction.columns):
        return y, none
    one_way = friction.columns[:, columns.WAY] == columns.ONE_WAY
    rigid = one_way & (friction.number[:, columns.LOAD] >= columns.UNLIMITED)
    if not rigid.any():
        return y, none
    motion.evaluate(t, y)
    if not (record.coordinates.rate[friction.columns[rigid, columns.COORDINATE]] < 0.0).any():
        return y, none
    stick, record.control.stick[0] = float(record.control.stick[0]), INSTANT
    status, rate = motion.evaluate(t, y)
    record.control.stick[0] = stick
    if status != OK or not np.isfinite(rate).all():
        return y, none
    state, velocities = y.copy(), slice(system.positions, len(y) - len(system.start_of_states))
    state[velocities] += INSTANT * rate[velocities]
    motion.evaluate(t, state)
    return state, (state - y)[velocities][: none.size].reshape(none.shape)


def given_velocities(machine: MachineRecord) -> NDArray[np.bool_]:
    """(B, 2) of each body whether a velocity and an angular velocity other than zero are given; nodes of beams have theirs."""
    nodes = {name for beam in machine.beams for name in beam.node_names}
    return np.array(
        [
            (
                body.name in nodes or any(body.velocity),
                body.name in nodes or any(body.angular_velocity or body.angular_velocity_body or ()),
            )
            for body in machine.bodies
        ],
        dtype=bool,
    ).reshape(len(machine.bodies), 2)


def _ways(machine: MachineRecord, system: System, wishes: Wishes) -> tuple[Array, ...]:
    """(B, 6, 6) changes of velocities for numbers of equal cost: first where given ones are kept, then, if any is, where they are not; the
    same with light bodies as heavy as LIGHTEST, which in their own scale hide the others where masses differ by many orders."""
    given = given_velocities(machine)
    reluctant = np.repeat(given, 3, axis=1) * (RELUCTANT / np.minimum(wishes.weight, MOST_WEIGHT)[:, None])
    ways: list[Array] = []
    for lightest in (0.0, LIGHTEST):
        free = whitened(system, ~np.repeat(given, 3, axis=1), lightest)
        ways += [free, free + reluctant[:, :, None] * np.eye(6)] if given.any() else [free]
    return tuple(ways)


def whitened(system: System, free: NDArray[np.bool_], lightest: float) -> Array:
    """(B, 6, 6) L⁻ᵀ of the mass matrix L Lᵀ of the velocities that are `free` (B, 6), lengths in units of the machine; zero for the others.

    The largest mass of the machine counts as one; lightest : share of it that every body has at least.
    """
    bodies, count = system.record.bodies, system.body_count
    M = np.zeros((count, 6, 6))
    M[:, :3, :3] = bodies.mass[:, None, None] * np.eye(3)
    M[:, :3, 3:] = -bodies.mass[:, None, None] * bodies.A[:count] @ -cross(bodies.centre_b[:, None], np.eye(3))
    M[:, 3:, :3] = np.swapaxes(M[:, :3, 3:], 1, 2)
    M[:, 3:, 3:] = bodies.inertia_origin_b
    M[:, :3, :] *= system.size
    M[:, :, :3] *= system.size
    M /= np.max(np.abs(M), initial=np.finfo(float).tiny)
    if lightest:
        M *= np.maximum(1.0, lightest / np.abs(M).max(axis=(1, 2), keepdims=True))
    both = free[:, :, None] & free[:, None, :]
    L = np.linalg.cholesky(np.where(both, M, np.eye(6)))
    return np.where(both, np.swapaxes(np.linalg.inv(L), 1, 2), 0.0)


def _set_velocities(motion: MotionEquations, t: float, y: Array, velocities: Array) -> Array:
    """The state with the positions of y and velocities (B, 6), evaluated."""
    system = motion.system
    state = system.state(y[: system.positions], velocities[:, :3] * system.size, velocities[:, 3:])
    motion.evaluate(t, state)
    return state


def _speed(system: System) -> float:
    """What rates are measured by: the largest angular velocity or velocity over the machine's length, or 1/s."""
    bodies = system.record.bodies
    return max(1.0, float(np.abs(bodies.omega_b).max()), float(np.abs(bodies.Rdot).max()) / system.size)


def _left_open(system: System) -> NDArray[np.intp]:
    """Rows whose rates are not what is asked of them."""
    constraints, rows = system.record.constraints, slice(0, system.machine_rows)
    return np.flatnonzero(np.abs(constraints.Cdot[rows]) / constraints.scale[rows] > OPEN * _speed(system))


def _missed(system: System, wishes: Wishes) -> list[tuple[str, float, float]]:
    """Rates of joint coordinates that are not those asked for: name, wanted, had."""
    speed = _speed(system)
    found = [(name, rate, float(system.record.coordinates.rate[q])) for name, q, rate in wishes.rates]
    return [each for each in found if abs(each[2] - each[1]) > OPEN * max(speed, abs(each[1])) * max(1.0, system.size)]


def _refuse_impossible_rates(system: System, wishes: Wishes) -> None:
    """Rates that the machine cannot have: drivers or start rates that contradict each other or the joints."""
    faults, wrong, missed = [], _left_open(system), _missed(system, wishes)
    # rates that contradict each other open joints as well, which are not to blame
    prescribed = [row for row in wrong if section_of(system, system.row_owner[row]) == "drivers"]
    names = dict.fromkeys(system.row_owner[row] for row in prescribed)
    if not missed and len(names) > 1:
        for name in names:
            others = " and ".join(other for other in names if other != name)
            message = f"the joints do not allow the speed of this motion at the start together with that of {others}: drive one of them"
            faults.append(Fault.at(f"drivers.{name}", message))
        raise ModelError(faults)
    for row in prescribed or (() if missed else wrong):
        owner = system.row_owner[row]
        message = f"the velocities contradict each other: {system.rows[row]} cannot have the rate that is asked of it"
        faults.append(Fault.at(f"{section_of(system, owner)}.{owner}", message))
    for name, rate, got in missed:
        joint, _, coordinate = name.partition(".")
        message = (
            f"the rate {rate:.6g} of {name} cannot be reached: the joints, drivers and other rates allow {got:.6g}"
        )
        if len(missed) > 1:
            message += "; of rates that the joints tie together give one"
        faults.append(Fault.at(f"joints.{joint}.start_rates.{coordinate}", message))
    refuse(faults)


def section_of(system: System, owner: str) -> str:
    """The section of the machine file in which the owner of a row stands."""
    if owner in system.joints:
        return "joints"
    return "couplings" if f"{owner}.coupling" in system.rows else "drivers"
