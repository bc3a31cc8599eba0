"""Absolute coordinates with flexible bodies, Lagrange equations in Euler parameters: q = (R, θ of every body; p), v = q̇.

With T = diag(Aᵀ, Ḡ), so that (Aᵀ Ṙ, ω̄) = T (Ṙ, θ̇), the mass matrix of a flexible body is [Tᵀ M_b T, Tᵀ B; Bᵀ T, 1] (Rantalainen 2007,
eqs. 3.49–3.54). The modes are eliminated first: what is left of the frame is Tᵀ (M_b - B Bᵀ) T, made positive definite by μ θ θᵀ as that
of rigid bodies (`nivel.motion.lagrange`). Off the unit sphere ᾱ = Ḡ θ̈ + κ ω̄; what κ ω̄ does is taken with the velocity forces.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import entry, leaf, stage
from nivel.kernels.floating_dynamics import (
    accelerate_modes,
    backward,
    factorise_lower,
    flexible_row,
    gather,
    leave_modes,
    load_frame,
    load_modal_rows,
    modal_rows,
    remaining_mass,
)
from nivel.kernels.floating_dynamics import forward as forward_lower
from nivel.kernels.floating_frame import accelerate_frames, add_bias, bend, modes_of
from nivel.kernels.hook import apply_forces, finish_forces
from nivel.kernels.record import NONE, correct_signature, evaluate_signature, record_at
from nivel.kernels.rigid import load_weight
from nivel.kernels.rotation import angular_velocity, transformation
from nivel.kernels.saddle import factorise_rows, multipliers
from nivel.kernels.spatial import cross, dot
from nivel.kernels.status import NO_MASS_LEFT, OK
from nivel.motion.lagrange import (
    WIDTH,
    factorise_body,
    first_rate,
    normalisation_rows,
    radial_force,
    radial_rate,
    read_bodies,
    unwhiten,
    whiten_force,
    whiten_row,
    write_rate,
)
from nivel.motion.newton_euler import read_markers


@stage
def read_flexible_state(machine, t, y):
    """Poses and velocities of bodies, frames at interfaces and markers, and all constraint rows. Returns a status."""
    record = record_at(machine)
    own, nb, v = record.flexible, record.bodies.mass.shape[0], first_rate(record)
    read_bodies(machine, y)
    normalisation_rows(machine, y)
    for j in range(own.p.shape[0]):
        own.p[j], own.pdot[j] = y[7 * nb + j], y[v + 7 * nb + j]
    bend(machine)
    status = read_markers(machine, t)
    add_bias(machine)
    return status


@leaf
def column_of(A, G, j):
    """Column j of T: its place among translations (0) or turns (3), and its three entries there. Ḡ stands in G[:3, 3:]."""
    if j < 3:
        return 0, (A[j, 0], A[j, 1], A[j, 2])
    return 3, (G[0, j], G[1, j], G[2, j])


@leaf
def symmetric(M, i, j):
    """Entry of a symmetric matrix of which the lower triangle is filled."""
    return M[i, j] if i >= j else M[j, i]


@leaf
def transform(A, G, M):
    """Lower triangle of G (7, 7) := Tᵀ M T for the lower triangle of M (6, 6)."""
    for k in range(7):
        at, t = column_of(A, G, k)
        for i in range(k, 7):
            to, s = column_of(A, G, i)
            total = 0.0
            for a in range(3):
                for b in range(3):
                    total += s[a] * symmetric(M, to + a, at + b) * t[b]
            G[i, k] = total


@leaf
def bring(A, G, x):
    """x (7,) := Tᵀ x for the x (6,) in its first entries."""
    f0, f1, f2, n0, n1, n2 = x[0], x[1], x[2], x[3], x[4], x[5]
    for i in range(3):
        x[i] = A[i, 0] * f0 + A[i, 1] * f1 + A[i, 2] * f2
    for i in range(4):
        x[3 + i] = G[0, 3 + i] * n0 + G[1, 3 + i] * n1 + G[2, 3 + i] * n2


@stage
def flexible_augmentation(own, f):
    """μ [kg m²] of flexible body f: 4 trace(J̄)/3, deformed."""
    J = own.inertia[f]
    return 4.0 / 3.0 * (J[0, 0] + J[1, 1] + J[2, 2])


@stage
def factorise_masses(machine):
    """Cholesky factors of all bodies in G: of rigid ones as in `nivel.motion.lagrange`, of flexible ones with Ḡ in its upper right corner.

    Returns a status.
    """
    record = record_at(machine)
    bodies, own = record.bodies, record.flexible
    for b in range(bodies.mass.shape[0]):
        if own.rigid[b] == 1:
            factorise_body(bodies, record.saddle.G[b], b)
    for f in range(own.body.shape[0]):
        b = own.body[f]
        G, theta, mu = record.saddle.G[b], bodies.theta[b], flexible_augmentation(own, f)
        transformation(theta, G[0:3, 3:7])
        remaining_mass(bodies, own, f, own.root[f])
        transform(bodies.A[b], G, own.root[f])
        for i in range(4):
            for k in range(i + 1):
                G[3 + i, 3 + k] += mu * theta[i] * theta[k]
        if not factorise_lower(G, WIDTH):
            record.control.failure[0] = b
            return NO_MASS_LEFT
    return OK


@stage
def whiten_all_rows(machine, y):
    """W = C_q L⁻ᵀ of rigid bodies, of frames and modes of flexible ones, and of normalisation; κ in γ."""
    record = record_at(machine)
    bodies, own, saddle = record.bodies, record.flexible, record.saddle
    for k in range(saddle.block.shape[0]):
        part, b = saddle.block[k, 1], saddle.block[k, 3]
        if b < bodies.mass.shape[0] and (part == NONE or own.rigid[b] == 1):
            whiten_row(machine, y, k)
    for e in range(own.block.shape[0]):
        at, f = own.block[e, 0], own.block[e, 2]
        b, W = own.body[f], saddle.W[at]
        flexible_row(machine, e)
        record.constraints.gamma[saddle.block[at, 0]] -= radial_rate(machine, y, b) * dot(W[3:6], bodies.omega_b[b])
        leave_modes(own, f, W, saddle.W, np.int64(own.block[e, 3]))
        bring(bodies.A[b], saddle.G[b], W)
        forward_lower(saddle.G[b], W, WIDTH)


@stage
def factorise(machine, y):
    """The factors of all bodies, W of all blocks, and the factor of S. Returns a status."""
    status = factorise_masses(machine)
    if status != OK:
        return status
    whiten_all_rows(machine, y)
    return factorise_rows(machine, WIDTH)


@stage
def load_radial(machine, y, f, z):
    """Take from the forces on the frame, z (6,) in axes of the body, and on the modes of flexible body f what κ ω̄ asks for."""
    record = record_at(machine)
    own, b = record.flexible, record.flexible.body[f]
    first, n = modes_of(own, f)
    w, S, J, B, kappa = (
        record.bodies.omega_b[b],
        own.first[f],
        own.inertia[f],
        own.coupling[f],
        radial_rate(machine, y, b),
    )
    swing = cross(w, S)
    for i in range(3):
        z[i] -= kappa * swing[i]
        z[3 + i] -= kappa * dot(J[i], w)
    for j in range(n):
        own.Q[first + j] -= kappa * (B[3, j] * w[0] + B[4, j] * w[1] + B[5, j] * w[2])


@stage
def whiten_all_forces(machine, y):
    """z = L⁻¹ (Q_e + Q_v) of all bodies, then of the modes in rows of six."""
    record = record_at(machine)
    bodies, own, saddle = record.bodies, record.flexible, record.saddle
    for b in range(bodies.mass.shape[0]):
        if own.rigid[b] == 1:
            whiten_force(machine, y, b)
    at = np.int64(bodies.mass.shape[0])
    for f in range(own.body.shape[0]):
        b = own.body[f]
        z = saddle.z[b]
        load_frame(bodies, own, f, z)
        load_radial(machine, y, f, z)
        load_modal_rows(own, f, saddle.z, at)
        leave_modes(own, f, z, saddle.z, at)
        bring(bodies.A[b], saddle.G[b], z)
        radial = radial_force(record, flexible_augmentation(own, f), b)
        for i in range(4):
            z[3 + i] += radial * bodies.theta[b, i]
        forward_lower(saddle.G[b], z, WIDTH)
        at += modal_rows(own, f)


@stage
def unwhiten_all(machine):
    """(R̈, θ̈) in z and p̈; also changes of (R, θ, p) or of their rates in a correction."""
    record = record_at(machine)
    bodies, own, saddle = record.bodies, record.flexible, record.saddle
    for b in range(bodies.mass.shape[0]):
        if own.rigid[b] == 1:
            unwhiten(machine, b)
    at = np.int64(bodies.mass.shape[0])
    for f in range(own.body.shape[0]):
        b = own.body[f]
        A, z, alpha = bodies.A[b], saddle.z[b], bodies.alpha_b[b]
        backward(saddle.G[b], z, WIDTH)
        angular_velocity(bodies.theta[b], z[3:7], alpha)
        a0, a1, a2 = dot(A[:, 0], z), dot(A[:, 1], z), dot(A[:, 2], z)
        accelerate_modes(own, f, saddle.z, at, (a0, a1, a2, alpha[0], alpha[1], alpha[2]))
        at += modal_rows(own, f)


@entry(evaluate_signature)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (R, θ of every body; p; Ṙ, θ̇ of every body; ṗ; x). Leaves everything else in the record."""
    record = record_at(machine)
    own, nb, v = record.flexible, record.bodies.mass.shape[0], first_rate(record)
    status = read_flexible_state(machine, t, y)
    if status != OK:
        return status
    load_weight(record.bodies)
    status = apply_forces(machine, t, y)
    if status != OK:
        return status
    gather(machine)
    status = factorise(machine, y)
    if status != OK:
        return status
    whiten_all_forces(machine, y)
    status = multipliers(machine, WIDTH)
    if status == OK:
        status = finish_forces(machine, t, ydot)
    if status != OK:
        return status
    unwhiten_all(machine)
    for b in range(nb):
        write_rate(machine, y, ydot, b)
    accelerate_frames(machine)
    for j in range(own.p.shape[0]):
        ydot[7 * nb + j], ydot[v + 7 * nb + j] = own.pdot[j], own.pddot[j]
    return OK


@entry(correct_signature)
def keep(machine, t, y):
    """No correction: the normalisation rows drift like all others."""
    return OK
