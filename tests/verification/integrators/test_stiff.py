"""Stiff forces: BDF with Newton's iteration steps over what explicit methods have to follow."""

import numpy as np
import pytest

from nivel import Body, Joint, JointSpringDamper, MachineRecord, SimulationSettings
from running import run

pytestmark = pytest.mark.covering

MASS, STIFFNESS, DAMPING = 0.01, 500.0, 1000.0
NEWTON = {"corrector": {"iteration": "newton"}}


def overdamped():
    """A light block on a spring and a strong damper: rates of about -c/m = -1e5/s and -k/c = -0.5/s."""
    return MachineRecord(
        name="overdamped",
        bodies=(Body(name="block", mass=MASS, inertia=(1e-4,) * 3),),
        joints=(Joint(name="rail", type="translational", bodies=("ground", "block"), point=(0, 0, 0), axis=(1, 0, 0)),),
        forces=(
            JointSpringDamper(name="buffer", coordinate="rail", stiffness=STIFFNESS, damping=DAMPING, free_value=1.0),
        ),
        simulation=SimulationSettings(duration=2.0, step=1e-4, output_interval=0.1),
    )


def closed_form(times):
    """m ẍ + c ẋ + k (x - 1) = 0 from rest at 0."""
    root = np.sqrt(DAMPING**2 - 4 * MASS * STIFFNESS)
    slow, fast = -2 * STIFFNESS / (DAMPING + root), (-DAMPING - root) / (2 * MASS)
    return 1 - (fast * np.exp(slow * times) - slow * np.exp(fast * times)) / (fast - slow)


def test_gear_with_newton_needs_far_fewer_evaluations_than_an_explicit_method():
    """2 s: an explicit method needs about 1e5 · 2 s/3.3 steps of seven evaluations, whatever the tolerance."""
    stiff = run(overdamped(), integrator="gear", tolerance=1e-6, **NEWTON)
    explicit = run(overdamped(), integrator="dopri5", tolerance=1e-6)
    for result in (stiff, explicit):
        assert np.abs(result.position[:, 0, 0] - closed_form(result.time)).max() < 1e-5
    assert explicit.finished.timing["evaluations"] > 3e5
    assert stiff.finished.timing["evaluations"] < 3000


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
def test_newton_meets_the_tolerance(tolerance):
    for integrator in ("gear", "adams"):
        if integrator == "adams" and tolerance < 1e-6:
            continue  # orders above two of Adams–Moulton are not for stiff equations: it creeps
        result = run(overdamped(), integrator=integrator, tolerance=tolerance, duration=0.5, **NEWTON)
        assert np.abs(result.position[:, 0, 0] - closed_form(result.time)).max() < 10 * tolerance


def test_newton_and_functional_iteration_agree_where_nothing_is_stiff():
    import machines
    from references import slider_crank

    for integrator in ("gear", "adams"):
        result = run(machines.slider_crank(), duration=1.0, output_interval=0.1, integrator=integrator, **NEWTON)
        expected = slider_crank.solve(result.time)
        assert np.abs(result.position - expected.position).max() < 1e-5 * result.prepared.motion.system.size
