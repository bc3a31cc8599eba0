"""Assembly: the given positions are moved as little as possible onto the constraints, then the velocities likewise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.equations import MotionEquations, moved
from nivel.errors import Fault, ModelError
from nivel.machine.machine_record import MachineRecord
from nivel.system.joints import JOINTS
from nivel.system.system import Array

ITERATIONS = 100
# Constraints hold to this share of the machine's length [m] and, for directions, to this angle [rad].
CLOSED = 1e-12
# A row that cannot be closed better than this is named.
OPEN = 1e-9
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
    system = motion.system
    y = system.start.copy()
    given = y[: system.positions].copy()
    gap, gap_row = 0.0, ""
    rows = slice(0, system.joint_rows)
    C = system.record.constraints.C
    for iteration in range(ITERATIONS + 1):
        motion.evaluate(t, y)
        violation = C[rows]
        if not np.all(np.isfinite(violation)):
            break
        if iteration == 0 and len(violation):
            worst = int(np.argmax(np.abs(violation)))
            gap, gap_row = float(abs(violation[worst])), system.rows[worst]
        if not len(violation) or np.abs(violation).max() <= CLOSED * max(1.0, system.size):
            break
        change = _least_change(motion, -violation)
        # a step of more than half a radian or half the machine is outside the linear range
        length = float(np.abs(change).max())
        limit = 0.5
        change *= min(1.0, limit / length) if length > 0.0 else 0.0
        change.reshape(-1, 6)[:, :3] *= system.size
        y[: system.positions] = moved(y[: system.positions], change)
    motion.evaluate(t, y)
    _refuse_open_joints(machine, motion)
    y, velocity_change = _consistent_velocities(motion, t, y)
    return Assembly(y, gap, gap_row, _moves(system.bodies, given, y[: system.positions]), velocity_change)


def _least_change(motion: MotionEquations, target: Array) -> Array:
    """Least x with C_q x = target, lengths of x in units of the machine's length."""
    if not np.any(target):
        return np.zeros(6 * motion.system.body_count)
    J = motion.jacobian().reshape(len(target), -1, 6)
    J[:, :, :3] *= motion.system.size
    J = J.reshape(len(target), -1)
    if J.size <= DENSE_ENTRIES:
        return np.asarray(np.linalg.lstsq(J, target, rcond=1e-10)[0], dtype=np.float64)
    from scipy.sparse import csr_matrix
    from scipy.sparse.linalg import lsmr

    return lsmr(csr_matrix(J), target, atol=1e-15, btol=1e-15, conlim=1e15, maxiter=20 * len(target))[0]


def _consistent_velocities(
    motion: MotionEquations, t: float, y: Array
) -> tuple[Array, tuple[tuple[str, float, float], ...]]:
    system, bodies = motion.system, motion.system.record.bodies
    count = system.body_count
    velocity, angular = bodies.Rdot[:count].copy(), bodies.omega_b[:count].copy()
    given = np.hstack([velocity, angular])
    if system.joint_rows:
        change = _least_change(motion, -system.record.constraints.Cdot[: system.joint_rows]).reshape(count, 6)
        change[:, :3] *= system.size
        change[np.abs(change) < 1e-15 * (1.0 + np.abs(given))] = 0.0
    else:
        change = np.zeros((count, 6))
    new = given + change
    assembled = system.state(y[: system.positions], new[:, :3], new[:, 3:])
    moves = zip(
        system.bodies, np.linalg.norm(change[:, :3], axis=1), np.linalg.norm(change[:, 3:], axis=1), strict=True
    )
    motion.evaluate(t, assembled)
    return assembled, tuple((name, float(d), float(a)) for name, d, a in moves if d > 0.0 or a > 0.0)


def _moves(names: tuple[str, ...], given: Array, q: Array) -> tuple[tuple[str, float, float], ...]:
    before, after = given.reshape(-1, 7), q.reshape(-1, 7)
    distance = np.linalg.norm(after[:, :3] - before[:, :3], axis=1)
    # |2 sin(half the angle)| of the turn between two unit quaternions, either sign
    chord = np.minimum(
        np.linalg.norm(after[:, 3:] - before[:, 3:], axis=1), np.linalg.norm(after[:, 3:] + before[:, 3:], axis=1)
    )
    angle = 4.0 * np.arcsin(np.clip(chord / 2.0, 0.0, 1.0))
    return tuple(
        (name, float(d), float(a)) for name, d, a in zip(names, distance, angle, strict=True) if d > 1e-14 or a > 1e-14
    )


def _refuse_open_joints(machine: MachineRecord, motion: MotionEquations) -> None:
    system, record = motion.system, motion.system.record
    violation = record.constraints.C[: system.joint_rows]
    faults = []
    for j, joint in enumerate(machine.joints):
        rows = np.flatnonzero(system.row_joint == j)
        worst = max(rows, key=lambda row: abs(violation[row]))
        path = f"joints.{joint.name}"
        if not abs(violation[worst]) <= OPEN * max(1.0, system.size):
            unit = system.row_units[worst].replace("1", "rad")
            message = f"cannot be closed: a gap of {abs(violation[worst]):.6g} {unit} is left at {system.rows[worst]}"
            faults.append(
                Fault(
                    "", 0, 0, path, message + "; check the positions of its bodies and the lengths between their joints"
                )
            )
        elif JOINTS[joint.type].parallel:
            first, second = record.joints.first_marker[j], record.joints.first_marker[j] + 1
            if record.markers.A[first, :, 2] @ record.markers.A[second, :, 2] < 0.0:
                message = "the z axes of its two markers point in opposite directions; turn one of them round"
                faults.append(Fault("", 0, 0, path, message))
    if faults:
        raise ModelError(faults)
