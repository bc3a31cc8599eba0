"""Redundancy: constraint rows that depend on others, reactions that are therefore not unique, and the number of degrees of freedom.

Lost directions: points that coincide where a joint needs the line between them, axes that are parallel where it needs their normal.
Such a joint is closed as placed, but nothing says in which direction it holds: the derivative of its row is zero, or not a number.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from nivel.analysis.assembly.closing import close_positions
from nivel.analysis.assembly.equations import MotionEquations, change_between, equations, moved
from nivel.errors import Fault, ModelError, refuse
from nivel.kernels.core.status import OK
from nivel.lazy import Struct, scipy
from nivel.machine.machine_record import MachineRecord
from nivel.system.flexible import Bending, bending_bodies
from nivel.system.joint_frames import tilted_axes
from nivel.system.states.floating import carried_markers
from nivel.system.system import Array, System

# Rows count as dependent below this share of their length: assembled machines are closed to about 1e-12.
DEPENDENT = 1e-8
# Singular values of unit rows from which on rows are certainly independent, whatever the round-off in J Jᵀ.
NEARLY = 1e-4
# Pivots of S above this share of their diagonal prove independence without a closer look.
CERTAIN = 1e-9
# Two positions this far apart (share of the machine's length, radians) tell a singular position from a redundant machine.
ASIDE = 1e-3


class Redundancy(Struct):
    """Rank of the joint rows at the assembled position; bodies that bend may make rows independent that were not between rigid ones.

    redundant_rows : rows that add nothing to the rows named before them. non_unique_joints : joints with reactions that the equations
    of rigid bodies do not determine. singular : rows lost at this position only, not nearby. degrees_of_freedom : of velocities;
    position_freedoms : of positions, more of them where wheels roll without slip.
    """

    degrees_of_freedom: int
    position_freedoms: int
    rank: int
    redundant_rows: tuple[str, ...]
    non_unique_joints: tuple[str, ...]
    singular_rows: tuple[str, ...]


class ModalRows(Struct):
    """Columns of C_q for the modes of `bending`; carried : flexible body and interface of every marker that is at one."""

    bending: Sequence[Bending]
    carried: Mapping[int, tuple[int, int]]

    @property
    def count(self) -> int:
        """How many modes there are."""
        return sum(len(each.reduced.eigenvalues) for each in self.bending)

    def columns(self, motion: MotionEquations) -> Array:
        """(rows, modes) C_p in the state last evaluated, for ṗ √m l: m the mass of the body, l the length of the machine.

        The node at an interface moves by A φ ṗ and turns by A ψ ṗ; a marker at u from it moves by (A ψ ṗ) × u more.
        """
        record, system = motion.system.record, motion.system
        first = np.cumsum([0, *(len(each.reduced.eigenvalues) for each in self.bending)])
        out = np.zeros((system.machine_rows, self.count))
        for row, part, marker, body in record.saddle.block[: int(record.saddle.blocks[0])].tolist():
            if marker not in self.carried or row >= system.machine_rows:
                continue
            f, k = self.carried[marker]
            reduced, A = self.bending[f].reduced, record.bodies.A[body]
            interface = reduced.interfaces[k]
            force, torque = record.constraints.J[part, :3], record.constraints.J[part, 3:]
            u = A @ (record.markers.position_b[marker] - interface.position)
            entries = (A.T @ force) @ interface.phi
            if interface.turns:
                entries = entries + (A.T @ (torque + np.cross(u, force))) @ interface.psi
            out[row, first[f] : first[f + 1]] += entries * np.sqrt(reduced.mass) * system.size
        return out


def modal_rows(machine: MachineRecord, system: System) -> ModalRows | None:
    """Of a machine in absolute coordinates; None where nothing bends. Raises ModelError where a marker is at no interface."""
    if not machine.is_flexible:
        return None
    bending = bending_bodies(machine)
    return ModalRows(bending, carried_markers(system, machine, bending))


def analyse(motion: MotionEquations, t: float, y: Array, modes: ModalRows | None = None) -> Redundancy:
    """Rank of the constraints at state y, which must be assembled; `modes` : of bodies that bend, undeformed at y."""
    system = motion.system
    rows = system.machine_rows
    freedoms = system.freedoms + (modes.count if modes is not None else 0)
    if motion.evaluate(t, y)[0] == OK and _certainly_independent(motion):
        return Redundancy(freedoms - rows, freedoms - rows + len(system.velocity_rows), rows, (), (), ())
    J = scaled_jacobian(motion, modes)
    dependent, N = dependent_rows(J)
    rank = rows - len(dependent)
    holding = np.delete(J, sorted(system.velocity_rows), axis=0)
    positions = freedoms - (len(holding) - len(dependent_rows(holding)[0]) if len(holding) < len(J) else rank)
    if not dependent:
        return Redundancy(freedoms - rows, positions, rows, (), (), ())
    nearby = _rank_nearby(motion, t, y, rank, modes)
    names = tuple(system.rows[row] for row in dependent)
    loose = np.abs(N).max(axis=1) > 1e-6
    joints = dict.fromkeys(system.row_owner[row] for row in np.flatnonzero(loose))
    return Redundancy(
        freedoms - rank, positions, rank, names, tuple(joints), names[: nearby - rank] if nearby > rank else ()
    )


def _certainly_independent(motion: MotionEquations) -> bool:
    saddle = motion.system.record.saddle
    if not len(saddle.order):
        return True
    diagonal = saddle.S[saddle.S_start[1:].astype(int) - 1]
    return bool(np.all(saddle.Dinv * diagonal < 1.0 / CERTAIN))


def scaled_jacobian(motion: MotionEquations, modes: ModalRows | None = None) -> Array:
    """C_q with lengths in units of the machine's length and rows of unit length; the columns of modes behind the others."""
    J = motion.jacobian_in_lengths()
    if modes is not None:
        J = np.hstack([J, modes.columns(motion)])
    return J / np.linalg.norm(J, axis=1, keepdims=True)


