"""Geometric stabilisation puts every state back to the energy that it should have."""

import numpy as np
import pytest

import machines
from running import run

pytestmark = pytest.mark.covering


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_nothing_is_left_of_the_energy_error_of_a_step(coordinates):
    """Steps so long that each errs by far more than round-off."""
    settings = {"integrator": "rk4", "step": 1e-2, "output_interval": 1e-2, "duration": 1.0, "coordinates": coordinates}
    machine = machines.slider_crank()
    left = {kind: run(machine, stabilisation=kind, **settings) for kind in ("direct", "geometric")}
    kinetic = left["direct"].kinetic_energy.max()
    assert np.abs(left["direct"].energy_error).max() > 1e-8 * kinetic
    assert np.abs(left["geometric"].energy_error).max() < 1e-12 * kinetic
