"""The residual of the Lagrange equations in three rotation coordinates with flexible bodies: rows of (Ṙ, φ̇) of every body, then of the
modes."""

from __future__ import annotations

from nivel.kernels.floating_residual import find_flexible_wrenches
from nivel.kernels.hook import family
from nivel.kernels.record import record_at
from nivel.kernels.status import OK
from nivel.motion.floating_lagrange_three import read_flexible_state
from nivel.motion.lagrange_three_residual import accelerate_bodies, write_bodies


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual`."""
    record = record_at(machine)
    first = 6 * record.bodies.mass.shape[0]
    status = read_flexible_state(machine, t, record.residual.y)
    if status == OK:
        accelerate_bodies(machine)
        status = find_flexible_wrenches(machine, t, first)
    if status == OK:
        write_bodies(machine, first + record.flexible.p.shape[0])
    return status
