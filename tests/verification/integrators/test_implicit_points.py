"""Point masses in implicit methods: they do not turn, so nothing holds their rotation, and the matrix must have a pivot for it."""

import numpy as np
import pytest

import linked
from nivel.analysis.assembly.implicit import find_tangent
from running import reference_run, run
from simulating import G
from tangent_zoo import COORDINATES
from unknowns import SHARES, TIME, moving, value_at

pytestmark = pytest.mark.covering

LENGTHS, MASSES = (0.8, 0.5), (1.0, 0.4)


def beads(**simulation):
    """Two point masses on rods without mass: a double pendulum in space."""
    places = [[LENGTHS[0], 0.0, 0.0], [LENGTHS[0], 0.0, LENGTHS[1]]]
    bodies = {
        name: {"mass": mass, "point_mass": True, "position": place}
        for name, mass, place in zip("ab", MASSES, places, strict=True)
    }
    joints = {
        "upper": {"type": "distance", "bodies": ["ground", "a"], "points": [[0, 0, 0], places[0]]},
        "lower": {"type": "distance", "bodies": ["a", "b"], "points": places},
    }
    return linked.record({"gravity": [0, -G, 0], "bodies": bodies, "joints": joints, "simulation": simulation})


@COORDINATES
def test_matrix_of_point_masses_is_regular(coordinates, rng):
    for here in moving(beads(), coordinates, rng, 3):
        value_at(here, here.y, here.vdot, here.lam)
        status, matrix = find_tangent(here.motion, TIME, *SHARES)
        assert status == 0
        assert np.linalg.cond(matrix) < 1e4


@COORDINATES
@pytest.mark.parametrize("stabilisation", ["direct", "none"])
def test_generalised_alpha_swings_beads_and_leaves_them_unturned(coordinates, stabilisation):
    """Against a Runge–Kutta solution at a tolerance of 1e-10; of order two: half the step, a quarter of the error."""
    settings = {"duration": 0.5, "output_interval": 0.05, "coordinates": coordinates}
    exact = reference_run(beads(), **settings, integrator="dop853", tolerance=1e-10)
    errors = []
    for step in (2e-3, 1e-3):
        more = {"integrator": "generalised-alpha", "stabilisation": stabilisation, "step": step}
        found = run(beads(), **settings, **more)
        assert found.finished.outcome == "done"
        errors.append(np.abs(found.position - exact.position).max())
        np.testing.assert_allclose(found.angular_velocity, 0.0, atol=1e-12)
    assert errors[1] < 1e-4
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)
