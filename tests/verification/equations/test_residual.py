"""The residual of implicit methods away from equilibrium, and of redundant machines; see also `test_residual_and_tangent`."""

import numpy as np
import pytest

from nivel.analysis.assembly.implicit import find_tangent
from tangent_zoo import state_of
from unknowns import TIME, value_at

pytestmark = pytest.mark.covering


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
