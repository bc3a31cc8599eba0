"""Joint coordinates that may be named free: those whose motions have no stiffness in an equilibrium."""

from __future__ import annotations

from typing import Final

import numpy as np

from nivel.analysis.assembly.freedoms import Freedoms
from nivel.analysis.statics.equations import Rest, StateError, StaticEquations
from nivel.analysis.statics.frames import FrameWriter
from nivel.analysis.statics.linear import PivotError, is_small
from nivel.system.system import Array

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
