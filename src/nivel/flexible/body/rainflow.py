"""Rainflow counting of a history of stress. ASTM E1049-85 (2017), section 5.4.4."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, order=True)
class Cycle:
    """A counted cycle: its `range` and `mean` in the unit of the history, and `count`, 1 or ½."""

    range: float
    mean: float
    count: float


def reversals(history: Array) -> Array:
    """The values where the history turns, its first and last included."""
    values = np.asarray(history, dtype=float)
    if len(values) == 0:
        return values
    values = values[np.concatenate([[True], np.diff(values) != 0.0])]
    if len(values) < 3:
        return values
    slope = np.diff(values)
    turns = np.concatenate([[True], slope[:-1] * slope[1:] < 0.0, [True]])
    return values[turns]


def rainflow(history: Array) -> list[Cycle]:
    """Cycles of a history, in the order in which they are found; what is left at the end counts as halves."""
    cycles: list[Cycle] = []
    points: list[float] = []
    for value in reversals(history):
        points.append(float(value))
        while len(points) >= 3:
            last, before = abs(points[-1] - points[-2]), abs(points[-2] - points[-3])
            if last < before:
                break
            if len(points) == 3:  # `before` holds the start of the history
                cycles.append(_cycle(points[0], points[1], 0.5))
                points.pop(0)
            else:
                cycles.append(_cycle(points[-3], points[-2], 1.0))
                del points[-3:-1]
    cycles += [_cycle(a, b, 0.5) for a, b in pairwise(points)]
    return cycles


def _cycle(first: float, second: float, count: float) -> Cycle:
    return Cycle(abs(second - first), 0.5 * (first + second), count)


def counted(cycles: list[Cycle]) -> dict[float, float]:
    """Number of cycles by their range, ascending."""
    out: dict[float, float] = {}
    for each in sorted(cycles):
        out[each.range] = out.get(each.range, 0.0) + each.count
    return out
