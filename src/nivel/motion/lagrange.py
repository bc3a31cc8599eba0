"""Absolute coordinates, Lagrange equations in Euler parameters: q = (R, θ), v = q̇, seven a body (report 44, eqs. 57–77).

M is singular along θ (rank 6 of 7); adding μ θ θᵀ to its rotation block, and μ θ (θᵀθ̈) with θᵀθ̈ = -θ̇ᵀθ̇ to the forces, makes it
positive definite and changes neither the motion nor a multiplier. The normalisation θᵀθ - 1 = 0 is one row a body.
"""

import numpy as np

from nivel.kernels.algebra.rotation import angular_velocity, rates_of_parameters, transformation
from nivel.kernels.algebra.spatial import cross, dot, multiply
from nivel.kernels.algebra.vectors import axis, combined, minus, moment, plus, put, seen, times, turned
from nivel.kernels.bodies.rigid import place_body
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import CORRECT, EVALUATE, NONE, record_at
from nivel.kernels.residual.residual import fill_residual, write_rows
from nivel.kernels.solve.saddle import factorise_rows
from nivel.motion.direct import POSITIONS, correct_levels, find_accelerations
from nivel.motion.newton_euler import load_bodies, read_markers
from nivel.native.entry import entry
from nivel.native.function import leaf, stage

WIDTH = 7


@leaf
def first_rate(record):
    """Where q̇ stands in y: behind (R, θ) of the bodies."""
    return 7 * record.bodies.mass.shape[0]


@stage
def normalisation_rows(machine, y):
    """C, Ċ = 2 θᵀθ̇ and γ = -2 θ̇ᵀθ̇ of θᵀθ - 1 = 0."""
    record = record_at(machine)
    constraints = record.constraints
    nb, v = record.bodies.mass.shape[0], first_rate(record)
    first = constraints.C.shape[0] - nb
    for b in range(nb):
        length, rate, square = 0.0 * y[0], 0.0 * y[0], 0.0 * y[0]
        for i in range(4):
            length += y[7 * b + 3 + i] * y[7 * b + 3 + i]
            thetadot = y[v + 7 * b + 3 + i]
            rate += y[7 * b + 3 + i] * thetadot
            square += thetadot * thetadot
        constraints.C[first + b] = length - 1.0
        constraints.Cdot[first + b] = 2.0 * rate
        constraints.gamma[first + b] = -2.0 * square


@stage
def read_bodies(machine, y):
    """Poses and velocities of bodies."""
    record = record_at(machine)
    bodies = record.bodies
    for b in range(bodies.mass.shape[0]):
        v = first_rate(record) + 7 * b
        place_body(bodies, b, y[7 * b : 7 * b + 7])
        for i in range(3):
            bodies.Rdot[b, i] = y[v + i]
        angular_velocity(bodies.theta[b], y[v + 3 : v + 7], bodies.omega_b[b])
        multiply(bodies.A[b], bodies.omega_b[b], bodies.omega[b])


@stage
def read_state(machine, t, y):
    """Poses and velocities of bodies and markers, and all constraint rows. Returns a status."""
    read_bodies(machine, y)
    normalisation_rows(machine, y)
    return read_markers(machine, t)


@stage
def radial_rate(machine, y, b):
    """κ = -2 θᵀθ̇/|θ|²: ᾱ = Ḡ θ̈ + κ ω̄, zero on the unit sphere."""
    record = record_at(machine)
    v = first_rate(record) + 7 * b
    rate, square = 0.0 * y[0], 0.0 * y[0]
    for i in range(4):
        rate += y[7 * b + 3 + i] * y[v + 3 + i]
        square += y[7 * b + 3 + i] * y[7 * b + 3 + i]
    return -2.0 * rate / square


@stage
def augmentation(bodies, b):
    """μ [kg m²]: the mean of the rotation block's other eigenvalues, 4 trace(J̄)/3."""
    J = bodies.inertia_origin_b[b]
    return 4.0 / 3.0 * (J[0, 0] + J[1, 1] + J[2, 2])


