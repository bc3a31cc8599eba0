"""What bodies and modes of a machine with flexible bodies need for given accelerations, in the residual of coordinates of single bodies."""

from __future__ import annotations

from nivel.kernels.compile import stage
from nivel.kernels.floating_dynamics import flexible_wrench, gather
from nivel.kernels.floating_frame import move_frames
from nivel.kernels.hook import apply_forces, call_hook
from nivel.kernels.record import POINTS, record_at
from nivel.kernels.residual import inertial_wrenches, load_multipliers
from nivel.kernels.rigid import load_weight
from nivel.kernels.status import OK


@stage
def find_flexible_wrenches(machine, t, first):
    """`residual.wrench` of all bodies for the state read and `residual.acceleration`, and the rows of the modes, which stand from `first`
    on as their accelerations do in `residual.vdot`. Returns a status."""
    record = record_at(machine)
    bodies, flexible, own = record.bodies, record.flexible, record.residual
    load_weight(bodies)
    status = apply_forces(machine, t, own.y)
    if status != OK:
        return status
    for j in range(flexible.p.shape[0]):
        flexible.pddot[j] = own.vdot[first + j]
    move_frames(machine)
    status = load_multipliers(machine, t)
    if status == OK:
        status = call_hook(machine, POINTS, 0, t)
    if status != OK:
        return status
    gather(machine)
    inertial_wrenches(machine)
    for f in range(flexible.body.shape[0]):
        flexible_wrench(bodies, flexible, f, own.acceleration, own.wrench, own.value[first:])
    return OK
