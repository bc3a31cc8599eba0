"""The equations of motion over one whole step, in absolute coordinates, so that energy and momenta are kept.

For every body, with the mean velocities u = (c₁ - c₀)/h of its centre of mass and ω = A Θ/h, where A₁ = A₀ cay Θ (Simo, Wong 1991):

    m (ċ₁ - ċ₀)/h = F        (π₁ - π₀)/h = T        ċ₁ = 2 u - ċ₀        ω̄₁ = 2 Θ/h - ω̄₀        π = A J̄ ω̄

so the change of its kinetic energy is h (F · u + T · ω) exactly. F and T, of the applied forces and of the joints, are those at the mean
place, with the axes ½ (A₀ + A₁). A point of the body moves there by h (Ṙ + ω × Ā s) exactly; so constraints that are products of
positions and axes do no work, forces between two bodies have one lever arm, and momenta are kept.

Elastic forces at the mean place do almost the work that their energy loses. The rest is done by a force along the mean motion, in the
metric of the masses (Gonzalez 1996); in a machine that touches no ground along that part of it which carries no momentum. Its factor
is a sum over the whole machine of the size of the step squared, so it stays out of the derivatives: it is made of real parts.

Of a flexible body, with ċ of its centre of mass and momenta (Π̄, π) about it,

    m (ċ₁ - ċ₀)/h = F        (A₁ Π̄₁ - A₀ Π̄₀)/h = T        (π₁ - π₀)/h = G + Q

with F, T and Q of the applied forces and of the joints at the mean place and G in place of the velocity forces
(`nivel.kernels.residual.flexible_over_step`), and c, A and p moved by the means of their rates. So F, T and Q do exactly the work by
which the kinetic energy changes; elastic and damping forces and weight do exactly theirs. Nodes at interfaces meet at one mean place, so
momenta are kept. What is missed by axes that turn with nodes, by forces on springs, and by G with geometric stiffening is done along the
mean motion as between rigid bodies, where the momenta belonging to that motion are those of the modes too.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot, multiply
from nivel.kernels.algebra.vectors import seen
from nivel.kernels.bodies.floating_dynamics import do_flexible, gather_frames
from nivel.kernels.bodies.floating_frame import bend_body, modes_of
from nivel.kernels.bodies.locked_motion import internal_motion, locked_motion
from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, call_hook, family
from nivel.kernels.record.record import MODES, record_at
from nivel.kernels.residual import flexible_over_step
from nivel.kernels.residual.residual import load_multipliers
from nivel.kernels.residual.shared_over_step import begin_shared_interval, change_shared_momenta
from nivel.kernels.solve.flexible_partition import moves_with_modes
from nivel.motion.newton_euler import first_rate, read_markers, read_state
from nivel.native.function import leaf, stage

# entries of StepResidual.numbers
STEP, STORED, LEAST, FREE = 0, 1, 2, 3
# what the hook MODES does besides what it does at an instant
CHANGE, LOAD, BALANCE = 100, 101, 102


@stage
def begin_interval(machine, h, length):
    """Note what the step of size h begins with, from the bodies of the state last evaluated. length : of the machine [m]."""
    record = record_at(machine)
    bodies, interval = record.bodies, record.residual.interval
    total = 0.0
    for b in range(bodies.mass.shape[0]):
        A, J, w, c, start = bodies.A[b], bodies.inertia_b[b], bodies.omega[b], bodies.c[b], interval.start[b]
        turning = cross(w, c)
        for i in range(3):
            start[i] = bodies.R[b, i] + c[i]
            start[3 + i] = bodies.Rdot[b, i] + turning[i]
        w_b = dot(A[:, 0], w), dot(A[:, 1], w), dot(A[:, 2], w)
        momentum = dot(J[0], w_b), dot(J[1], w_b), dot(J[2], w_b)
        for i in range(3):
            start[6 + i] = dot(A[i], momentum)
        total += bodies.mass[b]
    begin_shared_interval(machine)
    flexible_over_step.begin_flexible_interval(machine)
    interval.numbers[STEP], interval.numbers[STORED] = h, record.control.stored[0]
    # motions of less than this share of the machine in a step do no work that could be missed
    interval.numbers[LEAST] = total * (1e-7 * length / h) ** 2


@leaf
def half_turn(e, f):
    """k = Θ/2 of A₀ᵀ A₁ = cay Θ for the Euler parameters e of A₀ and f of A₁, axes of the body."""
    p0 = e[0] * f[0] + e[1] * f[1] + e[2] * f[2] + e[3] * f[3]
    return (
        (e[0] * f[1] - f[0] * e[1] - e[2] * f[3] + e[3] * f[2]) / p0,
        (e[0] * f[2] - f[0] * e[2] - e[3] * f[1] + e[1] * f[3]) / p0,
        (e[0] * f[3] - f[0] * e[3] - e[1] * f[2] + e[2] * f[1]) / p0,
    )


@stage
def move_to_mean(machine, b, k, h):
    """Bring the frame of body b, which has turned by k = Θ/2, from the end of the step to its mean place and mean velocities."""
    record = record_at(machine)
    bodies, y, base = record.bodies, record.residual.y, record.newton.base
    A, q = bodies.A[b], 7 * b
    share = 1.0 / (1.0 + dot(k, k))
    for i in range(3):
        # Ā = A₁ (1 + k̃)⁻¹
        row = A[i, 0], A[i, 1], A[i, 2]
        across, along = cross(k, row), dot(k, row)
        for j in range(3):
            A[i, j] = share * (row[j] + across[j] + along * k[j])
        bodies.Rdot[b, i] = (y[q + i] - base[q + i]) / h
        bodies.R[b, i] = 0.5 * (y[q + i] + base[q + i])
        bodies.omega_b[b, i] = 2.0 * k[i] / h
    for i in range(4):
        # the signs of the Euler parameters at both ends are those of one turn
        bodies.theta[b, i] = 0.5 * (base[q + 3 + i] + y[q + 3 + i])
    multiply(A, bodies.omega_b[b], bodies.omega[b])


@stage
def change_momentum(machine, b, h):
    """Bring body b from the end of the step to its mean place and mean velocities; its velocities at the end are written into the state,
    the change of its momenta per second into `residual.acceleration` (angular about the centre of mass; linear)."""
    record = record_at(machine)
    bodies, own = record.bodies, record.residual
    A, J, c, start, y = bodies.A[b], bodies.inertia_b[b], bodies.c[b], own.interval.start[b], own.y
    base = record.newton.base
    q, v = 7 * b, first_rate(record) + 6 * b
    k = half_turn(base[q + 3 : q + 7], y[q + 3 : q + 7])
    w_b = 4.0 * k[0] / h - base[v + 3], 4.0 * k[1] / h - base[v + 4], 4.0 * k[2] / h - base[v + 5]
    w = dot(A[0], w_b), dot(A[1], w_b), dot(A[2], w_b)
    momentum, turning, x = (dot(J[0], w_b), dot(J[1], w_b), dot(J[2], w_b)), cross(w, c), own.acceleration[b]
    for i in range(3):
        u = (bodies.R[b, i] + c[i] - start[i]) / h
        y[v + i], y[v + 3 + i] = 2.0 * u - start[3 + i] - turning[i], w_b[i]
        x[i] = (dot(A[i], momentum) - start[6 + i]) / h
        x[3 + i] = bodies.mass[b] * 2.0 * (u - start[3 + i]) / h
    move_to_mean(machine, b, k, h)
    multiply(A, bodies.centre_b[b], c)


@stage
def missing_power(machine, stored):
    """What all wrenches do less per second than the energies ask for: elastic energy lost, work brought in, less what is dissipated.

    The weight does exactly the work that it should. stored : elastic energy at the end of the step [J].
    """
    record = record_at(machine)
    bodies, control, numbers = record.bodies, record.control, record.residual.interval.numbers
    power = (numbers[STORED] - stored) / numbers[STEP] + real(control.power[0]) - real(control.power[1])
    g = bodies.gravity
    for b in range(bodies.mass.shape[0]):
        F, V, w = bodies.wrench[b], bodies.Rdot[b], bodies.omega[b]
        turning = cross(w, bodies.c[b])
        for i in range(3):
            power -= real(F[i]) * real(V[i]) + real(F[3 + i]) * real(w[i])
            power += bodies.mass[b] * g[i] * (real(V[i]) + real(turning[i]))
    own, defect = record.flexible, record.residual.interval.defect
    for f in range(own.body.shape[0]):
        power -= defect[f]
        first, n = modes_of(own, f)
        for j in range(n):
            power -= real(own.Q[first + j]) * real(own.pdot[first + j])
    return power


@stage
def push(machine, stored):
    """Add the force along the mean motion that does the work which is missing. stored : see `missing_power`."""
    record = record_at(machine)
    bodies, own, interval = record.bodies, record.flexible, record.residual.interval
    numbers = interval.numbers
    locked = locked_motion(bodies, interval) if numbers[FREE] == 1.0 else (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    twice_kinetic = 0.0
    for b in range(bodies.mass.shape[0]):
        u, w, p, n = internal_motion(bodies, interval, b, locked)
        twice_kinetic += dot(u, p) + dot(w, n)
    for f in range(own.body.shape[0]):
        _, w, p, _ = internal_motion(bodies, interval, own.body[f], locked)
        twice_kinetic += flexible_over_step.push_modes(machine, f, w, 0.0, p, numbers[STEP])
    if not twice_kinetic > numbers[LEAST]:
        return
    factor = missing_power(machine, stored) / twice_kinetic
    for b in range(bodies.mass.shape[0]):
        _, _, p, n = internal_motion(bodies, interval, b, locked)
        F, c = bodies.wrench[b], bodies.c[b]
        moment = cross((real(c[0]), real(c[1]), real(c[2])), p)
        for i in range(3):
            F[i] += factor * p[i]
            F[3 + i] += factor * (n[i] + moment[i])
    for f in range(own.body.shape[0]):
        _, w, p, _ = internal_motion(bodies, interval, own.body[f], locked)
        flexible_over_step.push_modes(machine, f, w, factor, p, numbers[STEP])


@stage
def straighten_nodes(machine):
    """Bring the axes of the nodes of beams, ½ (A₀ + A₁) at the mean place, to those of half the turn, Ā (σ - k kᵀ/(1 + σ)) with
    σ² = 1 + k·k: forces of an element are in balance only on axes at right angles."""
    record = record_at(machine)
    markers, bodies, interval = record.markers, record.bodies, record.residual.interval
    half = 0.5 * interval.numbers[STEP]
    for n in range(interval.node.shape[0]):
        m = interval.node[n]
        A, w = markers.A[m], seen(markers.frame_b[m], bodies.omega_b[markers.body[m]])
        k = half * w[0], half * w[1], half * w[2]
        sigma = np.sqrt(1.0 + dot(k, k))
        for i in range(3):
            along = (A[i, 0] * k[0] + A[i, 1] * k[1] + A[i, 2] * k[2]) / (1.0 + sigma)
            for j in range(3):
                A[i, j] = sigma * A[i, j] - along * k[j]


@stage
def mean_forces(machine, t):
    """Wrenches of all applied forces and of the joints at the mean place, where the bodies are. Returns a status."""
    record = record_at(machine)
    own, newton = record.residual, record.newton
    states, first = newton.state.shape[0], np.int64(own.y.shape[0]) - newton.state.shape[0] - 2
    for i in range(states):
        own.interval.state[i] = 0.5 * (newton.base[first + i] + own.y[first + i])
    status = read_markers(machine, t)
    if status == OK:
        straighten_nodes(machine)
        load_weight(record.bodies)
        status = apply_forces(machine, t, own.interval.state)
    if status == OK:
        status = load_multipliers(machine, t)
    return status


@stage
def balance_bodies(machine):
    """Rows of all bodies: the change of their momenta per second less all wrenches, moments about their origins; and rates of the states of
    forces, behind all velocities."""
    record = record_at(machine)
    bodies, own, count = record.bodies, record.residual, record.bodies.mass.shape[0]
    for b in range(count):
        A, F, c, x = bodies.A[b], bodies.wrench[b], bodies.c[b], own.acceleration[b]
        lever = cross(c, x[3:6])
        moment = x[0] + lever[0] - F[3], x[1] + lever[1] - F[4], x[2] + lever[2] - F[5]
        for i in range(3):
            own.value[6 * b + i] = x[3 + i] - F[i]
            own.value[6 * b + 3 + i] = A[0, i] * moment[0] + A[1, i] * moment[1] + A[2, i] * moment[2]
    first = own.vdot.shape[0]
    for i in range(record.elements.state_rate.shape[0]):
        own.value[first + i] = record.elements.state_rate[i]


@stage
def close_end(machine):
    """Rows of the constraints: C of the state last read."""
    record = record_at(machine)
    own = record.residual
    first = own.vdot.shape[0] + record.elements.state_rate.shape[0]
    for k in range(own.row.shape[0]):
        own.value[first + k] = record.constraints.C[own.row[k]]


@family
def residual(machine, job, t):
    """Fill `residual.value` for the state `residual.y` at the end t of a step, whose start is `newton.base` and `residual.interval`, and
    for multipliers that hold over the step; complete the velocities of that state.

    Of the constraints only C, at the end, has a meaning.
    """
    record = record_at(machine)
    own, h = record.residual, record.residual.interval.numbers[STEP]
    status = read_state(machine, t, own.y)
    if status == OK:
        status = apply_forces(machine, t, own.y)
    if status != OK:
        return status
    stored = real(record.control.stored[0]) + flexible_over_step.modal_elastic_energy(record.flexible)
    close_end(machine)
    for b in range(record.bodies.mass.shape[0]):
        if not moves_with_modes(record, b):
            change_momentum(machine, b, h)
    change_shared_momenta(machine, first_rate(record), h)
    call_hook(machine, MODES, CHANGE, t)
    status = mean_forces(machine, t - 0.5 * h)
    if status != OK:
        return status
    call_hook(machine, MODES, LOAD, t)
    push(machine, stored)
    balance_bodies(machine)
    call_hook(machine, MODES, BALANCE, t)
    return OK


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
    V, momentum = flexible_over_step.central_momentum(bodies, flexible, f, w1)
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
    power = flexible_over_step.mean_inertia_force(m, flexible, f, w0, w1, base, y, rate, rows[first : first + n])
    interval.defect[f] = power - 0.5 * missed / h
    flexible_over_step.note_central_inertia(machine, f, h)


@family
def pass_flexible(machine, job, t):
    """One of the jobs above, or of those at an instant (`nivel.kernels.bodies.floating_dynamics`). Returns a status."""
    record = record_at(machine)
    flexible, own, h = record.flexible, record.residual, record.residual.interval.numbers[STEP]
    if job == CHANGE:
        for f in range(flexible.body.shape[0]):
            change_flexible_momentum(machine, f, h)
        for k in range(flexible.frame.shape[0]):
            flexible_over_step.mean_frame(machine, k, h)
    elif job == LOAD:
        flexible_over_step.load_mean_modes(machine)
        gather_frames(machine)
    elif job == BALANCE:
        flexible_over_step.balance_modes(machine, h, own.value[6 * record.bodies.mass.shape[0] :])
    else:
        return do_flexible(machine, job)
    return OK
