"""A pendulum that bends while it swings, from the file of the example: two dimensions, written here from the invariants."""

from pathlib import Path

import numpy as np
import pytest

from flexible_reference import gravity_force, mass_matrix, quadratic_velocity, stiffening
from nivel.flexible.reduce import reduce

EXAMPLE = Path(__file__).parents[2] / "examples" / "flexible" / "pendulum-bar.yaml"
HIGHEST, STEP = 200.0, 5e-4  # [Hz], [s] of Runge and Kutta's method: ω h < 0.7
GRAVITY = np.array([0, -9.81, 0])
# tip (x, y) [m] of a bar of 16 cable elements of the absolute nodal coordinate formulation, steps of 0.125 ms
TIMES = [0.25, 0.5, 1.0, 1.5, 2.0]
TIPS = [
    (1.948097, -0.452638),
    (1.253915, -1.558090),
    (-1.764028, -0.942432),
    (-1.995952, -0.127006),
    (-0.384017, -1.962786),
]


def swing(body, *, stiffened):
    """Tip positions (t, 2) at TIMES, and the largest deflection of the tip from the tangent at the root."""
    tip = body.interface("tip")
    used = np.flatnonzero((body.frequencies < HIGHEST) & (np.abs(tip.phi[1]) > 1e-3 * np.abs(tip.phi).max()))
    its = body.invariants.of_modes(np.eye(len(body.eigenvalues))[:, used])
    K, phi = body.eigenvalues[used], tip.phi[:, used]
    terms = {name: each[:, used][:, :, used] * float(stiffened) for name, each in body.stiffening.items()}
    n = len(used)
    rows = [5, *range(6, 6 + n)]  # turning about z, and the modes

    def rates(y):
        angle, q, speed, qdot = y[0], y[1 : n + 1], y[n + 1], y[n + 2 :]
        c, s = np.cos(angle), np.sin(angle)
        A, omega = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]]), np.array([0, 0, speed])
        M = mass_matrix(its, A, q)[np.ix_(rows, rows)]
        force = (quadratic_velocity(its, A, omega, q, qdot) + gravity_force(its, A, q, GRAVITY))[rows]
        force[1:] -= K * q + stiffening(terms, -A.T @ GRAVITY, np.zeros(3), omega) @ q
        M[1:, 0] += terms["angular_acceleration"][2] @ q
        return np.concatenate([[speed], qdot, np.linalg.solve(M, force)])

    state, history = np.zeros(2 * n + 2), [np.zeros(2 * n + 2)]
    for _ in range(round(TIMES[-1] / STEP)):
        k1 = rates(state)
        k2 = rates(state + STEP / 2 * k1)
        k3 = rates(state + STEP / 2 * k2)
        k4 = rates(state + STEP * k3)
        state = state + STEP / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        history.append(state)
    found = np.array(history).T
    local = tip.position[:2, None] + phi[:2] @ found[1 : n + 1]
    c, s = np.cos(found[0]), np.sin(found[0])
    tips = np.array([c * local[0] - s * local[1], s * local[0] + c * local[1]]).T
    return tips[np.rint(np.array(TIMES) / STEP).astype(int)], np.abs(local[1]).max()


@pytest.fixture(scope="module")
def body():
    return reduce(EXAMPLE, overrides={"reduction.reference": "root"}).body


def test_tip_of_the_stiffened_pendulum_is_within_a_millimetre_and_a_half(body):
    tips, deflection = swing(body, stiffened=True)
    assert np.linalg.norm(tips - TIPS, axis=1).max() < 1.5e-3
    assert deflection == pytest.approx(0.0175, abs=1e-3)


@pytest.mark.full
def test_without_geometric_stiffness_it_is_worse(body):
    """Theory: about 4 mm at the tip and out of phase; so the terms have the right sign and size."""
    with_it, without = (np.linalg.norm(swing(body, stiffened=each)[0] - TIPS, axis=1).max() for each in (True, False))
    assert without > 1.5 * with_it
