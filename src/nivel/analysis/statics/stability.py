"""Stability of equilibria: whether a machine has stiffness at all, and how a path ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.statics.critical import CriticalPoint, critical_points
from nivel.analysis.statics.equations import StaticEquations, Tangent
from nivel.analysis.statics.linear import NO_STIFFNESS, PivotError, lowest, unstable_directions
from nivel.analysis.statics.newton import EquilibriumError
from nivel.analysis.statics.path import Point, Steps, by_arc_length
from nivel.system.system import Array

# A path that ends is followed on by so many steps, this share of a step long.
LOOKED, SHORT = 40, 0.05


@dataclass(frozen=True)
class Softest:
    """The stiffness next to zero as a share of the largest, and its direction (f,)."""

    share: float
    direction: Array


def softest(tangent: Tangent) -> Softest | None:
    """The direction with the least stiffness of those that all constraints allow; None where nothing can move."""
    size = tangent.K.shape[0]
    if not size:
        return None
    largest = float(np.abs(tangent.K).max())
    try:
        values, vectors = lowest(tangent, 1, tangent.M, nearest=True)
    except PivotError:
        return Softest(0.0, np.zeros(size))
    if not len(values):
        return None
    direction = vectors[:, 0]
    stiffness = abs(float(direction @ (tangent.K @ direction))) / float(direction @ direction)
    return Softest(stiffness / largest if largest > 0.0 else 0.0, direction)


def is_mechanism(found: Softest | None) -> bool:
    """Whether it moves without any resistance."""
    return found is not None and found.share < NO_STIFFNESS


def limit_ahead(equations: StaticEquations, last: Point, steps: Steps) -> CriticalPoint | None:
    """The limit point at which a path that could not be followed by load steps turns back; None where none is near."""
    short = Steps(steps.duration, SHORT * steps.step, steps.iteration, LOOKED)
    before, count = last, unstable_directions(last.found.tangent)
    try:
        for after in by_arc_length(equations, last, short):
            own = unstable_directions(after.found.tangent)
            if own != count:
                return next(iter(critical_points(equations, before, after, (count, own), steps.iteration)), None)
            before = after
    except (EquilibriumError, PivotError):
        pass
    return None
