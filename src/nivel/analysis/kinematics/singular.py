"""Singular positions of a driven machine on its way: where the positions may go on along more than one branch.

With as many independent rows as velocities C_q is square. Its determinant changes sign where the machine passes a position in which C_q
is singular, also between two frames; at a turning point of a driver the machine stops instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr

from nivel.analysis.assembly.redundancy import scaled_jacobian
from nivel.analysis.kinematics.states import moving_states
from nivel.analysis.preparation.preparation import Prepared
from nivel.results.result import Result
from nivel.system.system import Array

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