def row_lengths(motion: MotionEquations) -> Array:
    """(rows,) lengths of the rows of C_q, lengths in units of the machine's length."""
    row, body, block = motion.jacobian_blocks()
    system = motion.system
    # blocks of one row and body add up before their length is taken
    key, place = np.unique(row * system.body_count + body, return_inverse=True)
    summed = np.zeros((len(key), 6))
    np.add.at(summed, place, block)
    summed[:, :3] *= system.size
    squares = np.bincount(key // system.body_count, weights=(summed**2).sum(axis=1), minlength=system.machine_rows)
    return np.sqrt(squares)


def dependent_rows(J: Array) -> tuple[list[int], Array]:
    """Rows of J (unit rows) that depend on the rows before them, and N (rows, surplus) with Nᵀ J = 0, orthonormal.

    The rows without the last of each combination that vanishes are the first independent ones: they are found from the end.
    """
    N = _vanishing(J)
    surplus = N.shape[1]
    basis, count, left = np.zeros((surplus, surplus)), 0, np.zeros(len(J))
    for k in range(len(J) - 1, -1, -1):
        rest = N[k] - basis[:count].T @ (basis[:count] @ N[k])
        rest -= basis[:count].T @ (basis[:count] @ rest)
        left[k] = np.linalg.norm(rest)
        if left[k] > np.sqrt(DEPENDENT) and count < surplus:
            basis[count] = rest / left[k]
            left[k] = np.inf
            count += 1
    return sorted(np.argsort(-left, kind="stable")[:surplus].tolist()), N


def _vanishing(J: Array) -> Array:
    """(rows, surplus) left singular vectors of J (unit rows) whose singular values are at most DEPENDENT.

    Eigenvectors of J Jᵀ of eigenvalues up to NEARLY² span them and few others. Round-off ε turns that space towards a vector of singular
    value σ by ε/σ², which adds at most ε/NEARLY to its own singular values: far below DEPENDENT.
    """
    if not len(J):
        return np.zeros((0, 0))
    _, V = scipy.linalg.eigh(J @ J.T, subset_by_value=(-np.inf, NEARLY**2))
    U, sizes, _ = np.linalg.svd(V.T @ J, full_matrices=V.shape[1] > J.shape[1])
    small = np.concatenate([sizes, np.zeros(U.shape[1] - len(sizes))]) <= DEPENDENT
    return V @ U[:, small]


def _rank_nearby(motion: MotionEquations, t: float, y: Array, rank: int, modes: ModalRows | None) -> int:
    """Rank a little aside along a free motion of the rigid machine, joints closed again: larger than `rank` where only this position is
    singular."""
    if aside(motion, t, y, ASIDE, seed=0, closed=False) is None:
        return rank
    J = scaled_jacobian(motion, modes)
    return max(rank, int(np.sum(np.linalg.eigvalsh(J @ J.T) > ASIDE**4)))


def aside(motion: MotionEquations, t: float, y: Array, far: float, *, seed: int, closed: bool = True) -> Array | None:
    """A state aside from y, last evaluated, along a random free motion; `far` is its length, in radians and machine lengths; all joints are
    closed at the time t. None where there is none. The record is left evaluated there.

    closed : otherwise a state with open joints does too, where closing leads back.
    """
    system = motion.system
    motion.evaluate(t, y)
    J = scaled_jacobian(motion)
    held = _held_directions(J)
    change = np.random.default_rng(seed).standard_normal(J.shape[1])
    share = _free_part(held, change)
    length = float(np.linalg.norm(share))
    if not length > DEPENDENT * np.sqrt(J.shape[1]):
        return None
    share *= far / length
    change = share.reshape(-1, 6).copy()
    change[:, :3] *= system.size
    found = y.copy()
    found[: system.positions] = moved(y[: system.positions], change.ravel())
    opened = found[: system.positions].copy()
    # without closing, the open joints alone would make redundant rows look independent
    is_closed = close_positions(motion, t, found)
    reached = change_between(y[: system.positions], found[: system.positions])
    reached[:, :3] /= system.size
    way = np.linalg.norm(_free_part(held, reached.ravel()) - share)
    if closed:
        return found if is_closed and way < 0.5 * far else None
    if not is_closed or way > 0.1 * far:
        # a motion of the first order only, as of two links stretched out between two pins: closing leads back
        found[: system.positions] = opened
        motion.evaluate(t, found)
    return found


def _held_directions(J: Array) -> Array:
    """(n, rank) orthonormal: the directions that rows of J feel."""
    if not len(J):
        return np.zeros((J.shape[1], 0))
    factors: Any = scipy.linalg.qr(J.T, mode="economic", pivoting=True)
    Q, R, _ = factors
    return Q[:, np.abs(np.diag(R)) > DEPENDENT]


def _free_part(held: Array, change: Array) -> Array:
    """The part of a change that is in no direction that is held."""
    left = change - held @ (held.T @ change)
    return left - held @ (held.T @ left)


# Points that are nearer than this share of the machine's length have no line between them; rows of derivatives below LOST of their
# scale no direction.
COINCIDE, LOST = 1e-9, 1e-7


def refuse_lost_directions(machine: MachineRecord, motion: MotionEquations) -> None:
    """Refuse joints without a direction in the state last evaluated, in which they are closed.

    Raises ModelError.
    """
    system = motion.system
    if not system.machine_rows:
        return
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        lengths = row_lengths(motion)
    lost = ~(lengths > LOST * system.record.constraints.scale[: len(lengths)])
    owners = {system.row_owner[row] for row in np.flatnonzero(lost)}
    faults = []
    for k, joint in enumerate(machine.joints):
        apart = _distance(system, k)
        if "distance" in joint.held or joint.type == "revolute-spherical":
            if apart <= COINCIDE * system.size:
                key = "points" if joint.points is not None else "markers"
                message = (
                    f"its two {key} are at one place, {apart:.2g} m apart, so the line between them has no direction: move one of them, or "
                    f"write `type: spherical`"
                )
                faults.append(Fault.at(f"joints.{joint.name}.{key}", message))
        elif joint.name in owners:
            key = "axes" if joint.axes is not None else "markers"
            message = (
                f"the axes of its two markers are parallel here, and a {joint.type} joint needs them at an angle: turn one of them, e.g. "
                f"`axes: [[0, 1, 0], [0, 0, 1]]`"
            )
            faults.append(Fault.at(f"joints.{joint.name}.{key}", message))
    refuse(faults)


def _distance(system: System, k: int) -> float:
    """Between the points of the two markers of joint k [m]."""
    record = system.record
    first = int(record.joints.first_marker[k])
    return float(np.linalg.norm(record.markers.r[first + 1] - record.markers.r[first]))


# Axes that differ by more than this [rad] are meant to.
MEANT = 0.01


def refuse_tilted_axes(machine: MachineRecord, motion: MotionEquations) -> None:
    """Refuse an axis that differs from others by more than the tolerance of the machine, and by that takes a degree of freedom from it.

    Raises ModelError with one message: the joint, its axis, and the angle.
    """
    tilts = tilted_axes(machine, MEANT)
    if not tilts:
        return
    setting = machine.assembly.replace(parallel=MEANT)
    straight = equations(machine.model_copy(update={"assembly": setting}))
    if straight.evaluate(0.0, straight.system.start)[0] == OK and _certainly_independent(straight):
        return
    if _freedoms(machine, motion) >= _freedoms(machine, straight):
        return
    first = tilts[0]
    joint = next(joint for joint in machine.joints if joint.name == first.joint)
    key = "axis" if joint.axis is not None else "markers"
    also = "".join(f"; that of {tilt.joint} by {tilt.angle:.3g} rad" for tilt in tilts[1:])
    others = ", ".join(first.others)
    message = (
        f"this axis differs by {first.angle:.3g} rad ({np.degrees(first.angle):.3g} deg) from the axes of {others}, to which it has to be "
        f"parallel, or the machine cannot move{also}; write the same axis there, or `assembly: {{parallel: {1.2 * first.angle:.2g} rad}}`, "
        f"which takes them as parallel (now {machine.assembly.parallel:.3g} rad)"
    )
    raise ModelError(Fault.at(f"joints.{first.joint}.{key}", message))


def _freedoms(machine: MachineRecord, motion: MotionEquations) -> int:
    """Degrees of freedom of velocities in the state as given, without drivers."""
    system = motion.system
    driven = {driver.name for driver in machine.drivers}
    joined = [row for row in range(system.machine_rows) if system.row_owner[row] not in driven]
    motion.evaluate(0.0, system.start)
    J = scaled_jacobian(motion)[joined]
    return system.freedoms - len(joined) + (len(dependent_rows(J)[0]) if np.all(np.isfinite(J)) else 0)
