"""Drivers by curves that are at rest at their ends go on without a jump, before and after."""

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

import nivel

MACHINE = """
format: 1
bodies: {cart: {mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}
drivers: {go: {coordinate: rail, value: {times: [1, 2, 3, 4], values: [0, 0.2, 3, 3], interpolation: quintic}}}
simulation: {duration: 6}
"""


@pytest.mark.parametrize("method", [{}, {"integrator": "rk4"}, {"integrator": "radau"}, {"integrator": "newmark"}])
def test_a_driver_rests_before_and_after_its_quintic(tmp_path, method):
    """The spline of degree five with zero rate and acceleration at its ends, by SciPy; its effort is m a."""
    path = tmp_path / "cart.yaml"
    path.write_text(MACHINE, encoding="utf-8")
    result = nivel.load(path).simulate(verify=True, **method)
    rest = [(1, 0.0), (2, 0.0)]
    spline, inside = (
        make_interp_spline([1, 2, 3, 4], [0, 0.2, 3, 3], k=5, bc_type=(rest, rest)),
        np.clip(result.time, 1, 4),
    )
    assert result.array("rail.displacement") == pytest.approx(spline(inside), abs=1e-11)
    assert result.array("driver.go.effort") == pytest.approx(2 * spline.derivative(2)(inside), abs=1e-10)
    assert result.trust.verdict == "green"
