"""The residual of the Newton–Euler equations in absolute coordinates: rows of (Ṙ, ω̄) of every body."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.kernels.residual.residual import find_wrenches, write_rows
from nivel.motion.newton_euler import read_state


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual.residual`."""
    record = record_at(machine)
    bodies, own = record.bodies, record.residual
    count = bodies.mass.shape[0]
    status = read_state(machine, t, own.y)
    if status != OK:
        return status
    for b in range(count):
        A, x, v = bodies.A[b], own.acceleration[b], own.vdot[6 * b : 6 * b + 6]
        for i in range(3):
            x[i] = A[i, 0] * v[3] + A[i, 1] * v[4] + A[i, 2] * v[5]
            x[3 + i] = v[i]
    status = find_wrenches(machine, t)
    if status != OK:
        return status
    for b in range(count):
        A, F = bodies.A[b], own.wrench[b]
        for i in range(3):
            own.value[6 * b + i] = F[3 + i]
            own.value[6 * b + 3 + i] = A[0, i] * F[0] + A[1, i] * F[1] + A[2, i] * F[2]
    write_rows(machine, 6 * count)
    return OK
