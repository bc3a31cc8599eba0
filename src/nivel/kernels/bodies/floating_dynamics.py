"""Dynamics of flexible bodies in a floating frame of reference: forces, mass matrix, energy (Rantalainen 2007, eqs. 3.49–3.83).

Modes have unit modal mass, so the mass matrix in axes of the body [M_b B; Bᵀ 1] is factorised from the modes on: what is left of the frame
is M_b - B Bᵀ = L Lᵀ, 6 × 6 for any number of modes.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import centripetal, cross, dot, multiply
from nivel.kernels.bodies.floating_frame import (
    accelerate_frames,
    add_bias,
    bend,
    dot_modes,
    modes_of,
    move_frames,
)
from nivel.kernels.bodies.geometric_stiffening import add_velocity_forces, multiply_rows
from nivel.kernels.core.status import NO_MASS_LEFT, OK
from nivel.kernels.record.flexible_record import SHORTENING, TURNING
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

# what the hook MODES does in coordinates of single bodies: what states, forces and residuals need
BEND, OWN_BIAS, GATHER, MOVE_FRAMES, NEEDED = 0, 1, 2, 3, 4
# what the hook FACTORS does: factors, rows and forces whitened by them, accelerations; and the latter for frames at interfaces
ROOTS, FACTORISE, WHITEN, UNWHITEN, FRAMES = 0, 1, 2, 3, 4


@stage
def gather(machine):
    """Bring the wrenches at interfaces to the floating frames and to `Q`, with weight, elastic and damping forces of the modes."""
    load_modes(machine)
    gather_frames(machine)


@stage
def gather_frames(machine):
    """Bring the wrenches at interfaces to the floating frames and to `Q`."""
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    for k in range(own.frame.shape[0]):
        f, v = own.frame[k, 0], own.frame[k, 1]
        b = own.body[f]
        first, n = modes_of(own, f)
        F, total = bodies.wrench[v], bodies.wrench[b]
        moment = cross(bodies.c[v], F)
        for i in range(3):
            force, torque, displacement, turn = F[i], F[3 + i], own.displacement[k, i], own.turn[k, i]
            for j in range(n):
                own.Q[first + j] += displacement[j] * force + turn[j] * torque
        for i in range(3):
            total[i] += F[i]
            total[3 + i] += F[3 + i] + moment[i]
        for i in range(6):
            F[i] = 0.0


@stage
def load_modes(machine):
    """Start `Q` with weight, elastic and damping forces of the modes."""
    record = record_at(machine)
    bodies, own, control = record.bodies, record.flexible, record.control
    for f in range(own.body.shape[0]):
        A, g, B = bodies.A[own.body[f]], bodies.gravity, own.coupling[f]
        first, n = modes_of(own, f)
        g0, g1, g2 = dot(A[:, 0], g), dot(A[:, 1], g), dot(A[:, 2], g)
        for j in range(n):
            elastic, damping = own.stiffness[f, j] * own.p[first + j], own.damping[f, j] * own.pdot[first + j]
            own.Q[first + j] = B[0, j] * g0 + B[1, j] * g1 + B[2, j] * g2 - elastic - damping
            control.stored[0] += 0.5 * own.p[first + j] * elastic
            control.power[1] += own.pdot[first + j] * damping


@stage
def velocity_forces(bodies, own, f, out):
    """Quadratic velocity force of the frame of flexible body f into out (6,), axes of the body; that of its modes is added to `Q`.

    By Lagrange's equations of ½ m |v|² + vᵀ (ω̄ × S + S_p ṗ) + ½ ω̄ᵀ J̄ ω̄ + ω̄ᵀ C ṗ + ½ |ṗ|², v in axes of the body: on the frame
    -(ω̄ × (ω̄ × S + 2 Ṡ) + S_pp ṗ ṗ) and -(J̄' ω̄ + ω̄ × (J̄ ω̄ + C ṗ) + C_p ṗ ṗ), on a mode ½ ω̄ᵀ J̄_p ω̄ + ω̄ᵀ (C_p - C_pᵀ) ṗ.
    """
    b, most = own.body[f], own.I3.shape[2]
    first, n = modes_of(own, f)
    w, S, J, B, T = bodies.omega_b[b], own.first[f], own.inertia[f], own.coupling[f], own.bulge[f]
    drift = (
        dot_modes(B[0], own.pdot, first, n),
        dot_modes(B[1], own.pdot, first, n),
        dot_modes(B[2], own.pdot, first, n),
    )
    T0, T1, T2, T3 = T[0:n], T[most : most + n], T[2 * most : 2 * most + n], T[3 * most : 3 * most + n]
    T4, T5 = T[4 * most : 4 * most + n], T[5 * most : 5 * most + n]
    xx, yy = 2.0 * dot_modes(T0, own.pdot, first, n), 2.0 * dot_modes(T1, own.pdot, first, n)
    zz, xy = 2.0 * dot_modes(T2, own.pdot, first, n), 2.0 * dot_modes(T3, own.pdot, first, n)
    yz, zx = 2.0 * dot_modes(T4, own.pdot, first, n), 2.0 * dot_modes(T5, own.pdot, first, n)
    momentum = (
        dot(J[0], w) + dot_modes(B[3], own.pdot, first, n),
        dot(J[1], w) + dot_modes(B[4], own.pdot, first, n),
        dot(J[2], w) + dot_modes(B[5], own.pdot, first, n),
    )
    centripetal(w, S, out[:3])
    coriolis, gyroscopic = cross(w, drift), cross(w, momentum)
    for i in range(3):
        out[i] = -out[i] - 2.0 * coriolis[i]
    out[3] = -gyroscopic[0] - (xx * w[0] + xy * w[1] + zx * w[2])
    out[4] = -gyroscopic[1] - (xy * w[0] + yy * w[1] + yz * w[2])
    out[5] = -gyroscopic[2] - (zx * w[0] + yz * w[1] + zz * w[2])
    w0, w1, w2 = w[0], w[1], w[2]
    for j in range(n):
        own.Q[first + j] += (
            w0 * w0 * T0[j] + w1 * w1 * T1[j] + w2 * w2 * T2[j]
            + 2.0 * (w0 * w1 * T3[j] + w1 * w2 * T4[j] + w2 * w0 * T5[j])
        )  # fmt: skip
    if own.terms[f, TURNING] != 0:
        turning = own.scratch[0]
        multiply_rows(own.I5, f * most, own.pdot, first, n, turning, 3 * most)
        for j in range(n):
            own.Q[first + j] -= 2.0 * (w0 * turning[j] + w1 * turning[most + j] + w2 * turning[2 * most + j])
    if own.terms[f, SHORTENING] != 0:
        add_velocity_forces(own, f, first, n, out)


@stage
def remaining_mass(bodies, own, f, M):
    """M_b - B Bᵀ, what is left of the frame's mass matrix without the modes, into the lower triangle of M (6, 6); axes of the body."""
    B, S, J, b = own.coupling[f], own.first[f], own.inertia[f], own.body[f]
    _, n = modes_of(own, f)
    for i in range(6):
        for j in range(i + 1):
            M[i, j] = J[i - 3, j - 3] if i > 2 and j > 2 else 0.0
    for i in range(3):
        M[i, i] = bodies.mass[b]
    # S~ of M_θR
    M[3, 1], M[3, 2], M[4, 0], M[4, 2], M[5, 0], M[5, 1] = -S[2], S[1], S[2], -S[0], -S[1], S[0]
    for i in range(6):
        for j in range(i + 1):
            total = M[i, j]
            for k in range(n):
                total -= B[i, k] * B[j, k]
            M[i, j] = total


@stage
def factorise_lower(L):
    """Overwrite the lower triangle of a symmetric L (6, 6) with its Cholesky factor; whether there is one."""
    for i in range(6):
        for j in range(i + 1):
            total = L[i, j]
            for k in range(j):
                total -= L[i, k] * L[j, k]
            if i == j and not real(total) > 0.0:
                return False
            L[i, j] = np.sqrt(total) if i == j else total / L[j, j]
    return True


@leaf
def forward(L, x):
    """x (6,) := L⁻¹ x."""
    for i in range(6):
        total = x[i]
        for k in range(i):
            total -= L[i, k] * x[k]
        x[i] = total / L[i, i]


@leaf
def backward(L, x):
    """x (6,) := L⁻ᵀ x."""
    for i in range(5, -1, -1):
        total = x[i]
        for k in range(i + 1, 6):
            total -= L[k, i] * x[k]
        x[i] = total / L[i, i]


@stage
def flexible_row(machine, e):
    """C_q of block e of `Flexible.block` into W: of the frame with respect to (Aᵀ Ṙ, ω̄), of the modes, in the blocks behind, to ṗ."""
    record = record_at(machine)
    bodies, own, saddle = record.bodies, record.flexible, record.saddle
    at, k, f, modal = own.block[e, 0], own.block[e, 1], own.block[e, 2], own.block[e, 3]
    A, (_, n) = bodies.A[own.body[f]], modes_of(own, f)
    part, W = record.constraints.J[saddle.block[at, 1]], saddle.W[at]
    across = cross(record.markers.u[saddle.block[at, 2]], part)
    # about the node; then about the origin of the floating frame
    M = part[3] + across[0], part[4] + across[1], part[5] + across[2]
    lever = (0.0, 0.0, 0.0) if k == NONE else cross(bodies.c[own.frame[k, 1]], part)
    for i in range(3):
        W[i] = A[0, i] * part[0] + A[1, i] * part[1] + A[2, i] * part[2]
        W[3 + i] = A[0, i] * (M[0] + lever[0]) + A[1, i] * (M[1] + lever[1]) + A[2, i] * (M[2] + lever[2])
    # a marker on the frame itself is not moved by modes, and has no blocks for them
    for j in range(n if k != NONE else 0):
        power = 0.0
        for i in range(3):
            power += own.displacement[k, i, j] * part[i] + own.turn[k, i, j] * M[i]
        saddle.W[modal + j // 6, j % 6] = power


@stage
def leave_modes(own, f, x, modal, at):
    """x (6,) -= B times the n modal numbers in rows of six from modal[at] on."""
    B, (_, n) = own.coupling[f], modes_of(own, f)
    for j in range(n):
        share = modal[at + j // 6, j % 6]
        for i in range(6):
            x[i] -= B[i, j] * share


@stage
def factorise_frames(machine):
    """root := L of M_b - B Bᵀ = L Lᵀ of all flexible bodies. Returns a status."""
    record = record_at(machine)
    own = record.flexible
    for f in range(own.body.shape[0]):
        remaining_mass(record.bodies, own, f, own.root[f])
        if not factorise_lower(own.root[f]):
            record.control.failure[0] = own.body[f]
            return NO_MASS_LEFT
    return OK


@stage
def whiten_flexible_rows(machine):
    """W of all blocks of flexible bodies: of their frames L⁻¹ (C_qr - C_qp Bᵀ)ᵀ, of their modes C_qp. Returns a status."""
    record = record_at(machine)
    own, saddle = record.flexible, record.saddle
    status = factorise_frames(machine)
    if status != OK:
        return status
    for e in range(own.block.shape[0]):
        at, f = own.block[e, 0], own.block[e, 2]
        flexible_row(machine, e)
        if own.block[e, 1] != NONE:
            leave_modes(own, f, saddle.W[at], saddle.W, np.int64(own.block[e, 3]))
        forward(own.root[f], saddle.W[at])
    return OK


@stage
def load_frame(bodies, own, f, out):
    """Applied and velocity forces on the frame of flexible body f into out (6,), axes of the body; the latter on its modes into `Q`."""
    A, F = bodies.A[own.body[f]], bodies.wrench[own.body[f]]
    velocity_forces(bodies, own, f, out)
    for i in range(3):
        out[i] += A[0, i] * F[0] + A[1, i] * F[1] + A[2, i] * F[2]
        out[3 + i] += A[0, i] * F[3] + A[1, i] * F[4] + A[2, i] * F[5]


@stage
def load_modal_rows(own, f, out, at):
    """The modal forces of flexible body f into rows of six from out[at] on."""
    first, n = modes_of(own, f)
    for j in range(n):
        out[at + j // 6, j % 6] = own.Q[first + j]


@stage
def whiten_flexible_forces(machine):
    """z of all flexible bodies: of their frames, then of their modes in rows of six behind all bodies."""
    record = record_at(machine)
    bodies, own, z = record.bodies, record.flexible, record.saddle.z
    at = np.int64(bodies.mass.shape[0])
    for f in range(own.body.shape[0]):
        x = z[own.body[f]]
        load_frame(bodies, own, f, x)
        load_modal_rows(own, f, z, at)
        leave_modes(own, f, x, z, at)
        forward(own.root[f], x)
        at += modal_rows(own, f)


@leaf
def modal_rows(own, f):
    """Rows of six that the modes of flexible body f take."""
    return (modes_of(own, f)[1] + 5) // 6


@stage
def accelerate_modes(own, f, z, at, x):
    """p̈ of flexible body f from rows of z from `at` on and (Aᵀ R̈, ᾱ) of its frame, x (6,); also their changes in a correction."""
    B, (first, n) = own.coupling[f], modes_of(own, f)
    for j in range(n):
        total = z[at + j // 6, j % 6]
        for i in range(6):
            total -= B[i, j] * x[i]
        own.pddot[first + j] = total


@stage
def unwhiten_flexible(machine):
    """(R̈, ᾱ) of the frames of flexible bodies and p̈ from z; also changes of (R, rotation, p) or (Ṙ, ω̄, ṗ) in a correction."""
    record = record_at(machine)
    bodies, own, z = record.bodies, record.flexible, record.saddle.z
    at = np.int64(bodies.mass.shape[0])
    for f in range(own.body.shape[0]):
        b = own.body[f]
        x = z[b]
        backward(own.root[f], x)
        multiply(bodies.A[b], x[:3], bodies.Rddot[b])
        for i in range(3):
            bodies.alpha_b[b, i] = x[3 + i]
        accelerate_modes(own, f, z, at, x)
        at += modal_rows(own, f)


@stage
def frame_momenta(bodies, own, f, v, w, rates, at):
    """(linear, angular about the origin) momentum of the frame of flexible body f for velocities v, w and modal ones, `rates` from `at` on,
    all in axes of the body; for accelerations what they ask for."""
    S, J, B, m, (_, n) = own.first[f], own.inertia[f], own.coupling[f], bodies.mass[own.body[f]], modes_of(own, f)
    swing, heave = cross(w, S), cross(S, v)
    return (
        m * v[0] + swing[0] + dot_modes(B[0], rates, at, n),
        m * v[1] + swing[1] + dot_modes(B[1], rates, at, n),
        m * v[2] + swing[2] + dot_modes(B[2], rates, at, n),
    ), (
        heave[0] + dot(J[0], w) + dot_modes(B[3], rates, at, n),
        heave[1] + dot(J[1], w) + dot_modes(B[4], rates, at, n),
        heave[2] + dot(J[2], w) + dot_modes(B[5], rates, at, n),
    )


@stage
def flexible_wrench(bodies, own, f, acceleration, wrench, effort):
    """What the accelerations of flexible body f ask for, less all applied and velocity forces: on its frame into wrench[b], as
    (moment, force), on its modes into effort (m,). acceleration : (α, R̈) of all bodies; of the modes `pddot`."""
    b = own.body[f]
    first, n = modes_of(own, f)
    A, B, x = bodies.A[b], own.coupling[f], acceleration[b]
    velocity_forces(bodies, own, f, own.velocity_force[f])
    alpha = dot(A[:, 0], x[0:3]), dot(A[:, 1], x[0:3]), dot(A[:, 2], x[0:3])
    a = dot(A[:, 0], x[3:6]), dot(A[:, 1], x[3:6]), dot(A[:, 2], x[3:6])
    a0, a1, a2, b0, b1, b2 = a[0], a[1], a[2], alpha[0], alpha[1], alpha[2]
    for j in range(n):
        effort[first + j] = (
            own.pddot[first + j] - own.Q[first + j]
            + (a0 * B[0, j] + a1 * B[1, j] + a2 * B[2, j] + b0 * B[3, j] + b1 * B[4, j] + b2 * B[5, j])
        )  # fmt: skip
    needed_by_frame(bodies, own, f, alpha, a, wrench[b])


@stage
def needed_by_frame(bodies, own, f, alpha, a, out):
    """(moment, force) that the frame of flexible body f needs for ᾱ and R̈ in axes of the body, less all applied and velocity forces."""
    b = own.body[f]
    first, n = modes_of(own, f)
    A, S, J, B, F = bodies.A[b], own.first[f], own.inertia[f], own.coupling[f], bodies.wrench[b]
    q = own.velocity_force[f]
    swing, heave, m = cross(alpha, S), cross(S, a), bodies.mass[b]
    force = (
        m * a[0] + swing[0] - q[0] + dot_modes(B[0], own.pddot, first, n),
        m * a[1] + swing[1] - q[1] + dot_modes(B[1], own.pddot, first, n),
        m * a[2] + swing[2] - q[2] + dot_modes(B[2], own.pddot, first, n),
    )
    moment = (
        heave[0] + dot(J[0], alpha) - q[3] + dot_modes(B[3], own.pddot, first, n),
        heave[1] + dot(J[1], alpha) - q[4] + dot_modes(B[4], own.pddot, first, n),
        heave[2] + dot(J[2], alpha) - q[5] + dot_modes(B[5], own.pddot, first, n),
    )
    multiply(A, moment, out[0:3])
    multiply(A, force, out[3:6])
    for i in range(3):
        out[i] -= F[3 + i]
        out[3 + i] -= F[i]


@stage
def inertia_wrench(bodies, own, f, out):
    """The same into out (6,) for the accelerations `Rddot`, `alpha_b` and `pddot` of the state last evaluated."""
    b = own.body[f]
    A, x, y = bodies.A[b], bodies.Rddot[b], bodies.alpha_b[b]
    a = dot(A[:, 0], x), dot(A[:, 1], x), dot(A[:, 2], x)
    needed_by_frame(bodies, own, f, (y[0], y[1], y[2]), a, out)


@stage
def flexible_kinetic_energy(bodies, own, f):
    """½ m |Ṙ|² + Ṙᵀ A (ω̄ × S + I3 ṗ) + ½ ω̄ᵀ J̄ ω̄ + ω̄ᵀ C ṗ + ½ |ṗ|² of flexible body f [J]."""
    b = own.body[f]
    first, n = modes_of(own, f)
    A, V, w, S, J, B = bodies.A[b], bodies.Rdot[b], bodies.omega_b[b], own.first[f], own.inertia[f], own.coupling[f]
    v = dot(A[:, 0], V), dot(A[:, 1], V), dot(A[:, 2], V)
    total = 0.5 * bodies.mass[b] * dot(v, v) + dot(v, cross(w, S))
    total += 0.5 * (w[0] * dot(J[0], w) + w[1] * dot(J[1], w) + w[2] * dot(J[2], w))
    for j in range(n):
        rate = own.pdot[first + j]
        along = B[0, j] * v[0] + B[1, j] * v[1] + B[2, j] * v[2]
        total += rate * (along + B[3, j] * w[0] + B[4, j] * w[1] + B[5, j] * w[2] + 0.5 * rate)
    return total


@stage
def do_flexible(machine, job):
    """One of the jobs of the hook MODES, for all flexible bodies. Returns a status."""
    record = record_at(machine)
    if job == BEND:
        bend(machine)
    elif job == OWN_BIAS:
        add_bias(machine)
    elif job == GATHER:
        gather(machine)
    elif job == MOVE_FRAMES:
        move_frames(machine)
    else:
        own, first = record.residual, 6 * record.bodies.mass.shape[0]
        for f in range(record.flexible.body.shape[0]):
            flexible_wrench(record.bodies, record.flexible, f, own.acceleration, own.wrench, own.value[first:])
    return OK


@family
def pass_flexible(machine, job, t):
    """One of the jobs of the hook MODES, for all flexible bodies. Returns a status."""
    return do_flexible(machine, job)


@family
def solve_flexible(machine, job, t):
    """One of the jobs of the hook FACTORS, for all flexible bodies. Returns a status."""
    if job == FACTORISE:
        return whiten_flexible_rows(machine)
    if job == ROOTS:
        return factorise_frames(machine)
    if job == WHITEN:
        whiten_flexible_forces(machine)
    elif job == UNWHITEN:
        unwhiten_flexible(machine)
    else:
        accelerate_frames(machine)
    return OK
