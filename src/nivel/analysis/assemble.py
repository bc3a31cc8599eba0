"""Assembly: the given positions are moved as little as possible onto the constraints, then the velocities likewise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.equations import MotionEquations, change_between, moved
from nivel.errors import Fault, ModelError
from nivel.machine.machine_record import MachineRecord
from nivel.system.joints import JOINTS
from nivel.system.system import Array, System

ITERATIONS = 100
# Constraints hold to this share of the scale of their row: the machine's length, or 1 for cosines.
CLOSED = 1e-12
# Longest step of an iteration, in radians and machine lengths.
LONGEST = 0.5
# A row that cannot be closed better than this share is named.
OPEN = 1e-9
# Changes below this share of the machine's length, of one radian, of the largest velocity are round-off and not told.
ROUND_OFF = 1e-12
# Machines larger than this many entries of C_q are solved iteratively.
DENSE_ENTRIES = 1_000_000


@dataclass(frozen=True)
class Assembly:
    """An assembled state and how far it is from the given one.

    y : state. gap : largest violation of a position row as given (`gap_row` names it) [m or rad]. moved : for each body that moved,
    name, distance [m] and angle [rad]. velocity_change : the same for velocities [m/s], [rad/s].
    """

    y: Array
    gap: float
    gap_row: str
    moved: tuple[tuple[str, float, float], ...]
    velocity_change: tuple[tuple[str, float, float], ...]


def assemble(machine: MachineRecord, motion: MotionEquations, t: float = 0.0) -> Assembly:
    """Close all joints of `machine` at time t.

    Raises ModelError naming every joint row that cannot be closed with its gap, and joints whose axes end up opposite.
    """
    with np.errstate(over="ignore", invalid="ignore"):  # numbers too large end as joints that stay open
        return _assemble(machine, motion, t)


def _assemble(machine: MachineRecord, motion: MotionEquations, t: float) -> Assembly:
    system = motion.system
    y = system.start.copy()
    given = y[: system.positions].copy()
    gap, gap_row = _largest_gap(motion, t, y)
    close_positions(motion, t, y)
    _refuse_open_joints(machine, motion)
    y, velocity_change = _consistent_velocities(motion, t, y)
    return Assembly(y, gap, gap_row, _moves(system, given, y[: system.positions]), velocity_change)


def _largest_gap(motion: MotionEquations, t: float, y: Array) -> tuple[float, str]:
    """Largest violation of a joint row at y, measured by the scales of the rows, and its name."""
    system = motion.system
    motion.evaluate(t, y)
    violation = np.abs(system.record.constraints.C[: system.joint_rows])
    if not len(violation):
        return 0.0, ""
    worst = int(np.argmax(violation / system.record.constraints.scale[: system.joint_rows]))
    return float(violation[worst]), system.rows[worst]


def close_positions(motion: MotionEquations, t: float, y: Array) -> bool:
    """Move the positions in the state y as little as possible onto the constraints, in place; whether all rows are closed.

    Where they cannot be closed, y is the best position found. The record is left evaluated at y.
    """
    system = motion.system
    rows = slice(0, system.joint_rows)
    C, scale = system.record.constraints.C, system.record.constraints.scale[rows]
    best, least = y.copy(), np.inf
    for _ in range(ITERATIONS):
        motion.evaluate(t, y)
        violation = C[rows]
        if not np.all(np.isfinite(violation)):
            return False
        size = float(np.linalg.norm(violation / scale))
        if size < least:
            best, least = y.copy(), size
        if np.max(np.abs(violation) / scale, initial=0.0) <= CLOSED:
            return True
        change = _least_change(motion, -violation)
        # a step of more than half a radian or half the machine is outside the linear range
        length = float(np.abs(change).max())
        change *= min(1.0, LONGEST / length) if length > 0.0 else 0.0
        change.reshape(-1, 6)[:, :3] *= system.size
        y[: system.positions] = moved(y[: system.positions], change)
    y[:] = best
    motion.evaluate(t, y)
    return bool(np.max(np.abs(C[rows]) / scale, initial=0.0) <= OPEN)


def _least_change(motion: MotionEquations, target: Array) -> Array:
    """Least x with C_q x = target, lengths of x in units of the machine's length; rows are weighed by their scales."""
    system = motion.system
    if not np.any(target):
        return np.zeros(6 * system.body_count)
    scale = system.record.constraints.scale[: len(target)]
    J = motion.jacobian().reshape(len(target), -1, 6)
    J[:, :, :3] *= system.size
    J = J.reshape(len(target), -1) / scale[:, None]
    target = target / scale
    if J.size <= DENSE_ENTRIES:
        try:
            return np.asarray(np.linalg.lstsq(J, target, rcond=1e-10)[0], dtype=np.float64)
        except np.linalg.LinAlgError:
            message = "the positions and lengths of the machine are too far apart in size to compute with"
            raise ModelError(Fault("", 0, 0, "machine", message)) from None
    from scipy.sparse import csr_matrix
    from scipy.sparse.linalg import lsmr

    return lsmr(csr_matrix(J), target, atol=1e-15, btol=1e-15, conlim=1e15, maxiter=20 * len(target))[0]


