"""Stability of equilibria: whether a machine has stiffness at all, and how a path ends."""

from __future__ import annotations

from typing import Final

import numpy as np

from nivel.analysis.assembly.freedoms import Freedoms
from nivel.analysis.statics.critical import CriticalPoint, critical_points
from nivel.analysis.statics.equations import Rest, StateError, StaticEquations, Tangent
from nivel.analysis.statics.frames import FrameWriter
from nivel.analysis.statics.linear import NO_STIFFNESS, PivotError, is_small, lowest, unstable_directions
from nivel.analysis.statics.newton import EquilibriumError
from nivel.analysis.statics.path import Point, Steps, by_arc_length
from nivel.lazy import dataclass
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


LOOSE: Final = 1e-12  # stiffness below this share of the largest counts as none
STILL: Final = 1e-6  # rate of a coordinate in a motion of unit size below which it rests


def loose_coordinates(equations: StaticEquations, state: Rest) -> tuple[str, ...]:
    """Those that, held, leave no motion of this equilibrium without stiffness that a joint coordinate shows. None of large machines."""
    try:
        tangent = equations.tangent(state)
        if not is_small(tangent):
            return ()
        Z = tangent.free_directions
        stiffness = Z.T @ (tangent.K @ Z)
        size = float(np.abs(tangent.K).max()) if tangent.K.nnz else 0.0
        values, vectors = np.linalg.eigh(0.5 * (stiffness + stiffness.T))
        loose = (Z @ vectors[:, np.abs(values) <= LOOSE * size]).T
        rates = FrameWriter(equations, 0).rates(state, loose)
    except (StateError, PivotError, np.linalg.LinAlgError):
        return ()
    return _independent(rates, equations.system.layout.coordinates["joint_coordinate"])


def _independent(rates: Array, labels: tuple[str, ...]) -> tuple[str, ...]:
    """rates (k, n) : of n joint coordinates in k motions."""
    rates = np.where(np.abs(rates) > STILL, rates, 0.0)
    return tuple(labels[k] for k in Freedoms(np.eye(len(rates))).independent(rates.T))
