"""Mass matrix and quadratic velocity vector from the inertia invariants, against sums over points and against energy."""

import numpy as np
import pytest

from flexible_reference import (
    direct_mass_matrix,
    gravity_force,
    mass_matrix,
    point_force,
    quadratic_velocity,
    transformation,
    with_euler_parameters,
)
from models import bar, block
from needing import needs
from nivel.flexible.body.invariants import of_points, tilde
from nivel.flexible.body.mass_invariants import invariants
from nivel.flexible.model.model import PointMass, lumped
from nivel.flexible.model.model_file import parse_model
from nivel.flexible.reduce import source_model
from nivel.flexible.reduction.free_body import FreeBody
from nivel.flexible.reduction.ties import with_interfaces

SOLID = block(
    length=0.6,
    size=0.12,
    interfaces="root: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, tip: {plane: {point: [0.6, 0, 0], normal: [1, 0, 0]}, tie: average}",
)
MODELS = {
    "beam consistent": bar(tip=(1.0, 0.4, -0.3), elements=6),
    "beam lumped": bar(tip=(1.0, 0.4, -0.3), elements=6, reduction="modes: 8, mass: lumped"),
    "beam timoshenko": bar(tip=(1.0, 0.4, -0.3), elements=6, theory="timoshenko"),
    "solid consistent": SOLID,
    "solid lumped": SOLID.replace("modes: 6", "modes: 6, mass: lumped"),
}


def rotation(theta):
    """A of Euler parameters, eq. (3.5), also of complex ones."""
    K = tilde(theta[1:])
    return np.eye(3) + 2 * theta[0] * K + 2 * K @ K


@pytest.fixture(scope="module", params=MODELS)
def case(request):
    """Mass of a model, elastic modes of it mixed with some of everything, and their invariants."""
    needs("gmsh")
    located = parse_model(MODELS[request.param])
    model, sets = source_model(located, lambda *_: None)
    model, _ = with_interfaces(model, located, sets)
    if located.record.reduction.mass == "lumped" and located.record.frame is None:
        model = model.changed(mass=lumped(model.mass))
    body = FreeBody.of(model)
    modes = body.elastic_modes(5)[1]
    # rigid parts too, so that I3 and I4 do not vanish
    modes = modes + body.rigid @ np.random.default_rng(3).normal(size=(6, modes.shape[1]))
    return model, modes, invariants(model.mass, modes)


@pytest.fixture
def state(rng):
    theta = rng.normal(size=4)
    theta /= np.linalg.norm(theta)
    rate = rng.normal(size=4)
    rate -= theta * (theta @ rate)
    return theta, rate, rng.normal(size=3), 0.2 * rng.normal(size=5), rng.normal(size=5)


def test_mass_matrix_from_invariants_is_the_sum_over_points(case, state):
    model, modes, its = case
    theta, _, _, q, _ = state
    mass = model.mass
    displacement = (mass.shape @ modes).reshape(len(mass.position), 3, -1)
    A = rotation(theta)
    expected = direct_mass_matrix(mass.position, displacement, mass.weight, A, q)
    np.testing.assert_allclose(mass_matrix(its, A, q), expected, atol=1e-12 * np.abs(expected).max())


def test_modal_mass_is_that_of_the_mass_matrix_of_the_model(case):
    model, modes, its = case
    np.testing.assert_allclose(its.I6, modes.T @ (model.mass.matrix @ modes), atol=1e-11)


def test_quadratic_velocity_vector_is_the_derivative_of_the_kinetic_energy(case, state):
    """Q_v = ∂T/∂q - Ṁ q̇ in (R, θ, q_f), by complex steps; its rotational part on the tangent of the unit sphere."""
    _, _, its = case
    theta, rate, velocity, q, qdot = state
    n = len(q)
    place, speed = np.concatenate([np.zeros(3), theta, q]), np.concatenate([velocity, rate, qdot])

    def matrix(place):
        return with_euler_parameters(mass_matrix(its, rotation(place[3:7]), place[7:]), place[3:7])

    step = 1e-30
    slope = [0.5 * (speed @ matrix(place + 1j * step * direction) @ speed).imag / step for direction in np.eye(7 + n)]
    expected = np.array(slope) - (matrix(place + 1j * step * speed).imag / step) @ speed
    G = transformation(theta)
    got = quadratic_velocity(its, rotation(theta), G @ rate, q, qdot)
    scale = np.abs(expected).max()
    np.testing.assert_allclose(got[:3], expected[:3], atol=1e-8 * scale)
    np.testing.assert_allclose(got[6:], expected[7:], atol=1e-8 * scale)
    np.testing.assert_allclose(got[3:6], G @ expected[3:7] / 4, atol=1e-8 * scale)


