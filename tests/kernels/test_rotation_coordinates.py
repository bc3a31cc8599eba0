"""Euler angles and the rotation vector against SciPy's rotations and against differentiation of their own matrices."""

from fractions import Fraction
from math import factorial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from nivel.kernels.algebra import euler_angles, rotation_vector
from nivel.kernels.algebra.rotation import product, rotation_matrix
from nivel.kernels.algebra.rotation_vector import coefficients
from nivel.kernels.algebra.spatial import solve

pytestmark = pytest.mark.plain

H = 1e-30
SCIPY = {euler_angles: lambda phi: Rotation.from_euler("ZXZ", phi), rotation_vector: Rotation.from_rotvec}
KINDS = pytest.mark.parametrize("kind", SCIPY, ids=lambda kind: kind.__name__.rsplit(".", 1)[1])
number = st.floats(-3.5, 3.5)
vector = st.tuples(number, number, number).map(np.array)


def turned(kind, phi, phidot):
    """(θ, A, Ḡ, Ḡ̇ φ̇, regularity) of real or complex coordinates."""
    dtype = np.result_type(phi, phidot)
    theta, G, bias, A = np.zeros(4, dtype), np.zeros((3, 3), dtype), np.zeros(3, dtype), np.zeros((3, 3), dtype)
    regularity = kind.turn(phi.astype(dtype), phidot.astype(dtype), theta, G, bias)
    rotation_matrix(theta, A)
    return theta, A, G, bias, regularity


@KINDS
@given(phi=vector)
def test_parameters_are_those_of_the_rotation_and_of_unit_length(kind, phi):
    theta, A, *_ = turned(kind, phi, phi)
    np.testing.assert_allclose(A, SCIPY[kind](phi).as_matrix(), atol=1e-14)
    assert abs(theta @ theta - 1.0) < 1e-14


@KINDS
@given(phi=vector, phidot=vector)
def test_transformation_is_the_complex_step_derivative_of_the_matrix(kind, phi, phidot):
    """AᵀȦ is the skew matrix of ω̄ = Ḡ φ̇."""
    _, A, G, _, _ = turned(kind, phi, phidot)
    Adot = turned(kind, phi + 1j * H * phidot, phidot)[1].imag / H
    w_b = G @ phidot
    np.testing.assert_allclose(A.T @ Adot, np.cross(np.eye(3), w_b), atol=1e-13 * (1 + np.abs(w_b).max()))


@KINDS
@given(phi=vector, phidot=vector)
def test_rate_of_the_transformation_is_its_complex_step_derivative(kind, phi, phidot):
    _, _, _, bias, _ = turned(kind, phi, phidot)
    Gdot = turned(kind, phi + 1j * H * phidot, phidot)[2].imag / H
    np.testing.assert_allclose(bias, Gdot @ phidot, atol=1e-12 * (1 + phidot @ phidot))


@given(phi=vector)
def test_regularity_is_the_determinant_of_the_transformation(phi):
    """det Ḡ = -sin φ₂ of the angles, (sin(ψ/2)/(ψ/2))² of the vector."""
    _, _, G, _, sine = turned(euler_angles, phi, phi)
    assert abs(np.linalg.det(G) + sine) < 1e-14
    _, _, G, _, root = turned(rotation_vector, phi, phi)
    assert abs(np.linalg.det(G) - root * root) < 1e-13


@pytest.mark.parametrize("size", [0.0, 1e-200, 1e-12, 1e-8, 1e-5, 1e-3, 1e-2, 0.1, 0.5, 0.9, 1.1, 2.0, 3.0])
def test_rotation_vectors_of_any_size_lose_no_digit(size):
    """Against the series a = Σ (-s)ᵏ/(2k+2)!, b = Σ (-s)ᵏ/(2k+3)! and their derivatives, summed in fractions."""
    s, terms = Fraction(size * size), range(25)
    a, b = (sum((-s) ** k / factorial(2 * k + more) for k in terms) for more in (2, 3))
    da, db = (-sum((k + 1) * (-s) ** k / factorial(2 * k + 2 + more) for k in terms) for more in (2, 3))
    expected = [float(value) for value in (a, b, da, db)]
    np.testing.assert_allclose(coefficients(size * size), expected, rtol=1e-15 if size < 1.0 else 3e-14)
    psi = size * np.array([0.6, 0.0, 0.8])
    theta, *_ = turned(rotation_vector, psi, psi)
    assert abs(theta[0] - np.cos(size / 2)) < 1e-15
    np.testing.assert_allclose(theta[1:], np.sin(size / 2) * np.array([0.6, 0.0, 0.8]), rtol=2e-15)


@given(first=vector, second=vector)
def test_product_of_parameters_is_that_of_the_matrices(first, second):
    a, b = Rotation.from_rotvec(first), Rotation.from_rotvec(second)
    out = b.as_quat(scalar_first=True)
    product(a.as_quat(scalar_first=True), out, out)
    np.testing.assert_allclose(Rotation.from_quat(out, scalar_first=True).as_matrix(), (a * b).as_matrix(), atol=1e-14)


def test_three_equations_are_solved(rng):
    A, b = rng.standard_normal((3, 3)), rng.standard_normal(3)
    expected = np.linalg.solve(A, b)
    solve(A, b, b)
    np.testing.assert_allclose(b, expected, rtol=1e-12)