@stage
def factorise_body(bodies, G, b):
    """Cholesky factor of M + μ θ θᵀ of body b, in the lower triangle of G (7, 7); A Ḡ (3, 4) in its free upper right corner.

    m_RR = m 1, m_Rθ = -m c̃ A Ḡ, m_θθ = Ḡᵀ J̄_O Ḡ (eqs. 58–60).
    """
    A, c, m, J = bodies.A[b], bodies.c[b], bodies.mass[b], bodies.inertia_origin_b[b]
    theta = bodies.theta[b]
    Gbar = G[0:3, 3:7]
    transformation(theta, Gbar)
    mu = augmentation(bodies, b)
    for k in range(4):
        j = turned(J, axis(Gbar, k))
        for i in range(k, 4):
            G[3 + i, 3 + k] = dot(axis(Gbar, i), j) + mu * theta[i] * theta[k]
    root = np.sqrt(m)
    for k in range(4):
        h = turned(A, axis(Gbar, k))
        Gbar[0, k], Gbar[1, k], Gbar[2, k] = h
        # column k of m_Rθ over √m: -√m c × h
        put(G[3 + k], 0, times(-root, cross(c, h)))
    for i in range(3):
        G[i, i] = root
    for i in range(4):
        for k in range(i + 1):
            value = G[3 + i, 3 + k]
            for j in range(3 + k):
                value -= G[3 + i, j] * G[3 + k, j]
            G[3 + i, 3 + k] = np.sqrt(value) if i == k else value / G[3 + k, 3 + k]


@stage
def forward(G, z):
    """z := L⁻¹ z for the factor in G."""
    for i in range(3):
        z[i] /= G[i, i]
    for i in range(3, 7):
        value = z[i]
        for j in range(i):
            value -= G[i, j] * z[j]
        z[i] = value / G[i, i]


@stage
def fill_row(machine, y, k):
    """W of block k: C_q with C_θ = (n + u × f)ᵀ A Ḡ (eq. 27); off the unit sphere γ changes by -κ (n + u × f)ᵀ ω."""
    record = record_at(machine)
    bodies, saddle, constraints = record.bodies, record.saddle, record.constraints
    row, part, marker, b = saddle.block[k, 0], saddle.block[k, 1], saddle.block[k, 2], saddle.block[k, 3]
    W, G = saddle.W[k], saddle.G[b]
    if part == NONE:
        for i in range(3):
            W[i] = 0.0
        for i in range(4):
            W[3 + i] = 2.0 * bodies.theta[b, i]
    else:
        J, u, w = constraints.J[part], record.markers.u[marker], bodies.omega[b]
        n = moment(J, u)
        put(W, 0, J)
        for i in range(4):
            W[3 + i] = dot(n, axis(G, 3 + i))
        constraints.gamma[row] -= radial_rate(machine, y, b) * dot(n, w)


@stage
def whiten_row(machine, y, k):
    """W of block k: C_q L⁻ᵀ."""
    saddle = record_at(machine).saddle
    fill_row(machine, y, k)
    forward(saddle.G[saddle.block[k, 3]], saddle.W[k])


@stage
def factorise(machine, y):
    """The factors of all bodies, W of all blocks, and the factor of S. Returns a status."""
    record = record_at(machine)
    for b in range(record.bodies.mass.shape[0]):
        factorise_body(record.bodies, record.saddle.G[b], b)
    for k in range(record.saddle.block.shape[0]):
        whiten_row(machine, y, k)
    return factorise_rows(machine, WIDTH)


@stage
def radial_force(record, mu, b):
    """μ θᵀθ̈ = -μ θ̇ᵀθ̇ of body b, from γ of its normalisation."""
    gamma = record.constraints.gamma
    return 0.5 * mu * gamma[record.constraints.C.shape[0] - record.bodies.mass.shape[0] + b]


