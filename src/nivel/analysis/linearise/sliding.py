"""Sliding friction at a state: what slides there has a linear model, with the effort of its law of sliding; what holds has none."""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.kernels.elements.friction import (
    ARM,
    COORDINATE,
    COULOMB,
    KINETIC,
    MODEL,
    ONE_WAY,
    OUTPUT,
    ROW,
    STATIC,
    STICTION,
    STRIBECK,
    THIRD,
    TRANSITION,
    VISCOUS,
    WAY,
)
from nivel.kernels.record.record import NONE
from nivel.system.system import Array

# An effort is that of sliding to this share of it. tanh of so much is one to the last bit.
EQUAL, SATURATED = 1e-9, 40.0


def let_slide(motion: MotionEquations, t: float, y: Array) -> frozenset[str]:
    """Give frictions that slide in the state y at t [s] the law of sliding, in place of one that may hold. Returns their names."""
    system, record = motion.system, motion.system.record
    friction, out = record.friction, frozenset[str]()
    if not len(friction.columns) or not motion.holds(t, y):
        return out
    for k, (index, n) in enumerate(zip(friction.columns.tolist(), friction.number, strict=True)):
        if index[MODEL] != STICTION or index[ROW] != NONE:
            continue
        rate, outputs = record.coordinates.rate[index[COORDINATE]], record.outputs.value[index[OUTPUT] :]
        dry = friction.force[k] + n[VISCOUS] * rate
        if index[WAY] == ONE_WAY:
            if not rate > 0.0 or dry != 0.0:
                continue
            n[KINETIC] = n[STATIC] = 0.0  # it runs ahead
        elif not -dry * np.sign(rate) >= (1.0 - EQUAL) * _sliding(n, rate * n[ARM]) * outputs[THIRD] * n[ARM]:
            continue
        friction.columns[k, MODEL], n[TRANSITION] = COULOMB, abs(rate) * n[ARM] / SATURATED
        out |= {system.frictions[k]}
    return out


def _sliding(n: Array, speed: float) -> float:
    """Coefficient of friction of surfaces that slide with a speed."""
    if n[STATIC] == n[KINETIC] or n[STRIBECK] == 0.0:
        return float(n[KINETIC])
    return float(n[KINETIC] + (n[STATIC] - n[KINETIC]) * np.exp(-((speed / n[STRIBECK]) ** 2)))
