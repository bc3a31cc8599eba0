"""Euler angles φ = (φ₁, φ₂, φ₃) in the sequence z, x, z about moving axes (3-1-3): A = A_z(φ₁) A_x(φ₂) A_z(φ₃).

Singular where sin φ₂ = 0: the first and the third axis coincide.
"""

import numpy as np

from nivel.native.function import leaf


@leaf
def turn(phi, phidot, theta, G, bias):
    """From φ (3,) [rad] and φ̇: Euler parameters `theta` (4,) of A, Ḡ (3, 3) of ω̄ = Ḡ φ̇, and Ḡ̇ φ̇ [rad/s²].

    The columns of Ḡ are the three axes in the turned frame. Returns sin φ₂ = -det Ḡ: positive until the first singular position.
    θ is continuous in φ, so its sign never jumps.
    """
    sine, cosine = np.sin(0.5 * phi[1]), np.cos(0.5 * phi[1])
    mean, half = 0.5 * (phi[0] + phi[2]), 0.5 * (phi[0] - phi[2])
    theta[0], theta[3] = cosine * np.cos(mean), cosine * np.sin(mean)
    theta[1], theta[2] = sine * np.cos(half), sine * np.sin(half)
    s2, c2 = np.sin(phi[1]), np.cos(phi[1])
    s3, c3 = np.sin(phi[2]), np.cos(phi[2])
    G[0, 0], G[0, 1], G[0, 2] = s2 * s3, c3, 0.0
    G[1, 0], G[1, 1], G[1, 2] = s2 * c3, -s3, 0.0
    G[2, 0], G[2, 1], G[2, 2] = c2, 0.0, 1.0
    d1, d2, d3 = phidot[0], phidot[1], phidot[2]
    bias[0] = d1 * (c2 * s3 * d2 + s2 * c3 * d3) - s3 * d2 * d3
    bias[1] = d1 * (c2 * c3 * d2 - s2 * s3 * d3) - c3 * d2 * d3
    bias[2] = -s2 * d1 * d2
    return s2