@stage
def whiten_force(machine, y, b):
    """z = L⁻¹ (Q_e + Q_v) of body b with Q_v from eq. 63, and the parts of κ and of the augmentation."""
    record = record_at(machine)
    bodies, saddle = record.bodies, record.saddle
    F, c, w, w_b = bodies.wrench[b], bodies.c[b], bodies.omega[b], bodies.omega_b[b]
    A, J, G, z = bodies.A[b], bodies.inertia_origin_b[b], saddle.G[b], saddle.z[b]
    m = bodies.mass[b]
    kappa = radial_rate(machine, y, b)
    wc, ww = dot(w, c), dot(w, w)
    put(z, 0, minus(F, times(m, plus(combined(wc, w, -ww, c), times(kappa, cross(w, c))))))
    h = turned(J, w_b)
    # velocity moments in body axes, then all moments in global axes: C_θ and Q_θ share A Ḡ
    v = plus(cross(w_b, h), times(kappa, h))
    torque = minus((F[3], F[4], F[5]), turned(A, v))
    radial = radial_force(record, augmentation(bodies, b), b)
    for i in range(4):
        z[3 + i] = dot(torque, axis(G, 3 + i)) + radial * bodies.theta[b, i]
    forward(G, z)


@stage
def whiten_forces(machine, y):
    """z of all bodies."""
    for b in range(record_at(machine).bodies.mass.shape[0]):
        whiten_force(machine, y, b)


@stage
def unwhiten(machine, b):
    """z := L⁻ᵀ z, the change of (R, θ) or its derivatives."""
    record = record_at(machine)
    G, z = record.saddle.G[b], record.saddle.z[b]
    for k in range(7):
        i = 6 - k
        value = z[i]
        for j in range(max(i + 1, 3), 7):
            value -= G[j, i] * z[j]
        z[i] = value / G[i, i]


@stage
def write_rate(machine, y, ydot, b):
    """(q̇, q̈) of body b in ẏ, and its accelerations, from q̈ in z."""
    record = record_at(machine)
    bodies, z = record.bodies, record.saddle.z[b]
    q, v = 7 * b, first_rate(record) + 7 * b
    for i in range(7):
        ydot[q + i] = y[v + i]
        ydot[v + i] = z[i]
    kappa = radial_rate(machine, y, b)
    angular_velocity(bodies.theta[b], z[3:7], bodies.alpha_b[b])
    for i in range(3):
        bodies.Rddot[b, i] = z[i]
        bodies.alpha_b[b, i] += kappa * bodies.omega_b[b, i]


@stage
def write_rates(machine, y, ydot):
    """(q̇, q̈) of ẏ, and the accelerations of the bodies."""
    for b in range(record_at(machine).bodies.mass.shape[0]):
        unwhiten(machine, b)
        write_rate(machine, y, ydot, b)


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ of y = (q, q̇, x): x are the states of forces, the work of external forces and the dissipated energy [J].

    Leaves everything else in the record.
    """
    status = read_state(machine, t, y)
    if status == OK:
        status = find_accelerations(machine, t, y, ydot, WIDTH, load_bodies, factorise, whiten_forces)
    if status == OK:
        write_rates(machine, y, ydot)
    return status


@entry(CORRECT)
def normalise_state(machine, t, y):
    """No correction: the normalisation rows drift like all others."""
    return OK


@stage
def apply_change(machine, y, what):
    """Apply the change found to (R, θ) or to (Ṙ, θ̇); it is least in the metric M + μ θ θᵀ."""
    record = record_at(machine)
    nb = record.bodies.mass.shape[0]
    first = 0 if what == POSITIONS else 7 * nb
    for b in range(nb):
        unwhiten(machine, b)
        for i in range(7):
            y[first + 7 * b + i] += record.saddle.z[b, i]


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints, see `nivel.motion.direct.correct_levels`."""
    return correct_levels(machine, t, y, WIDTH, read_state, factorise, apply_change)


# The residual of the same equations: rows of (Ṙ, θ̇) of every body, and of their normalisation.
#
# With ω̄ = Ḡ θ̇ and ᾱ = Ḡ θ̈ + κ ω̄ a body needs the moment of the Newton–Euler equations, and its rows are Ḡᵀ times that. They have no part
# along θ. There stands μ (θᵀθ̈ + θ̇ᵀθ̇) θ, zero where the normalisation holds, so that the matrix of a body has an inverse without its row
# of normalisation, as the order of elimination asks for; and the multiplier of that row, 2 θ λ.


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
    # Ḡᵀ = 2 Ēᵀ/|θ|², and θ̇ is ½ Ēᵀ ω̄
    rates_of_parameters(theta, seen(A, F), value[3:7])
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
    return fill_residual(machine, t, read_state, accelerate_bodies, write_bodies)
