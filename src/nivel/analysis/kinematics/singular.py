"""Singular positions of a driven machine on its way: where the positions may go on along more than one branch.

With as many independent rows as velocities C_q is square. Its determinant changes sign where the machine passes a position in which C_q
is singular, also between two frames; at a turning point of a driver the machine stops instead.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr

from nivel.analysis.assembly.redundancy import scaled_jacobian
from nivel.analysis.preparation.preparation import Prepared
from nivel.errors import ModelError
from nivel.lazy import dataclass
from nivel.results.motion import rotation_matrices
from nivel.results.result import Result
from nivel.system.system import Array, System

# positions that are looked at, at most, evenly over the frames
LOOKED_AT = 72
# rows take part with at least this share of the one that does most
TAKES_PART = 0.3


@dataclass(frozen=True)
class Singularity:
    """passed : pairs of times [s] between which the determinant changes sign. least : the smallest singular value, as a share of that at
    the start, at `time` [s]; joints : whose rows depend on each other most there."""

    passed: tuple[tuple[float, float], ...]
    least: float
    time: float
    joints: tuple[str, ...]


@dataclass(frozen=True)
class MovingState:
    """time [s], the state y, the accelerations v̇ (n,) of the bodies, and all joint coordinates; none where the motion has other ones."""

    time: float
    y: Array
    vdot: Array
    coordinates: Array


def moving_states(system: System, result: Result, every: int = 1) -> Iterator[MovingState]:
    """Every so many frames of a result of a machine with the same bodies. Raises ModelError where bodies differ."""
    names = list(result.coordinates.get("body", ()))
    if names != list(system.bodies):
        raise ModelError(f"the motion has the bodies {', '.join(names)}, the machine {', '.join(system.bodies)}")
    missing = [name for name in ("acceleration", "angular_acceleration", "velocity") if name not in result.variables]
    if missing:
        raise ModelError(f"the motion has no {', '.join(missing)}: give a result of a run or of kinematics")
    some = slice(None, None, every)
    position, orientation = result.array("position")[some], result.array("orientation")[some]
    rates = [
        result.array(name)[some] for name in ("velocity", "angular_velocity", "acceleration", "angular_acceleration")
    ]
    states = [
        result.array(f"state.{fact.name}")[some] if f"state.{fact.name}" in result.variables else None
        for fact in system.states
    ]
    known = list(result.coordinates.get("joint_coordinate_name", ())) == list(
        system.layout.coordinates["joint_coordinate"]
    )
    measured = known and "joint_coordinate" in result.variables
    angles = result.array("joint_coordinate")[some] if measured else np.zeros((len(position), 0))
    for k, time in enumerate(result.time[some]):
        A = rotation_matrices(orientation[k])
        velocity, omega, acceleration, alpha = (each[k] for each in rates)
        local = [np.einsum("bij,bi->bj", A, each) for each in (omega, alpha)]
        q = np.hstack([position[k], orientation[k]]).ravel()
        y = system.state(q, velocity, local[0])
        first = len(y) - len(system.start_of_states)
        for j, values in enumerate(states):
            if values is not None:
                y[first + j] = values[k]
        yield MovingState(float(time), y, np.hstack([acceleration, local[1]]).ravel(), angles[k])


def singular_positions(prepared: Prepared, result: Result) -> Singularity | None:
    """What a result of kinematics comes to; None for machines without constraints."""
    motion, rank = prepared.absolute, prepared.redundancy.rank
    system = motion.system
    if not rank or not len(result.time):
        return None
    every = max(1, -(-len(result.time) // LOOKED_AT))
    sizes, times, passed = [], [], []
    before: tuple[NDArray[np.intp], float] | None = None
    lost, least = np.zeros((0, 0)), np.inf
    for state in moving_states(system, result, every):
        motion.evaluate(state.time, state.y)
        rows = scaled_jacobian(motion)
        rows = rows[:, np.abs(rows).max(axis=0, initial=0.0) > 0.0] if system.point_masses.any() else rows
        size = float(np.linalg.svd(rows, compute_uv=False)[rank - 1])
        if before is not None and before[1] * determinant_sign(rows[before[0]]) < 0.0:
            passed.append((times[-1], state.time))
        kept = independent_rows(rows, rank)
        before = (kept, determinant_sign(rows[kept]))
        sizes.append(size)
        times.append(state.time)
        if size < least:
            least, lost = size, rows
    share = np.abs(np.linalg.svd(lost)[0][:, rank - 1])
    owners = dict.fromkeys(system.row_owner[row] for row in np.flatnonzero(share >= TAKES_PART * share.max()))
    k = int(np.argmin(sizes))
    return Singularity(tuple(passed), sizes[k] / sizes[0] if sizes[0] > 0.0 else 0.0, times[k], tuple(owners))


def independent_rows(rows: Array, rank: int) -> NDArray[np.intp]:
    """Rows that are well apart here: others may be so elsewhere, where constraints repeat each other."""
    pivoted: Any = qr(rows.T, mode="r", pivoting=True)
    return np.sort(pivoted[1][:rank])


def determinant_sign(rows: Array) -> float:
    """Of the determinant; 0 where motions are free."""
    return float(np.linalg.slogdet(rows)[0]) if rows.shape[0] == rows.shape[1] else 0.0
