"""The residual of the Lagrange equations in Euler parameters: rows of (Ṙ, θ̇) of every body, and of their normalisation.

With ω̄ = Ḡ θ̇ and ᾱ = Ḡ θ̈ + κ ω̄ (`nivel.motion.lagrange`) a body needs the moment of the Newton–Euler equations, and its rows are Ḡᵀ times
that. They have no part along θ. There stands μ (θᵀθ̈ + θ̇ᵀθ̇) θ, zero where the normalisation holds, so that the matrix of a body has an
inverse without its row of normalisation, as the order of elimination asks for; and the multiplier of that row, 2 θ λ.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.rotation import angular_velocity, rates_of_parameters
from nivel.kernels.algebra.spatial import multiply
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.kernels.residual.residual import find_wrenches, write_rows
from nivel.motion.lagrange import WIDTH, augmentation, radial_rate, read_state
from nivel.native.function import leaf, stage


@leaf
def first_normalisation(record):
    """The constraint row of the normalisation of the first body: they stand behind those of joints."""
    return np.int64(record.constraints.C.shape[0]) - np.int64(record.bodies.mass.shape[0])


@stage
def accelerate_bodies(machine):
    """`residual.acceleration` of all bodies from (R̈, θ̈) in `residual.vdot`."""
    record = record_at(machine)
    bodies, own = record.bodies, record.residual
    for b in range(bodies.mass.shape[0]):
        x, v, alpha = own.acceleration[b], own.vdot[WIDTH * b : WIDTH * b + WIDTH], bodies.alpha_b[b]
        kappa = radial_rate(machine, own.y, b)
        angular_velocity(bodies.theta[b], v[3:7], alpha)
        for i in range(3):
            alpha[i] += kappa * bodies.omega_b[b, i]
            x[3 + i] = v[i]
        multiply(bodies.A[b], alpha, x[:3])


@stage
def write_body(machine, b):
    """The rows of body b from `residual.wrench`, but for the multiplier of the normalisation."""
    record = record_at(machine)
    bodies, own = record.bodies, record.residual
    A, F, theta = bodies.A[b], own.wrench[b], bodies.theta[b]
    value, thetaddot = own.value[WIDTH * b : WIDTH * b + WIDTH], own.vdot[WIDTH * b + 3 : WIDTH * b + WIDTH]
    square, radial = 0.0 * theta[0], -0.5 * record.constraints.gamma[first_normalisation(record) + b]
    for i in range(4):
        square += theta[i] * theta[i]
        radial += theta[i] * thetaddot[i]
    radial *= augmentation(bodies, b)
    moment_b = (
        A[0, 0] * F[0] + A[1, 0] * F[1] + A[2, 0] * F[2],
        A[0, 1] * F[0] + A[1, 1] * F[1] + A[2, 1] * F[2],
        A[0, 2] * F[0] + A[1, 2] * F[1] + A[2, 2] * F[2],
    )
    # Ḡᵀ = 2 Ēᵀ/|θ|², and θ̇ is ½ Ēᵀ ω̄
    rates_of_parameters(theta, moment_b, value[3:7])
    for i in range(3):
        value[i] = F[3 + i]
    for i in range(4):
        value[3 + i] = 4.0 / square * value[3 + i] + radial * theta[i]


@stage
def write_bodies(machine):
    """The rows of all bodies from `residual.wrench`, rates of the states of forces, and constraints."""
    record = record_at(machine)
    own, first = record.residual, WIDTH * record.bodies.mass.shape[0]
    for b in range(record.bodies.mass.shape[0]):
        write_body(machine, b)
    write_rows(machine, first)
    accelerations = first + record.elements.state_rate.shape[0] + 2 * own.lam.shape[0]
    for k in range(own.row.shape[0]):
        b = np.int64(own.row[k]) - first_normalisation(record)
        if b >= 0:
            at = WIDTH * b + 3
            for i in range(4):
                twice = 2.0 * record.bodies.theta[b, i]
                own.value[at + i] += twice * own.lam[k]
                own.value[accelerations + k] += twice * own.vdot[at + i]


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual.residual`."""
    record = record_at(machine)
    status = read_state(machine, t, record.residual.y)
    if status == OK:
        accelerate_bodies(machine)
        status = find_wrenches(machine, t)
    if status == OK:
        write_bodies(machine)
    return status
