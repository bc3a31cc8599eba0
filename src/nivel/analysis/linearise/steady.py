"""Steadiness of the linear equations while the machine moves: only then their eigenvalues describe the motion.

A machine in equilibrium stays; one in steady motion passes other positions with the same A; anything else has an A(t), as has a body that
spins where its turns are measured about its own axes.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.instant import Instant
from nivel.kernels.core.status import OK
from nivel.system.system import Array

# shares of scales below which a machine is at rest, and in equilibrium
REST, BALANCE = 1e-9, 1e-6
# A may change by this share of the largest entry of a row, and round-off changes it by this share of the largest of all
SAME, ROUND_OFF = 1e-7, 1e-12
# the machine is looked at again after turns and ways of so many radians and lengths, by steps of this size
LATER, STEP = (0.7, 1.9), 4e-3


def is_at_rest(instant: Instant) -> bool:
    """Whether nothing moves, for the time scale of its accelerations."""
    own = instant
    speed = np.abs(own.y[own.positions : own.first_state] / own.length)
    return bool(
        np.max(speed, initial=0.0) <= REST * max(1.0, np.sqrt(np.max(np.abs(own.vdot / own.length), initial=0.0)))
    )


def acceleration_of(instant: Instant) -> Array:
    """(n,) accelerations in lengths of the machine and radians."""
    return np.abs(instant.vdot / instant.length)


def keeps_its_equations(
    motion: MotionEquations, instant: Instant, find: Callable[[float, Array], Array | None]
) -> bool:
    """Whether A, which `find` makes of a time and a state, is the same at two later moments of the motion.

    motion : equations that can be evaluated, in the coordinates of the instant.
    """
    own = instant
    speed = float(np.max(np.abs(own.y[own.positions : own.first_state] / own.length), initial=0.0))
    first = find(own.t, own.y)
    t, y = own.t, own.y.copy()
    if first is None or speed == 0.0:
        return False
    allowed = SAME * np.abs(first).max(axis=1, keepdims=True) + ROUND_OFF * np.abs(first).max(initial=0.0)
    for until in LATER:
        moved = _advanced(motion, t, y, own.t + until / speed, STEP / speed)
        if moved is None:
            return False
        t, y = moved
        later = find(t, y)
        if later is None or later.shape != first.shape or np.any(np.abs(later - first) > allowed):
            return False
    return True


@np.errstate(over="ignore", invalid="ignore")  # of stiff machines, whose motion these steps do not follow
def _advanced(motion: MotionEquations, t: float, y: Array, end: float, step: float) -> tuple[float, Array] | None:
    """(t, y) at `end` by the classical Runge–Kutta method; None where the motion cannot be evaluated."""
    count = max(1, int(np.ceil((end - t) / step)))
    h = (end - t) / count
    for _ in range(count):
        slopes: list[Array] = []
        for share in (0.0, 0.5, 0.5, 1.0):
            at = y + share * h * slopes[-1] if slopes else y
            status, rate = motion.evaluate(t + share * h, at)
            if status != OK:
                return None
            slopes.append(rate)
        y = y + h / 6.0 * (slopes[0] + 2.0 * slopes[1] + 2.0 * slopes[2] + slopes[3])
        t += h
    return (t, y) if np.isfinite(y).all() else None
