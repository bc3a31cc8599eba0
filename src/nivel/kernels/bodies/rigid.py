"""Rigid bodies: pose and velocity from the state, weight, and energy."""

from nivel.kernels.algebra.rotation import rotation_matrix
from nivel.kernels.algebra.spatial import dot, multiply
from nivel.native.function import stage


@stage
def place_body(bodies, b, q):
    """Pose of body b from its seven coordinates q = (R, θ)."""
    for i in range(3):
        bodies.R[b, i] = q[i]
    for i in range(4):
        bodies.theta[b, i] = q[3 + i]
    set_axes(bodies, b)


@stage
def set_axes(bodies, b):
    """Axes and centre of mass of body b from its Euler parameters."""
    rotation_matrix(bodies.theta[b], bodies.A[b])
    multiply(bodies.A[b], bodies.centre_b[b], bodies.c[b])


@stage
def load_weight(bodies):
    """Start the wrenches of all bodies (force; torque about the frame origin, global axes) with the weight m g."""
    g = bodies.gravity
    for b in range(bodies.mass.shape[0]):
        F = bodies.wrench[b]
        c = bodies.c[b]
        m = bodies.mass[b]
        F[0], F[1], F[2] = m * g[0], m * g[1], m * g[2]
        F[3] = c[1] * F[2] - c[2] * F[1]
        F[4] = c[2] * F[0] - c[0] * F[2]
        F[5] = c[0] * F[1] - c[1] * F[0]


@stage
def turn_to_body_axes(bodies, b):
    """ω̄ of body b from ω; not all coordinates need it."""
    A, w = bodies.A[b], bodies.omega[b]
    for i in range(3):
        bodies.omega_b[b, i] = A[0, i] * w[0] + A[1, i] * w[1] + A[2, i] * w[2]


@stage
def kinetic_energy(bodies, b):
    """½ m |Ṙ + ω × c|² + ½ ω̄ᵀ J ω̄ of body b [J]."""
    w, c, V, J, w_b = bodies.omega[b], bodies.c[b], bodies.Rdot[b], bodies.inertia_b[b], bodies.omega_b[b]
    vx = V[0] + w[1] * c[2] - w[2] * c[1]
    vy = V[1] + w[2] * c[0] - w[0] * c[2]
    vz = V[2] + w[0] * c[1] - w[1] * c[0]
    turning = w_b[0] * dot(J[0], w_b) + w_b[1] * dot(J[1], w_b) + w_b[2] * dot(J[2], w_b)
    return 0.5 * bodies.mass[b] * (vx * vx + vy * vy + vz * vz) + 0.5 * turning


@stage
def potential_energy(bodies, b):
    """-m gᵀ(R + c) of body b [J]."""
    g, R, c = bodies.gravity, bodies.R[b], bodies.c[b]
    height = g[0] * (R[0] + c[0]) + g[1] * (R[1] + c[1]) + g[2] * (R[2] + c[2])
    return -bodies.mass[b] * height
