"""Forces in the sections of a beam against its energy, and against what its ends feel."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from nivel.errors import ModelError
from simulating import simulate

SECTION = {"type": "rectangle", "width": "30 mm", "height": "20 mm"}
STEEL = {"youngs_modulus": "210 GPa", "poisson_ratio": 0.3, "density": "7850 kg/m^3"}


@pytest.fixture(scope="module", params=[1, 2, 3])
def swinging(request):
    """A bar on a hinge that a force at its end swings."""
    bar = {"from": [0, 0, 0], "to": [1.2, 0, 0], "section": SECTION, "material": STEEL, "elements": 6}
    return simulate(
        {
            "beams": {"bar": {**bar, "order": request.param}},
            "joints": {
                "hinge": {"type": "revolute", "bodies": ["ground", "bar.start"], "point": [0, 0, 0], "axis": [0, 1, 0]}
            },
            "forces": {"push": {"type": "force", "body": "bar.end", "vector": [0, 0, 300]}},
            "simulation": {"duration": 0.05, "step": 1e-4, "integrator": "generalised-alpha", "output_interval": 0.005},
        }
    )


def test_energy_is_that_of_the_run(swinging):
    sections = swinging.sections("bar")
    stored = swinging.dataset["potential_energy"].values
    assert stored.max() > 0.1
    assert_allclose(sections["energy"].values, stored, rtol=1e-9, atol=1e-9 * stored.max())


def test_the_hinge_transmits_no_moment_about_its_axis(swinging):
    sections = swinging.sections("bar")
    moment = sections["moment"].sel(component="y").values
    share = sections["share"].values
    at_ends = [np.polynomial.Polynomial.fit(share[:3], row[:3], 2)(0.0) for row in moment[2:]]
    assert np.abs(at_ends).max() < 0.1 * np.abs(moment).max()
    assert np.abs(sections["moment"].sel(component="z").values).max() < 1e-6 * np.abs(moment).max()


def test_a_name_that_is_no_beam_is_refused(swinging):
    with pytest.raises(ModelError, match="bar"):
        swinging.sections("bra")
