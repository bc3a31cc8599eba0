"""Indeterminate friction: several frictions hold one motion at rest; what they hold it with together is known, their shares are not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.results.trust.held import Shared, spans_of, still
from nivel.results.trust.scales import Readable

# A coordinate that sticks is not exactly at rest: what changes of its load leave it is slower than this share of what `still` asks for.
RESTING = 1e-6
# An effort below the greatest one by more than this share of it is that of a friction that sticks.
WITHIN = 1e-6
# A motion of which no more than this share is left beside others follows from them.
LEFT = 1e-7


@dataclass(frozen=True)
class Sticking:
    """A friction with stiction on a joint coordinate that may move.

    left : (n,) unit direction of the coordinate's derivative in the motions that the constraints allow. static : its greatest effort at
    rest over its normal load [- or m]. viscous : effort per rate.
    """

    friction: str
    coordinate: str
    left: NDArray[np.float64]
    static: float
    viscous: float


@np.errstate(over="ignore", invalid="ignore")  # of a run that grew beyond all bounds
def loads_held_together(result: Readable, frictions: Sequence[Sticking]) -> tuple[Shared, ...]:
    """Frictions that hold one motion at rest together, over two frames or more.

    A friction that sticks has an effort below its greatest one, so of frictions that stick, where the motion of one follows from those of
    the others, each may give up something to the others. One that has come to its greatest effort and does not move may too.
    """
    if len(frictions) < 2:
        return ()
    left = np.array([each.left for each in frictions])
    rests, sticks = _holding(result, frictions)
    out: dict[tuple[int, ...], NDArray[np.bool_]] = {}
    patterns, of_frame = np.unique(np.concatenate([rests, sticks], axis=1), axis=0, return_inverse=True)
    for k, pattern in enumerate(patterns):
        for group in _groups(left, *np.split(pattern, 2)):
            out.setdefault(group, np.zeros(len(rests), dtype=bool))[of_frame.ravel() == k] = True
    found = []
    for group, frames in out.items():
        spans = spans_of(result.time, frames)
        if spans:
            names = tuple(frictions[k].friction for k in group)
            coordinates = tuple(dict.fromkeys(frictions[k].coordinate for k in group))
            found.append(Shared(names, coordinates, tuple(f"force.{name}.magnitude" for name in names), spans))
    return tuple(found)


def _holding(result: Readable, frictions: Sequence[Sticking]) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """(frames, frictions) which rest under a load, and which of them stick."""
    rests, sticks = [], []
    coordinates, rates = result.coordinates[result.variables["joint_rate"].dims[1]], result.array("joint_rate")
    for each in frictions:
        rate = rates[:, coordinates.index(each.coordinate)]
        largest = each.static * result.array(f"force.{each.friction}.normal_load")
        effort = np.abs(result.array(f"force.{each.friction}.magnitude") + each.viscous * rate)
        resting = still(result, each.coordinate, RESTING) & (largest > 0.0)
        rests.append(resting)
        sticks.append(resting & (effort < (1.0 - WITHIN) * largest))
    return np.array(rests).T, np.array(sticks).T


def _groups(left: NDArray[np.float64], rests: NDArray[np.bool_], sticks: NDArray[np.bool_]) -> list[tuple[int, ...]]:
    """Frictions whose efforts may change together without changing what they do, in groups that have nothing to do with each other."""
    held = _basis(left[sticks])
    beside = np.linalg.norm(left - left @ held.T @ held, axis=1)
    chosen = np.flatnonzero(sticks | (rests & (beside < LEFT)))
    if not len(chosen):
        return []
    _, size, every = np.linalg.svd(left[chosen].T)
    free = every[int(np.sum(size > LEFT)) :]
    # of the projection onto the changes that do nothing, the columns of two groups are perpendicular
    together = np.abs(free.T @ free) > LEFT
    groups: dict[tuple[int, ...], None] = {}
    for k in range(len(chosen)):
        if together[k, k]:
            groups[tuple(int(chosen[m]) for m in _connected(together, k))] = None
    return list(groups)


def _connected(together: NDArray[np.bool_], start: int) -> NDArray[np.intp]:
    """Whatever `start` is together with, by way of others too."""
    reached = together[start]
    while not np.array_equal(further := together[reached].any(axis=0), reached):
        reached = further
    return np.flatnonzero(reached)


def _basis(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Orthonormal rows that span the same."""
    if not len(rows):
        return rows
    _, size, every = np.linalg.svd(rows, full_matrices=False)
    return every[size > LEFT]
