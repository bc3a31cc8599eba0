"""Exact derivatives of all components against differences, and the same run by different methods."""

import numpy as np
import pytest

from circuits import history
from hydraulic_zoo import machine_with_circuits, machine_with_gas, machine_with_warm_oil

pytestmark = pytest.mark.covering


@pytest.mark.parametrize("zoo", [machine_with_circuits, machine_with_gas, machine_with_warm_oil])
@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_all_components_together_move_alike_by_all_methods(coordinates, zoo):
    """A tangent that lacks a dependence makes implicit methods fail or slow, and linearly implicit ones lose their order."""
    built = zoo()
    exact = built.simulate(integrator="dopri5", tolerance=1e-8, duration=0.02, output_interval=1e-3)
    implicit = built.simulate(
        integrator="radau", tolerance=1e-7, duration=0.02, output_interval=1e-3, coordinates=coordinates
    )
    for name in exact.variables:
        if ".pressure" in name and name.startswith("hydraulics."):
            assert history(implicit, name) == pytest.approx(history(exact, name), abs=2e3), name
    assert np.max(np.abs(exact.array("position") - implicit.array("position"))) < 1e-7
    items = {item.name: item for item in implicit.trust.items}
    assert items["hydraulics"].fraction < 1e-6


@pytest.mark.parametrize("zoo", [machine_with_circuits, machine_with_gas, machine_with_warm_oil])
def test_the_extrapolated_method_is_of_order_two(zoo):
    built = zoo()
    exact = built.simulate(integrator="dopri5", tolerance=1e-9, duration=0.02, output_interval=1e-3)

    def error(step):
        found = built.simulate(integrator="extrapolated-euler", step=step, duration=0.02, output_interval=1e-3)
        return np.max(np.abs(found.array("position") - exact.array("position")))

    assert np.log2(error(1e-4) / error(5e-5)) > 1.6
