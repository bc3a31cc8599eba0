"""The rotation vector ψ [rad]: A = exp(ψ̃), a turn by |ψ| about ψ.

Everything depends on s = |ψ|² through a = (1 - cos ψ)/ψ² and b = (ψ - sin ψ)/ψ³ and their derivatives
da/ds = (sin ψ/ψ - 2a)/(2s), db/ds = (a - 3b)/(2s). Singular where |ψ| = 2π, 4π, …: a = 0.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.native.function import leaf

# Below this |ψ|² the closed forms cancel, and so many terms of the series are exact: the next is 1/20!.
SMALL, TERMS = 1.0, 9


@leaf
def coefficients(s):
    """a, b, da/ds, db/ds for s = |ψ|² to round-off for every s: series a = Σ (-s)ᵏ/(2k+2)!, b = Σ (-s)ᵏ/(2k+3)!, or closed forms."""
    if real(s) >= SMALL:
        root = np.sqrt(s)
        sine = np.sin(0.5 * root)
        a = 2.0 * sine * sine / s
        ratio = np.sin(root) / root
        b = (1.0 - ratio) / s
        return a, b, 0.5 * (ratio - 2.0 * a) / s, 0.5 * (a - 3.0 * b) / s
    a, b, da, db = 0.0 * s, 0.0 * s, 0.0 * s, 0.0 * s
    power, alpha, beta = 1.0 + 0.0 * s, 0.5, 1.0 / 6.0
    for k in range(TERMS):
        a += alpha * power
        b += beta * power
        alpha /= (2 * k + 3) * (2 * k + 4)
        beta /= (2 * k + 4) * (2 * k + 5)
        da -= (k + 1) * alpha * power
        db -= (k + 1) * beta * power
        power *= -s
    return a, b, da, db


@leaf
def turn(psi, psidot, theta, G, bias):
    """From ψ (3,) [rad] and ψ̇: Euler parameters `theta` (4,) of A, Ḡ (3, 3) of ω̄ = Ḡ ψ̇, and Ḡ̇ ψ̇ [rad/s²].

    Ḡ = 1 - a ψ̃ + b ψ̃². Returns sin(ψ/2)/(ψ/2), the root of det Ḡ: positive until the first singular position.
    Source: Cardona & Géradin 1988, "A beam finite element non-linear theory with finite rotations", tangent operator (its transpose for
    body axes).
    """
    x, y, z = psi[0], psi[1], psi[2]
    s = x * x + y * y + z * z
    a, b, da, db = coefficients(s)
    if real(s) >= SMALL:
        half = 0.5 * np.sqrt(s)
        regularity, theta[0] = np.sin(half) / half, np.cos(half)
    else:
        regularity = np.sqrt(2.0 * a)
        theta[0] = np.sqrt(1.0 - 0.5 * a * s)
    for i in range(3):
        theta[1 + i] = 0.5 * regularity * psi[i]
    d = 1.0 - b * s
    G[0, 0], G[0, 1], G[0, 2] = d + b * x * x, b * x * y + a * z, b * x * z - a * y
    G[1, 0], G[1, 1], G[1, 2] = b * x * y - a * z, d + b * y * y, b * y * z + a * x
    G[2, 0], G[2, 1], G[2, 2] = b * x * z + a * y, b * y * z - a * x, d + b * z * z
    # d/dt (ψ̇ - a w + b ψ × w) with w = ψ × ψ̇, ψ × w = p ψ - s ψ̇, ψ̇ × w = |ψ̇|² ψ - p ψ̇, p = ψᵀψ̇
    p = x * psidot[0] + y * psidot[1] + z * psidot[2]
    square = psidot[0] * psidot[0] + psidot[1] * psidot[1] + psidot[2] * psidot[2]
    w0, w1, w2 = y * psidot[2] - z * psidot[1], z * psidot[0] - x * psidot[2], x * psidot[1] - y * psidot[0]
    along, rate = 2.0 * db * p * p + b * square, -(2.0 * db * s + b) * p
    bias[0] = -2.0 * da * p * w0 + along * x + rate * psidot[0]
    bias[1] = -2.0 * da * p * w1 + along * y + rate * psidot[1]
    bias[2] = -2.0 * da * p * w2 + along * z + rate * psidot[2]
    return regularity
