"""The residual of implicit methods: it vanishes for what explicit methods find, in every machine, element and kind of coordinates."""

import numpy as np
import pytest

from nivel.analysis.assembly.implicit import find_tangent
from tangent_zoo import EACH, FORMULATED, state_of
from unknowns import TIME, value_at

# round-off, and what friction's iteration is closed to
TOLERANCE = 1e-12


@FORMULATED
@EACH
def test_residual_vanishes_for_accelerations_and_multipliers_of_the_explicit_evaluation(name, coordinates, rng):
    """M v̇ + C_qᵀ λ = Q, C = 0, Ċ = 0, C̈ = 0 and the rates of states; each as a share of the largest term in it."""
    here = state_of(name, coordinates, rng)
    none, nothing = np.zeros(here.n), np.zeros(here.rows)
    r, rates, C, Cdot, Cddot = value_at(here, here.y, here.vdot, here.lam)
    forces, _, _, _, gamma = value_at(here, here.y, none, nothing)
    inertia = value_at(here, here.y, here.vdot, nothing)[0] - forces
    constraint = value_at(here, here.y, none, here.lam)[0] - forces
    largest = max(np.abs(term).max(initial=1e-300) for term in (forces, inertia, constraint))
    assert np.abs(r).max(initial=0.0) < TOLERANCE * largest
    C_q = find_tangent(here.motion, TIME, 1.0, 1.0, 1.0)[1][here.n + here.states :, : here.n]
    speed = np.abs(here.y[here.positions : here.positions + here.n]).max(initial=0.0)
    across, most = np.abs(C_q).sum(axis=1), np.abs(here.vdot).max(initial=0.0)
    assert np.all(np.abs(Cddot) <= TOLERANCE * (across * most + np.abs(gamma).max(initial=0.0) + 1.0 + speed**2))
    assert np.all(np.abs(Cdot) <= TOLERANCE * (1.0 + across * speed))
    assert np.all(np.abs(C) < 1e-8 * max(here.size, 1.0))
    np.testing.assert_allclose(rates, here.xdot, rtol=1e-13)


def test_residual_of_a_moved_state_does_not_vanish(rng):
    """What is left grows by M δ with a change of accelerations and by C_qᵀ δ with one of multipliers: nothing is left out."""
    here = state_of("slider-crank", "absolute", rng)
    before = value_at(here, here.y, here.vdot, here.lam)[0]
    status, matrix = find_tangent(here.motion, TIME, 1e-20, 1e-20, 1e-20)
    assert status == 0
    change, forces = rng.uniform(-1, 1, here.n), rng.uniform(-1, 1, here.rows)
    after = value_at(here, here.y, here.vdot + change, here.lam + forces)[0]
    expected = matrix[: here.n] @ np.concatenate([change, forces])
    np.testing.assert_allclose(after - before, expected, atol=1e-12 * np.abs(matrix).max() * np.abs(here.lam).max())


@pytest.mark.parametrize("name", ["bennett", "four-bar of revolutes", "four-bar-revolutes.yaml"])
def test_redundant_machines_keep_as_many_rows_as_are_independent(name, rng):
    for coordinates in ("absolute", "relative"):
        here = state_of(name, coordinates, rng)
        record = here.motion.system.record
        assert here.rows == int(record.control.rank[0]) < len(record.saddle.row)
        value_at(here, here.y, here.vdot, here.lam)
        matrix = find_tangent(here.motion, TIME, 1e-20, 1e-20, 1e-20)[1]
        C_q = matrix[here.n :, : here.n]
        values = np.linalg.svd(C_q / np.linalg.norm(C_q, axis=1, keepdims=True), compute_uv=False)
        assert values[-1] > 1e-3 * values[0]
