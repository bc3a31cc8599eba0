"""The equations of motion over one whole step with flexible bodies, so that energy and momenta are kept.

Rigid bodies as in `nivel.motion.energy_momentum_residual`. Of a flexible one, with ċ of its centre of mass and momenta (Π̄, π) about it,

    m (ċ₁ - ċ₀)/h = F        (A₁ Π̄₁ - A₀ Π̄₀)/h = T        (π₁ - π₀)/h = G + Q

with F, T and Q of the applied forces and of the joints at the mean place and G in place of the velocity forces
(`nivel.kernels.residual.flexible_over_step`), and c, A and p moved by the means of their rates. So F, T and Q do exactly the work by
which the
kinetic energy changes; elastic and damping forces and weight do exactly theirs. Nodes at interfaces meet at one mean place, so momenta are
kept.
What is missed by axes that turn with nodes, by forces on springs, and by G with geometric stiffening is done along the mean motion as
between rigid bodies, where the momenta belonging to that motion are those of the modes too.
"""

from __future__ import annotations

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.bodies.floating_dynamics import gather_frames
from nivel.kernels.bodies.floating_frame import bend_body, modes_of
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, family
from nivel.kernels.record.record import record_at
from nivel.kernels.residual.flexible_over_step import (
    balance_modes,
    central_momentum,
    load_mean_modes,
    mean_frame,
    mean_inertia_force,
    modal_elastic_energy,
    note_central_inertia,
)
from nivel.kernels.residual.shared_over_step import change_shared_momenta
from nivel.motion.energy_momentum_residual import (
    STEP,
    balance_bodies,
    change_momentum,
    close_end,
    first_rate,
    half_turn,
    mean_forces,
    move_to_mean,
    push,
)
from nivel.motion.floating_frame import read_flexible_state
from nivel.native.function import stage


@stage
def change_flexible_momentum(machine, f, h):
    """Bring flexible body f from the end of the step to its mean place and mean rates, without the frames at its interfaces; its velocities
    and modal rates at the end are written into the state, the change of its momenta per second into `residual.acceleration` (angular about
    the centre of mass; linear) and, less G, into the rows of its modes."""
    record = record_at(machine)
    bodies, flexible, own, base = record.bodies, record.flexible, record.residual, record.newton.base
    count, b, interval, y = bodies.mass.shape[0], flexible.body[f], own.interval, own.y
    first, n = modes_of(flexible, f)
    q, v, p, rate = 7 * b, first_rate(record) + 6 * b, 7 * count + first, first_rate(record) + 6 * count + first
    A, start, m, x, rows = bodies.A[b], interval.start[b], bodies.mass[b], own.acceleration[b], own.value[6 * count :]
    k = half_turn(base[q + 3 : q + 7], y[q + 3 : q + 7])
    w0 = base[v + 3], base[v + 4], base[v + 5]
    w1 = 4.0 * k[0] / h - w0[0], 4.0 * k[1] / h - w0[1], 4.0 * k[2] / h - w0[2]
    for j in range(n):
        flexible.pdot[first + j] = 2.0 * (y[p + j] - base[p + j]) / h - base[rate + j]
        y[rate + j] = flexible.pdot[first + j]
    V, momentum = central_momentum(m, flexible, f, w1)
    missed = real(dot(w0, momentum) - dot((start[9], start[10], start[11]), w1))
    for j in range(n):
        missed += real(base[rate + j] * flexible.pddot[first + j] - interval.modal[first + j] * y[rate + j])
        rows[first + j] = (flexible.pddot[first + j] - interval.modal[first + j]) / h
    for i in range(3):
        end = bodies.R[b, i] + bodies.c[b, i]
        u = (end - start[i]) / h
        y[v + i], y[v + 3 + i] = 2.0 * u - start[3 + i] + dot(A[i], V), w1[i]
        x[i] = (dot(A[i], momentum) - start[6 + i]) / h
        x[3 + i] = m * 2.0 * (u - start[3 + i]) / h
        # from the mean place of the frame's origin
        bodies.c[b, i] = 0.5 * (end + start[i] - y[q + i] - base[q + i])
    arm = bodies.c[b, 0], bodies.c[b, 1], bodies.c[b, 2]
    move_to_mean(machine, b, k, h)
    for j in range(n):
        flexible.p[first + j] = 0.5 * (y[p + j] + base[p + j])
        flexible.pdot[first + j] = (y[p + j] - base[p + j]) / h
    bend_body(bodies, flexible, f)
    for i in range(3):
        bodies.c[b, i] = arm[i]
    power = mean_inertia_force(m, flexible, f, w0, w1, base, y, rate, rows[first : first + n])
    interval.defect[f] = power - 0.5 * missed / h
    note_central_inertia(machine, f, h)


@family
def residual(machine, job, t):
    """Fill `residual.value` for the state `residual.y` at the end t of a step; see `nivel.motion.energy_momentum_residual`."""
    record = record_at(machine)
    bodies, flexible, own = record.bodies, record.flexible, record.residual
    h, count = own.interval.numbers[STEP], bodies.mass.shape[0]
    status = read_flexible_state(machine, t, own.y)
    if status == OK:
        status = apply_forces(machine, t, own.y)
    if status != OK:
        return status
    stored = real(record.control.stored[0]) + modal_elastic_energy(flexible)
    close_end(machine)
    for b in range(count):
        if flexible.rigid[b] == 1:
            change_momentum(machine, b, h)
    change_shared_momenta(machine, first_rate(record), h)
    for f in range(flexible.body.shape[0]):
        change_flexible_momentum(machine, f, h)
    for k in range(flexible.frame.shape[0]):
        mean_frame(machine, k, h)
    status = mean_forces(machine, t - 0.5 * h)
    if status != OK:
        return status
    load_mean_modes(machine)
    gather_frames(machine)
    push(machine, stored)
    balance_bodies(machine)
    balance_modes(machine, h, own.value[6 * count :])
    return OK
