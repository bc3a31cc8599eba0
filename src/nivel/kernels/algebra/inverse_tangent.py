"""The factor η of T⁻¹ = 1 ± ½ ψ̃ + η ψ̃², which turns angular velocities into rates of a rotation vector ψ, and its derivative.

η = (1 - ½ψ cot ½ψ)/ψ² = Σ |B_2k| ψ^(2k-2)/(2k)! with Bernoulli's numbers, k from 1. Elements of beams and iterations ask for it so often
that the tangent of the C library took a tenth of a step.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross
from nivel.native.function import leaf, stage

# Below this ψ² the series is exact: its next term is below 1e-16 of the sum.
NEAR = 1.0
# |B_2k|/(2k)!
ETA = (
    1 / 12,
    1 / 720,
    1 / 30240,
    1 / 1209600,
    1 / 47900160,
    691 / 1307674368000,
    1 / 74724249600,
    3617 / 10670622842880000,
    43867 / 5109094217170944000,
    174611 / 802857662698291200000,
    77683 / 14101100039391805440000,
    236364091 / 1693824136731743669452800000,
)
TERMS = 12


@leaf
def inverse_tangent_factor(square):
    """η for ψ²."""
    if real(square) >= NEAR:
        half = 0.5 * np.sqrt(square)
        return (1.0 - half / np.tan(half)) / square
    eta = ETA[TERMS - 1] + 0.0 * square
    for m in range(TERMS - 1):
        eta = ETA[TERMS - 2 - m] + square * eta
    return eta


@leaf
def slope_of_factor(square):
    """η'/ψ for ψ²."""
    if real(square) >= NEAR:
        angle = np.sqrt(square)
        half = 0.5 * angle
        cotangent = 1.0 / np.tan(half)
        # (½ψ cot ½ψ)' = ½ cot ½ψ - ¼ψ/sin² ½ψ
        slope = 0.5 * cotangent - 0.5 * half * (1.0 + cotangent * cotangent)
        return (-slope / angle - 2.0 * (1.0 - half * cotangent) / square) / square
    slope = 2.0 * (TERMS - 1) * ETA[TERMS - 1] + 0.0 * square
    for m in range(TERMS - 2):
        k = TERMS - 2 - m
        slope = 2.0 * k * ETA[k] + square * slope
    return slope


@stage
def inverse_tangent_by(eta, half, psi, w):
    """w + half ψ × w + η ψ × (ψ × w): T⁻¹ w or T⁻ᵀ w, as the sign of `half`, ½, says."""
    c = cross(psi, w)
    d = cross(psi, c)
    return w[0] + half * c[0] + eta * d[0], w[1] + half * c[1] + eta * d[1], w[2] + half * c[2] + eta * d[2]