def _consistent_velocities(
    motion: MotionEquations, t: float, y: Array
) -> tuple[Array, tuple[tuple[str, float, float], ...]]:
    system, bodies = motion.system, motion.system.record.bodies
    count = system.body_count
    # lengths in units of the machine's length, so that metres and radians can be compared
    given = np.hstack([bodies.Rdot[:count] / system.size, bodies.omega_b[:count]])
    change = _least_change(motion, -system.record.constraints.Cdot[: system.joint_rows]).reshape(count, 6)
    change[np.abs(change) <= ROUND_OFF * np.abs(given).max(initial=0.0)] = 0.0
    new = given + change
    new[:, :3] *= system.size
    change[:, :3] *= system.size
    assembled = system.state(y[: system.positions], new[:, :3], new[:, 3:])
    motion.evaluate(t, assembled)
    return assembled, _named(system.bodies, change[:, :3], change[:, 3:], 0.0, 0.0)


def _named(
    names: tuple[str, ...], lengths: Array, angles: Array, least_length: float, least_angle: float
) -> tuple[tuple[str, float, float], ...]:
    """(name, length, angle) of the bodies whose vectors are longer than the least ones."""
    sizes = zip(names, np.linalg.norm(lengths, axis=1), np.linalg.norm(angles, axis=1), strict=True)
    return tuple((name, float(d), float(a)) for name, d, a in sizes if d > least_length or a > least_angle)


def _moves(system: System, given: Array, q: Array) -> tuple[tuple[str, float, float], ...]:
    change = change_between(given, q)
    return _named(system.bodies, change[:, :3], change[:, 3:], ROUND_OFF * system.size, ROUND_OFF)


def _refuse_open_joints(machine: MachineRecord, motion: MotionEquations) -> None:
    system, record = motion.system, motion.system.record
    share = np.abs(record.constraints.C / record.constraints.scale)[: system.joint_rows]
    faults = []
    for j, joint in enumerate(machine.joints):
        rows = np.flatnonzero(system.row_joint == j)
        worst = int(rows[np.argmax(share[rows])])
        if not share[worst] <= OPEN:
            faults.append(Fault("", 0, 0, f"joints.{joint.name}", _gap(system, worst)))
        elif JOINTS[joint.type].parallel:
            first, second = record.joints.first_marker[j], record.joints.first_marker[j] + 1
            if record.markers.A[first, :, 2] @ record.markers.A[second, :, 2] < 0.0:
                message = "the z axes of its two markers point in opposite directions; turn one of them round"
                faults.append(Fault("", 0, 0, f"joints.{joint.name}", message))
    if faults:
        raise ModelError(faults)


def _gap(system: System, row: int) -> str:
    """What is left open at a row, and what to look at."""
    left = abs(float(system.record.constraints.C[row]))
    name = system.rows[row]
    if system.row_units[row] == "m":
        advice = "check the positions of its bodies and the lengths between their joints"
        return f"cannot be closed: a gap of {left:.6g} m is left at {name}; {advice}"
    angle = np.degrees(np.arcsin(min(left, 1.0)))
    advice = "turn one of its markers (the name says which axis of the first is perpendicular to which of the second)"
    return f"cannot be closed: the two directions of {name} are {angle:.4g} deg away from a right angle; {advice}"
