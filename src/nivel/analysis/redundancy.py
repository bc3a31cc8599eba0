"""Which constraint rows depend on the others, which reactions are therefore not unique, and how many freedoms are left."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.closing import close_positions
from nivel.analysis.equations import MotionEquations, change_between, moved
from nivel.analysis.modal_rows import ModalRows
from nivel.kernels.status import OK
from nivel.system.system import Array

# Rows count as dependent below this share of their length: assembled machines are closed to about 1e-12.
DEPENDENT = 1e-8
# Pivots of S above this share of their diagonal prove independence without a closer look.
CERTAIN = 1e-9
# Two positions this far apart (share of the machine's length, radians) tell a singular position from a redundant machine.
ASIDE = 1e-3


@dataclass(frozen=True)
class Redundancy:
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


def analyse(motion: MotionEquations, t: float, y: Array, modes: ModalRows | None = None) -> Redundancy:
    """Rank of the constraints at state y, which must be assembled; `modes` : of bodies that bend, undeformed at y."""
    system = motion.system
    rows = system.machine_rows
    freedoms = system.freedoms + (modes.count if modes is not None else 0)
    if motion.evaluate(t, y)[0] == OK and _certainly_independent(motion):
        return Redundancy(freedoms - rows, freedoms - rows + len(system.velocity_rows), rows, (), (), ())
    J = scaled_jacobian(motion, modes)
    rank, dependent = _dependent_rows(J)
    holding = np.delete(J, sorted(system.velocity_rows), axis=0)
    positions = freedoms - (_dependent_rows(holding)[0] if len(holding) < len(J) else rank)
    if not dependent:
        return Redundancy(freedoms - rows, positions, rows, (), (), ())
    nearby = _rank_nearby(motion, t, y, rank, modes)
    names = tuple(system.rows[row] for row in dependent)
    U, _, _ = np.linalg.svd(J)
    loose = np.abs(U[:, rank:]).max(axis=1) > 1e-6
    joints = dict.fromkeys(system.row_owner[row] for row in np.flatnonzero(loose))
    return Redundancy(
        freedoms - rank,
        positions,
        rank,
        names,
        tuple(joints),
        names[: nearby - rank] if nearby > rank else (),
    )


def _certainly_independent(motion: MotionEquations) -> bool:
    saddle = motion.system.record.saddle
    if not len(saddle.order):
        return True
    diagonal = saddle.S[saddle.S_start[1:].astype(int) - 1]
    return bool(np.all(saddle.Dinv * diagonal < 1.0 / CERTAIN))


def scaled_jacobian(motion: MotionEquations, modes: ModalRows | None = None) -> Array:
    """C_q with lengths in units of the machine's length and rows of unit length; the columns of modes behind the others."""
    J = motion.jacobian().reshape(motion.system.machine_rows, -1, 6).copy()
    J[:, :, :3] *= motion.system.size
    J = J.reshape(len(J), -1)
    if modes is not None:
        J = np.hstack([J, modes.columns(motion)])
    return J / np.linalg.norm(J, axis=1, keepdims=True)


def _dependent_rows(J: Array) -> tuple[int, list[int]]:
    """Rank of J (unit rows), and the rows that depend on the rows before them."""
    rank = int(np.sum(np.linalg.svd(J, compute_uv=False) > DEPENDENT))
    basis = np.zeros((0, J.shape[1]))
    left = np.zeros(len(J))
    for k, row in enumerate(J):
        rest = row - basis.T @ (basis @ row)
        rest -= basis.T @ (basis @ rest)
        left[k] = np.linalg.norm(rest)
        if left[k] > np.sqrt(DEPENDENT) and len(basis) < rank:
            basis = np.vstack([basis, rest / left[k]])
    missing = len(J) - rank
    return rank, sorted(np.argsort(left, kind="stable")[:missing].tolist())


def _rank_nearby(motion: MotionEquations, t: float, y: Array, rank: int, modes: ModalRows | None) -> int:
    """Rank a little aside along a free motion of the rigid machine, joints closed again: larger than `rank` where only this position is
    singular."""
    system = motion.system
    _, sizes, Vt = np.linalg.svd(scaled_jacobian(motion))
    free = Vt[int(np.sum(sizes > DEPENDENT)) :]
    if not len(free):
        return rank
    share = np.random.default_rng(0).standard_normal(len(free))
    share *= ASIDE / np.linalg.norm(share)
    change = (free.T @ share).reshape(-1, 6)
    change[:, :3] *= system.size
    aside = y.copy()
    aside[: system.positions] = moved(y[: system.positions], change.ravel())
    opened = aside[: system.positions].copy()
    # without closing, the open joints alone would make redundant rows look independent
    closed = close_positions(motion, t, aside)
    reached = change_between(y[: system.positions], aside[: system.positions])
    reached[:, :3] /= system.size
    if not closed or np.linalg.norm(free @ reached.ravel() - share) > 0.1 * ASIDE:
        # a motion of the first order only, as of two links stretched out between two pins: closing leads back
        aside[: system.positions] = opened
        motion.evaluate(t, aside)
    return max(rank, int(np.sum(np.linalg.svd(scaled_jacobian(motion, modes), compute_uv=False) > ASIDE**2)))
