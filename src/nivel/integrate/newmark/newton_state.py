"""The state as a function of the unknowns of an implicit method: accelerations v̇ at the end of a step, and rates ẋ.

    q = base ∘ exp(turn + cq v̇ + correction)        v = speed + cv v̇        x = state + cx ẋ

Positions whose rates are velocities, rotation coordinates among them, are base + turn + cq v̇ + correction.

In independent coordinates these formulas of the method hold for the independent velocities, and for what these move, alone: all other
positions, velocities and accelerations follow from C = 0, Ċ = 0 and C̈ = 0. A body of which some turns are dependent stands where the
formula puts it, but for a small turn about its dependent axes.
"""

import numpy as np

from nivel.kernels.algebra.rotation import product
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.algebra.trigonometry import cosine_and_sine
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import DEPENDENT, NONE, record_at
from nivel.native.function import leaf


@leaf
def turn_by(theta, psi, out):
    """θ of A(θ) exp(ψ̃): four Euler parameters after a rotation vector ψ in the turned axes."""
    square = dot(psi, psi)
    half = 0.5 * np.sqrt(square)
    c, sine = cosine_and_sine(half)
    s = 0.5 * sine / half if half > 1e-4 else 0.5 - half * half / 12.0
    product(theta, (c, s * psi[0], s * psi[1], s * psi[2]), out)


@leaf
def set_state(machine, cq, cv, cx):
    """`residual.y` of the unknowns."""
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    y, base, vdot = residual.y, newton.base, residual.vdot
    n, states = vdot.shape[0], newton.state.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    for k in range(n):
        newton.change[k] = newton.turn[k] + cq * vdot[k] + newton.correction[k]
        y[positions + k] = newton.speed[k] + cv * vdot[k]
    for k in range(n):
        p = np.int64(newton.place[k, 0])
        if newton.place[k, 1] == NONE:
            y[p] = base[p] + newton.change[k]
        elif newton.place[k, 1] == 0:
            turn_by(base[p : p + 4], newton.change[k : k + 3], y[p : p + 4])
    for k in range(states):
        y[positions + n + k] = newton.state[k] + cx * newton.rate[k]


@leaf
def find_state(machine, t, cq, cv, cx):
    """`residual.y` of the unknowns at time t; in independent coordinates with all that depends on them, `residual.vdot` too. Returns a
    status."""
    set_state(machine, cq, cv, cx)
    return call_hook(machine, DEPENDENT, 0, t) if record_at(machine).newton.level[0] == 0 else OK
