"""The factor of T⁻¹ against the product T T⁻¹ = 1, and its slope against differences."""

import numpy as np
import pytest

from nivel.kernels.algebra.inverse_tangent import NEAR, inverse_tangent_by, inverse_tangent_factor, slope_of_factor

ANGLES = [0.0, 1e-6, 1e-3, 0.1, 0.7, np.sqrt(NEAR) * (1 - 1e-12), np.sqrt(NEAR), 2.0, 3.1]


def tangent(psi):
    """T = sin ψ/ψ 1 + (1 - cos ψ)/ψ² ψ̃ + (ψ - sin ψ)/ψ³ ψ ψᵀ (Rodrigues' formula, integrated), as a series: Σ ψ̃ᵏ/(k+1)!."""
    x, y, z = psi
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    total, term = np.zeros((3, 3)), np.eye(3)
    for k in range(40):
        total += term
        term = term @ cross / (k + 2)
    return total


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_product_with_the_tangent_is_the_identity(angle, sign):
    psi = angle * np.array([2.0, -1.0, 2.0]) / 3.0
    eta = inverse_tangent_factor(float(psi @ psi))
    inverse = np.array([inverse_tangent_by(eta, 0.5 * sign, tuple(psi), tuple(e)) for e in np.eye(3)]).T
    np.testing.assert_allclose(tangent(-sign * psi) @ inverse, np.eye(3), atol=4e-15)


@pytest.mark.parametrize("angle", ANGLES[3:])
def test_slope_is_that_of_the_factor(angle):
    """dη/dψ = ψ slope, by central differences of fourth order with an error of h⁴ and round-off over h."""
    h = 1e-3
    away = [inverse_tangent_factor((angle + k * h) ** 2) for k in (-2, -1, 1, 2)]
    difference = (away[0] - 8 * away[1] + 8 * away[2] - away[3]) / (12 * h)
    np.testing.assert_allclose(slope_of_factor(angle**2) * angle, difference, rtol=1e-9, atol=1e-12)
