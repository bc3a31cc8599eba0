"""The residual in absolute coordinates with flexible bodies: rows of (Ṙ, ω̄) of every body, then of the modes."""

from __future__ import annotations

from nivel.kernels.algebra.spatial import multiply
from nivel.kernels.bodies.floating_dynamics import flexible_wrench, gather
from nivel.kernels.bodies.floating_frame import move_frames
from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, call_hook, family
from nivel.kernels.record.record import POINTS, record_at
from nivel.kernels.residual.residual import inertial_wrenches, load_multipliers, write_rows
from nivel.motion.floating_frame import read_flexible_state


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual.residual`."""
    record = record_at(machine)
    bodies, flexible, own = record.bodies, record.flexible, record.residual
    status = read_flexible_state(machine, t, own.y)
    if status != OK:
        return status
    load_weight(bodies)
    status = apply_forces(machine, t, own.y)
    if status != OK:
        return status
    count = bodies.mass.shape[0]
    for b in range(count):
        x, v = own.acceleration[b], own.vdot[6 * b : 6 * b + 6]
        multiply(bodies.A[b], v[3:6], x[:3])
        for i in range(3):
            x[3 + i] = v[i]
    for j in range(flexible.p.shape[0]):
        flexible.pddot[j] = own.vdot[6 * count + j]
    move_frames(machine)
    status = load_multipliers(machine, t)
    if status != OK:
        return status
    status = call_hook(machine, POINTS, 0, t)
    if status != OK:
        return status
    gather(machine)
    inertial_wrenches(machine)
    for f in range(flexible.body.shape[0]):
        flexible_wrench(bodies, flexible, f, own.acceleration, own.wrench, own.value[6 * count :])
    for b in range(count):
        A, F = bodies.A[b], own.wrench[b]
        for i in range(3):
            own.value[6 * b + i] = F[3 + i]
            own.value[6 * b + 3 + i] = A[0, i] * F[0] + A[1, i] * F[1] + A[2, i] * F[2]
    write_rows(machine, 6 * count + flexible.p.shape[0])
    return OK
