"""Euler parameters against scipy's rotations and against differentiation."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from nivel.kernels.algebra.rotation import angular_velocity, rates_of_parameters, rotation_matrix, transformation

number = st.floats(-2, 2)
parameters = st.tuples(number, number, number, number).filter(lambda e: np.linalg.norm(e) > 0.1).map(np.array)
vector = st.tuples(number, number, number).map(np.array)


def matrix(theta):
    A = np.zeros((3, 3), dtype=theta.dtype)
    rotation_matrix(theta, A)
    return A


@given(parameters)
def test_matrix_is_the_rotation_of_the_normalised_parameters(theta):
    expected = Rotation.from_quat(theta, scalar_first=True).as_matrix()
    np.testing.assert_allclose(matrix(theta), expected, atol=1e-14)


@given(parameters, vector)
def test_angular_velocity_is_the_skew_part_of_the_matrix_rate_on_and_off_the_sphere(theta, direction):
    thetadot = np.array([0.3, *direction])
    Adot = matrix(theta + 1e-30j * thetadot).imag / 1e-30
    skew = matrix(theta).T @ Adot
    w_b = np.zeros(3)
    angular_velocity(theta, thetadot, w_b)
    scale = 1 + np.abs(w_b).max()
    np.testing.assert_allclose(skew, np.cross(np.eye(3), w_b), atol=1e-13 * scale)
    G = np.zeros((3, 4))
    transformation(theta, G)
    np.testing.assert_allclose(G @ thetadot, w_b, atol=1e-13 * scale)


@given(parameters, vector)
def test_parameter_rates_invert_the_angular_velocity_and_keep_the_length(theta, w_b):
    thetadot = np.zeros(4)
    rates_of_parameters(theta, w_b, thetadot)
    back = np.zeros(3)
    angular_velocity(theta, thetadot, back)
    np.testing.assert_allclose(back, w_b, atol=1e-13)
    assert abs(theta @ thetadot) < 1e-13
