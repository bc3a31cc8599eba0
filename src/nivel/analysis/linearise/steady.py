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
# A may change by this share of the largest entry of a row while the machine turns by one radian, and round-off by this share of all
SAME, ROUND_OFF = 1e-4, 1e-12
# changes of an entry by less than this share of the largest of its row are round-off, as of what stays the same
ROUNDED = 1e-14
# the machine is looked at again after turns and ways of so many radians and lengths, by steps of this size at most
LATER, STEP = (0.7, 1.9), 4e-3
# what grows is not awaited for longer than so many of its time constants: it leaves a steady motion by the last digit that was given
GROWN = 1.0
# the fastest motion is followed by steps of this share of its time constant, and by so many steps
FOLLOWED, MOST_STEPS = 0.2, 1500


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


def drift(motion: MotionEquations, instant: Instant, find: Callable[[float, Array], Array | None]) -> Array | None:
    """How A, which `find` makes of a time and a state, changes until two later moments of the motion, entry by entry; None where it is not
    the same there.

    motion : equations that can be evaluated, in the coordinates of the instant. The sooner the moments have to be, the less A may change.
    """
    own = instant
    speed = float(np.max(np.abs(own.y[own.positions : own.first_state] / own.length), initial=0.0))
    first = find(own.t, own.y)
    if first is None or speed == 0.0 or not first.size:
        return first
    t, y = own.t, own.y.copy()
    step, last = _times(first, speed)
    row, whole = np.abs(first).max(axis=1, keepdims=True), np.abs(first).max()
    changed = np.zeros_like(first)
    for until in np.array(LATER) * last:
        moved = _advanced(motion, t, y, own.t + until, step)
        if moved is None:
            return None
        t, y = moved
        later = find(t, y)
        if later is None or later.shape != first.shape:
            return None
        changed = np.maximum(changed, np.abs(later - first))
        if np.any(changed > SAME * speed * last * row + ROUND_OFF * whole):
            return None
    return np.where(changed > ROUNDED * row, changed, 0.0)


def _times(A: Array, speed: float) -> tuple[float, float]:
    """(step, time) [s] to follow the motion by, and in which it makes a turn of one radian or a way of one length, or what of that can be
    followed: without an instability that grows, and with steps that are few."""
    values = np.linalg.eigvals(A)
    growth, fastest = float(np.max(values.real, initial=0.0)), float(np.max(np.abs(values), initial=0.0))
    last = 1.0 / max(speed, LATER[-1] * growth / GROWN)
    step = min(STEP / speed, FOLLOWED / fastest) if fastest > 0.0 else STEP / speed
    return step, min(last, MOST_STEPS * step / LATER[-1])


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