def test_gravity_is_the_derivative_of_the_potential_energy(case, state):
    """Power of gravity -V̇ with V = -gᵀ Σ m r, by central differences of the motion."""
    _, _, its = case
    theta, rate, velocity, q, qdot = state
    g = np.array([0.3, -9.81, 1.0])

    def potential(s):
        turned = theta + s * rate
        A = rotation(turned / np.linalg.norm(turned))
        return -g @ (its.I1 * s * velocity + A @ (its.I2 + its.I3 @ (q + s * qdot)))

    h = 1e-6
    power = gravity_force(its, rotation(theta), q, g) @ np.concatenate([velocity, transformation(theta) @ rate, qdot])
    assert power == pytest.approx(-(potential(h) - potential(-h)) / (2 * h), rel=1e-7)


def test_force_at_a_point_does_the_work_of_its_displacement(case, state, rng):
    theta, rate, velocity, q, qdot = state
    x, phi, psi, force, torque = rng.normal(size=3), *rng.normal(size=(2, 3, 5)), *rng.normal(size=(2, 3))
    A, omega = rotation(theta), transformation(theta) @ rate
    got = point_force(A, x, phi, psi, q, force, torque) @ np.concatenate([velocity, omega, qdot])
    point_velocity = velocity + A @ (np.cross(omega, x + phi @ q) + phi @ qdot)
    expected = force @ point_velocity + torque @ (A @ (omega + psi @ qdot))
    assert got == pytest.approx(expected, rel=1e-12)


def test_invariants_of_combined_modes_are_those_of_the_combination(case, rng):
    model, modes, its = case
    change = rng.normal(size=(5, 3))
    got, expected = its.of_modes(change), invariants(model.mass, modes @ change)
    for name in ("I3", "I4", "I5", "I6", "I8", "I9"):
        np.testing.assert_allclose(getattr(got, name), getattr(expected, name), atol=1e-9, err_msg=name)


def test_invariants_of_two_points_by_hand():
    """Masses 2 and 3 kg at ±x, a mode that moves the first along y: the sums written out."""
    its = of_points(
        np.array([[1.0, 0, 0], [-1.0, 0, 0]]), np.array([[[0.0], [1.0], [0.0]], np.zeros((3, 1))]), np.array([2.0, 3.0])
    )
    assert its.I1 == 5.0
    np.testing.assert_array_equal(its.I2, [-1, 0, 0])
    np.testing.assert_array_equal(its.I3[:, 0], [0, 2, 0])
    np.testing.assert_array_equal(its.I4[:, 0], [0, 0, 2])  # 2 · x × y
    np.testing.assert_array_equal(its.I7, np.diag([0, 5, 5]))
    np.testing.assert_array_equal(its.I8[0], [[0, 0, 0], [-2, 0, 0], [0, 0, 0]])
    np.testing.assert_array_equal(its.I9[0, 0], np.diag([2, 0, 2]))


def test_general_mass_matrix_keeps_what_energy_needs(rng):
    """A beam's mass known as a matrix only: exact inertia and modal mass, and I8 - I8ᵀ = -(I4)~, I5 antisymmetric."""
    from nivel.flexible.model.model import MatrixMass

    located = parse_model(bar(tip=(1.0, 0.4, -0.3), elements=6))
    model, _ = source_model(located, lambda *_: None)
    assert isinstance(model.mass, PointMass)
    modes = FreeBody.of(model).elastic_modes(5)[1] + model.rigid_modes() @ rng.normal(size=(6, 5))
    exact = invariants(model.mass, modes)
    its = invariants(MatrixMass(model.position, model.freedoms, model.mass.matrix), modes)
    for name in ("I1", "I2", "I3", "I4", "I6", "I7"):
        value = getattr(exact, name)
        np.testing.assert_allclose(getattr(its, name), value, atol=1e-10 * np.abs(exact.I7).max() + 1e-9, err_msg=name)
    np.testing.assert_allclose(its.I8 - its.I8.transpose(0, 2, 1), -tilde(its.I4.T), atol=1e-12)
    np.testing.assert_allclose(its.I5, -its.I5.transpose(2, 1, 0), atol=1e-12)
    np.testing.assert_allclose(its.I9, exact.I9, rtol=0.2, atol=0.05 * np.abs(exact.I9).max())
