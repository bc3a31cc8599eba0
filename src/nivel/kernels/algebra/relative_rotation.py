"""The rotation of one frame seen from another as a rotation vector, and its rate; on real and dual numbers."""

import numpy as np

from nivel.kernels.algebra.analytic import arctan2, real
from nivel.kernels.algebra.inverse_tangent import inverse_tangent_by, inverse_tangent_factor
from nivel.kernels.algebra.spatial import dot
from nivel.native.function import stage


@stage
def rotation_vector(A, B, psi):
    """ψ (3,) of AᵀB, |ψ| ≤ π, through the Euler parameters of the largest component's branch (Shepperd 1978)."""
    r00 = A[0, 0] * B[0, 0] + A[1, 0] * B[1, 0] + A[2, 0] * B[2, 0]
    r11 = A[0, 1] * B[0, 1] + A[1, 1] * B[1, 1] + A[2, 1] * B[2, 1]
    r22 = A[0, 2] * B[0, 2] + A[1, 2] * B[1, 2] + A[2, 2] * B[2, 2]
    r01 = A[0, 0] * B[0, 1] + A[1, 0] * B[1, 1] + A[2, 0] * B[2, 1]
    r10 = A[0, 1] * B[0, 0] + A[1, 1] * B[1, 0] + A[2, 1] * B[2, 0]
    r02 = A[0, 0] * B[0, 2] + A[1, 0] * B[1, 2] + A[2, 0] * B[2, 2]
    r20 = A[0, 2] * B[0, 0] + A[1, 2] * B[1, 0] + A[2, 2] * B[2, 0]
    r12 = A[0, 1] * B[0, 2] + A[1, 1] * B[1, 2] + A[2, 1] * B[2, 2]
    r21 = A[0, 2] * B[0, 1] + A[1, 2] * B[1, 1] + A[2, 2] * B[2, 1]
    trace = r00 + r11 + r22
    x, y, z, w = real(r00), real(r11), real(r22), real(trace)
    if w >= x and w >= y and w >= z:
        e0, e1, e2, e3 = 1.0 + trace, r21 - r12, r02 - r20, r10 - r01
    elif x >= y and x >= z:
        e0, e1, e2, e3 = r21 - r12, 1.0 + 2.0 * r00 - trace, r10 + r01, r02 + r20
    elif y >= z:
        e0, e1, e2, e3 = r02 - r20, r10 + r01, 1.0 + 2.0 * r11 - trace, r21 + r12
    else:
        e0, e1, e2, e3 = r10 - r01, r02 + r20, r21 + r12, 1.0 + 2.0 * r22 - trace
    sign = 1.0 if real(e0) >= 0.0 else -1.0
    sine = np.sqrt(e1 * e1 + e2 * e2 + e3 * e3)
    length = np.sqrt(e0 * e0 + sine * sine)
    # ψ = 2 atan2(sine, e0) e/sine; 2 e/e0 in the limit
    factor = sign * 2.0 * arctan2(sine, sign * e0) / sine if real(sine) > 1e-9 * real(length) else 2.0 / e0
    psi[0], psi[1], psi[2] = factor * e1, factor * e2, factor * e3


@stage
def tangent_product(psi, w, transpose, out):
    """out = T⁻¹ w (ψ̇ for the relative angular velocity w in the axes of the first marker) or T⁻ᵀ w.

    T⁻¹ = 1 - ½ ψ̃ + η ψ̃². ψ̇ = T⁻¹ w with w = ω_j - ω_i in the axes of i, where the turned frame is AᵀB and its angular velocity is given
    in fixed axes.
    """
    half = 0.5 if transpose else -0.5
    out[0], out[1], out[2] = inverse_tangent_by(inverse_tangent_factor(dot(psi, psi)), half, psi, w)
