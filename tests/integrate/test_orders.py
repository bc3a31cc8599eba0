"""Every integrator converges with its order: on machines with constraints, in both formulations, on rotations, with a shorter last step."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import machines
from lanes import FULL, tail
from nivel import Body, MachineRecord
from nivel.integrate.catalogue import INTEGRATORS
from references import heavy_top as heavy_top_reference
from references import slider_crank as slider_crank_reference
from references.solution import Solution
from running import run

pytestmark = pytest.mark.covering

FIXED = [name for name, facts in INTEGRATORS.items() if not facts.chooses_steps]
# The iteration's error must stay below that of the finest step.
TIGHT = {"tolerance": 1e-13}
# Longest step [s], by order: all in the range where the error is its leading term, far above round-off.
LONGEST = {1: 4e-4, 2: 2e-3, 3: 8e-3, 4: 4e-3, 5: 8e-3}


def slope(steps, errors):
    """Fitted exponent of the error against the step."""
    return np.polyfit(np.log(steps), np.log(errors), 1)[0]


def slider_crank_errors(name, steps, duration, **settings):
    """Root mean square of the errors of all positions [m] at the frames, for each step."""
    errors = []
    for step in steps:
        result = run(
            machines.slider_crank(), duration=duration, step=step, output_interval=0.08, integrator=name, **settings
        )
        assert result.finished.outcome == "done", result.finished.failure
        expected = slider_crank_reference.solve(result.time)
        errors.append(np.sqrt(np.mean((result.position - expected.position) ** 2)))
    return errors


def corrector(name, **more):
    return {"corrector": {**TIGHT, **more}} if INTEGRATORS[name].kind == "corrector" else {}


@pytest.mark.parametrize("name", FIXED)
def test_order_on_the_slider_crank_with_direct_correction(name):
    order = INTEGRATORS[name].order
    steps = LONGEST[order] * np.array([1, 1 / 2, 1 / 4, 1 / 8] if FULL else [1, 1 / 2, 1 / 4])
    # one over a whole step closes the positions itself
    own = {"stabilisation": "none"} if INTEGRATORS[name].needs == "whole steps" else {}
    errors = slider_crank_errors(name, steps, 0.8, **own, **corrector(name))
    assert abs(slope(steps, errors) - order) < 0.2, errors


@pytest.mark.parametrize("name", ["heun", "rkn4", "ab3", "am4", "abm5", "gear4"])
@pytest.mark.parametrize("stabilisation", ["none", "direct"])
def test_order_in_lagrange(name, stabilisation):
    order = INTEGRATORS[name].order
    steps = LONGEST[order] * np.array([1 / 2, 1 / 4, 1 / 8])
    errors = slider_crank_errors(
        name, steps, 0.8, formulation="lagrange", stabilisation=stabilisation, **corrector(name)
    )
    assert abs(slope(steps, errors) - order) < 0.2, errors


@pytest.mark.parametrize(
    "name", tail(["am1", "am2", "am5", "gear1", "gear2", "gear3", "gear4"], ["am1", "am5", "gear1", "gear4"])
)
def test_order_with_newtons_iteration(name):
    order = INTEGRATORS[name].order
    steps = LONGEST[order] * np.array([1 / 2, 1 / 4, 1 / 8])
    errors = slider_crank_errors(name, steps, 0.8, **corrector(name, iteration="newton", tolerance=1e-12))
    assert abs(slope(steps, errors) - order) < 0.2, errors


@pytest.mark.parametrize("name", ["heun", "rkn4", "ab4", "ab5", "am5", "abm4", "gear4"])
def test_shorter_last_step_keeps_the_order(name):
    """The end is 0.37 of a step after the last full one; the error there is that of all steps before and of the short one."""
    order = INTEGRATORS[name].order
    errors, steps = [], LONGEST[order] * np.array([1 / 2, 1 / 4, 1 / 8])
    for step in steps:
        duration = (round(0.4 / step) + 0.37) * step
        result = run(machines.slider_crank(), duration=duration, step=step, integrator=name, **corrector(name))
        assert result.time[-1] == duration
        expected = slider_crank_reference.solve(np.array([0.0, duration]))
        errors.append(np.sqrt(np.mean((result.position[-1] - expected.position[-1]) ** 2)))
    assert abs(slope(steps, errors) - order) < 0.2, errors


MOMENTS = np.array([1.0, 2.0, 2.5])  # of inertia [kg m²]


def tumbling():
    """A free body about its middle axis nearly: it turns over and over."""
    return MachineRecord(
        name="tumbling", bodies=(Body(name="b", mass=1, inertia=(1, 2, 2.5), angular_velocity_body=(0.2, 4.0, 0.3)),)
    )


@cache
def turning_over():
    """Euler parameters and angular velocity in body axes of that body."""

    def rates(_, state):
        e, w = state[:4], state[4:]
        product = np.concatenate([[-e[1:] @ w], e[0] * w + np.cross(e[1:], w)])
        return np.concatenate([0.5 * product, np.cross(MOMENTS * w, w) / MOMENTS])

    return Solution(rates, 0.0, [1, 0, 0, 0, 0.2, 4.0, 0.3], rtol=1e-13, atol=1e-14)


def tumbled(times):
    """Rotation matrices (n, 3, 3) of that body, by DOP853; its angular momentum in global axes is constant."""
    state = turning_over()(times).T
    A = Rotation.from_quat(state[:, :4], scalar_first=True).as_matrix()
    momentum = np.einsum("nij,nj->ni", A, MOMENTS * state[:, 4:])
    np.testing.assert_allclose(momentum, momentum[:1].repeat(len(times), 0), atol=1e-11)
    return A


@pytest.mark.parametrize("name", ["rkn4", "rk4", "ab4", "abm4", "gear4"])
@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
def test_order_on_a_tumbling_body(name, formulation):
    errors, steps = [], np.array([1e-2, 5e-3, 2.5e-3])
    for step in steps:
        settings = {"duration": 4.0, "step": step, "output_interval": 0.5, "formulation": formulation}
        result = run(tumbling(), integrator=name, **settings, **corrector(name))
        A = Rotation.from_quat(result.orientation[:, 0], scalar_first=True).as_matrix()
        errors.append(np.abs(A - tumbled(result.time)).max())
    assert abs(slope(steps, errors) - 4) < 0.2, errors


@pytest.mark.parametrize("name", tail(["rkn4", "abm4", "gear4"], ["rkn4", "abm4"]))
@pytest.mark.parametrize("coordinates", tail(["absolute", "relative"], ["relative"]))
def test_order_on_the_heavy_top(name, coordinates):
    """24 turns a second: 0.8 ms are an eighth of a radian. In relative coordinates the state is that of its spherical joint."""
    errors, steps = [], np.array([8e-4, 4e-4, 2e-4])
    for step in steps:
        settings = {"duration": 0.4, "step": step, "output_interval": 0.04, "coordinates": coordinates}
        result = run(
            machines.heavy_top(), integrator=name, **settings, **corrector(name, iteration="newton", tolerance=1e-12)
        )
        A = Rotation.from_quat(result.orientation[:, 0], scalar_first=True).as_matrix()
        errors.append(np.abs(A - heavy_top_reference.solve(result.time).rotation).max())
    assert abs(slope(steps, errors) - 4) < 0.2, errors


def test_rkn4_integrates_forces_with_order_four_as_well():
    """The work of the drive of the slider-crank is its torque times the angle of the crank."""
    errors, steps = [], np.array([8e-3, 4e-3, 2e-3])
    for step in steps:
        result = run(machines.slider_crank(), duration=0.8, step=step, output_interval=0.08, integrator="rkn4")
        work = slider_crank_reference.solve(result.time).work
        errors.append(np.abs(result.external_work - work).max())
    assert abs(slope(steps, errors) - 4) < 0.2, errors
