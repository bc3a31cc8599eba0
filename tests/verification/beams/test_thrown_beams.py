"""Loads that throw a beam within few steps: Newton's iteration must not end on another branch, where the beam is wound up by its step.

Such a solution is exact to round-off. Only the work tells: it holds a thousand times the energy that the load has given.
"""

import pytest

from simulating import simulate

pytestmark = pytest.mark.covering

STEEL = {"youngs_modulus": "2.07e11 Pa", "poisson_ratio": 0.3, "density": "7801 kg/m^3"}


def thrown(load, elements, model, *, hinged):
    """A bar of steel, 20 mm by 20 mm and 1 m, at rest, whose end a load [N] across it takes hold of."""
    bar = {
        "from": [0, 0, 0],
        "to": [1, 0, 0],
        "section": {"type": "rectangle", "width": "20 mm", "height": "20 mm"},
        "material": STEEL,
        "elements": elements,
        "model": model,
    }
    pivot = {"type": "revolute", "bodies": ["ground", "bar.start"], "point": [0, 0, 0], "axis": [0, 0, 1]}
    return {
        "gravity": [0, -9.81, 0],
        "beams": {"bar": bar},
        "joints": {"pivot": pivot} if hinged else {},
        "forces": {"pull": {"type": "force", "body": "bar.end", "vector": [0, load, 0]}},
    }


@pytest.mark.parametrize("integrator", ["newmark", "hht", "generalised-alpha"])
@pytest.mark.parametrize("model", ["geometrically-exact", "ancf-cable"])
@pytest.mark.parametrize("hinged", [True, False])
@pytest.mark.parametrize("elements", [4, 8, 16])
def test_energy_is_the_work_of_the_load(integrator, model, hinged, elements):
    """2 kN would bend the bar by a quarter of its length if its start was clamped."""
    result = simulate(thrown(2e3, elements, model, hinged=hinged), integrator=integrator, step="1 ms", duration="60 ms")
    assert result.trust.energy_error_max < 1e-2 * result.trust.energy_scale
