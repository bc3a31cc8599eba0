"""Rotations by Euler parameters θ = (θ0, θ1, θ2, θ3), scalar first.

A(θ) is taken of θ/|θ|, so it is a rotation for any θ ≠ 0 and the radial direction of θ moves nothing: the body-frame angular
velocity is ω̄ = Ḡ θ̇ with Ḡ = 2 Ē/|θ|² exactly, on and off the unit sphere (report 44, eqs. 5, 28, 29, on the sphere).
"""

from nivel.native.function import leaf, stage


@leaf
def rotation_matrix(theta, A):
    """A (3, 3): columns are the body axes in global axes."""
    e0, e1, e2, e3 = theta[0], theta[1], theta[2], theta[3]
    scale = 2.0 / (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3)
    A[0, 0] = 1.0 - scale * (e2 * e2 + e3 * e3)
    A[0, 1] = scale * (e1 * e2 - e0 * e3)
    A[0, 2] = scale * (e1 * e3 + e0 * e2)
    A[1, 0] = scale * (e1 * e2 + e0 * e3)
    A[1, 1] = 1.0 - scale * (e1 * e1 + e3 * e3)
    A[1, 2] = scale * (e2 * e3 - e0 * e1)
    A[2, 0] = scale * (e1 * e3 - e0 * e2)
    A[2, 1] = scale * (e2 * e3 + e0 * e1)
    A[2, 2] = 1.0 - scale * (e1 * e1 + e2 * e2)


@stage
def normalise_parameters(theta):
    """θ := θ/|θ|."""
    square = theta[0] * theta[0] + theta[1] * theta[1] + theta[2] * theta[2] + theta[3] * theta[3]
    # 1/√s for s near 1; exact to round-off after one step's drift
    scale = 1.0 / square**0.5
    for i in range(4):
        theta[i] *= scale


@leaf
def rates_of_parameters(theta, w_b, out):
    """θ̇ = ½ Ēᵀ ω̄ for the body-frame angular velocity ω̄ [rad/s]; also the change of θ for a small rotation vector."""
    x, y, z = 0.5 * w_b[0], 0.5 * w_b[1], 0.5 * w_b[2]
    out[0] = -theta[1] * x - theta[2] * y - theta[3] * z
    out[1] = theta[0] * x - theta[3] * y + theta[2] * z
    out[2] = theta[3] * x + theta[0] * y - theta[1] * z
    out[3] = -theta[2] * x + theta[1] * y + theta[0] * z


@leaf
def angular_velocity(theta, thetadot, w_b):
    """ω̄ = 2 Ē θ̇/|θ|², body axes [rad/s]."""
    e0, e1, e2, e3 = theta[0], theta[1], theta[2], theta[3]
    scale = 2.0 / (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3)
    d0, d1, d2, d3 = thetadot[0], thetadot[1], thetadot[2], thetadot[3]
    w_b[0] = scale * (-e1 * d0 + e0 * d1 + e3 * d2 - e2 * d3)
    w_b[1] = scale * (-e2 * d0 - e3 * d1 + e0 * d2 + e1 * d3)
    w_b[2] = scale * (-e3 * d0 + e2 * d1 - e1 * d2 + e0 * d3)


@leaf
def transformation(theta, G):
    """Ḡ = 2 Ē/|θ|² (3, 4): ω̄ = Ḡ θ̇ (eq. 28, normalised)."""
    e0, e1, e2, e3 = theta[0], theta[1], theta[2], theta[3]
    scale = 2.0 / (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3)
    G[0, 0], G[0, 1], G[0, 2], G[0, 3] = -scale * e1, scale * e0, scale * e3, -scale * e2
    G[1, 0], G[1, 1], G[1, 2], G[1, 3] = -scale * e2, -scale * e3, scale * e0, scale * e1
    G[2, 0], G[2, 1], G[2, 2], G[2, 3] = -scale * e3, scale * e2, -scale * e1, scale * e0


@leaf
def product(first, second, out):
    """Euler parameters of A(first) A(second); `out` may be either."""
    a0, a1, a2, a3 = first[0], first[1], first[2], first[3]
    b0, b1, b2, b3 = second[0], second[1], second[2], second[3]
    out[0] = a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3
    out[1] = a0 * b1 + a1 * b0 + a2 * b3 - a3 * b2
    out[2] = a0 * b2 - a1 * b3 + a2 * b0 + a3 * b1
    out[3] = a0 * b3 + a1 * b2 - a2 * b1 + a3 * b0
