"""A flexible body that tumbles freely, integrated from the reference equations: energy and momentum are kept, damping takes its part."""

import numpy as np
import pytest

from flexible_reference import (
    damping_force,
    elastic_force,
    kinetic_energy,
    mass_matrix,
    quadratic_velocity,
    transformation,
)
from models import bar, reduced
from nivel.flexible.body.invariants import tilde


def rotation(theta):
    theta = theta / np.linalg.norm(theta)
    K = tilde(theta[1:])
    return np.eye(3) + 2 * theta[0] * K + 2 * K @ K


def tumble(body, step, damping):
    """Energy and dissipated energy [J], momentum and moment of momentum about the origin at the start and after 20 ms (RK4)."""
    its, n = body.invariants, len(body.eigenvalues)

    def rates(y):
        theta, q, v = y[3:7], y[7 : 7 + n], y[7 + n : 13 + 2 * n]
        A, omega, qdot = rotation(theta), v[3:6], v[6:]
        force = (
            quadratic_velocity(its, A, omega, q, qdot)
            + elastic_force(body.eigenvalues, q)
            + damping_force(damping, qdot)
        )
        turning = 0.25 * transformation(theta).T @ omega
        return np.concatenate(
            [v[:3], turning, qdot, np.linalg.solve(mass_matrix(its, A, q), force), [damping @ qdot**2]]
        )

    def observed(y):
        theta, q, v = y[3:7], y[7 : 7 + n], y[7 + n : 13 + 2 * n]
        A = rotation(theta)
        p = mass_matrix(its, A, q) @ v
        energy = kinetic_energy(its, A, q, v) + 0.5 * body.eigenvalues @ q**2
        return energy, y[-1], p[:3], A @ p[3:6] + np.cross(y[:3], p[:3])

    y = np.concatenate([np.zeros(3), [1, 0, 0, 0], np.full(n, 2e-3), [1, 2, 3], [4, 20, -15], np.full(n, 0.5), [0]])
    begin = observed(y)
    for _ in range(round(0.02 / step)):
        k1 = rates(y)
        k2 = rates(y + step / 2 * k1)
        k3 = rates(y + step / 2 * k2)
        k4 = rates(y + step * k3)
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return begin, observed(y)


@pytest.fixture(scope="module", params=["reference: mean-axis", "reference: root"])
def body(request):
    whole, _ = reduced(
        bar(tip=(1.0, 0.5, 0.2), elements=8, width=0.1, height=0.15, reduction=f"modes: 6, {request.param}")
    )
    return whole.keeping(np.arange(4))


def test_energy_and_momenta_are_kept_to_the_order_of_the_method(body):
    drift = []
    for step in (2e-5, 1e-5):
        begin, end = tumble(body, step, np.zeros(4))
        drift.append(abs(end[0] / begin[0] - 1))
        np.testing.assert_allclose(end[2], begin[2], rtol=1e-4)
        np.testing.assert_allclose(end[3], begin[3], atol=2e-4 * np.linalg.norm(begin[3]))
    assert drift[1] < 1e-5  # depends on the signs of the modes
    assert drift[0] / drift[1] > 12  # 2⁴ or more


def test_damping_takes_what_the_energy_loses(body):
    begin, end = tumble(body, 1e-5, 2 * 0.05 * np.sqrt(body.eigenvalues))
    assert end[1] > 1e-3 * begin[0]
    assert begin[0] - end[0] == pytest.approx(end[1], abs=1e-6 * begin[0])
