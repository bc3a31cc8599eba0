"""Penalty methods and Baumgarte's feedback with implicit integrators: orders, tolerances, redundant joints, impulses at corners."""

import numpy as np
import pytest

import machines
from nivel.errors import ModelError
from references import slider_crank
from running import reference_run, run
from test_driver_corners import RAMPS, cart_and_arm, swing

pytestmark = pytest.mark.covering

COORDINATES = pytest.mark.parametrize("coordinates", ["absolute", "relative"])
METHODS = {
    "penalty": {"formulation": "penalty"},
    "penalty, fed back": {"formulation": "penalty", "stabilisation": "none", "penalty": {"omega": 100.0}},
    "augmented": {"formulation": "augmented-lagrangian"},
    "augmented, fed back": {
        "formulation": "augmented-lagrangian", "stabilisation": "none", "penalty": {"omega": 100.0},
    },
    "baumgarte": {"stabilisation": "baumgarte", "baumgarte": {"alpha": 100.0, "beta": 100.0}},
}  # fmt: skip
EACH = pytest.mark.parametrize("method", METHODS)
# accelerations that are wrong by 1e-8 of themselves, for 0.4 s and for 1 s
SOFT = 1e-6


@EACH
@COORDINATES
@pytest.mark.parametrize("integrator", ["newmark", "hht", "generalised-alpha", "ros2"])
def test_order_two_in_positions_velocities_and_reactions(integrator, coordinates, method):
    common = {"duration": 0.4, "output_interval": 0.02, "coordinates": coordinates}
    fine = reference_run(machines.slider_crank(), integrator="dop853", tolerance=1e-11, **common)
    errors = []
    for step in (1e-3, 5e-4, 2.5e-4) if integrator == "ros2" else (2e-3, 1e-3, 5e-4):
        r = run(machines.slider_crank(), integrator=integrator, step=step, **common, **METHODS[method])
        assert r.finished.outcome == "done"
        errors.append(
            [np.abs(getattr(r, name) - getattr(fine, name)).max() for name in ("position", "velocity", "joint_force")]
        )
    assert np.all(np.abs(np.log2(np.array(errors)[:-1] / errors[1:]) - 2.0) < 0.35)


@EACH
@COORDINATES
@pytest.mark.parametrize("integrator", ["radau", "bdf"])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6])
def test_tolerance_is_met(integrator, tolerance, coordinates, method):
    settings = {"duration": 1.0, "output_interval": 0.05, "coordinates": coordinates, **METHODS[method]}
    r = run(machines.slider_crank(), integrator=integrator, tolerance=tolerance, **settings)
    assert r.finished.outcome == "done"
    expected = slider_crank.solve(r.time)
    assert np.abs(r.position - expected.position).max() < (10 * tolerance + SOFT) * r.prepared.motion.system.size


@pytest.mark.parametrize("method", ["penalty", "augmented"])
def test_chosen_steps_meet_the_tolerance(method):
    settings = {"integrator": "generalised-alpha", "step_control": "error", "duration": 1.0, "output_interval": 0.013}
    r = run(machines.slider_crank(), tolerance=1e-4, **settings, **METHODS[method])
    expected = slider_crank.solve(r.time)
    assert np.abs(r.position - expected.position).max() < 10 * 1e-4 * r.prepared.motion.system.size


@COORDINATES
@pytest.mark.parametrize("integrator", ["newmark", "radau", "bdf", "ros2"])
@pytest.mark.parametrize("method", ["penalty", "augmented"])
@pytest.mark.parametrize("make", [machines.bennett, lambda: machines.four_bar("revolute", "revolute")])
def test_redundant_joints_share_their_loads_as_with_explicit_methods(make, method, integrator, coordinates):
    """All rows are kept: the penalties say how dependent ones share what they hold."""
    common = {"duration": 0.2, "output_interval": 0.02, "coordinates": coordinates, **METHODS[method]}
    fine = reference_run(make(), integrator="dop853", tolerance=1e-10, **common)
    settings = {"step": 2e-4} if integrator in ("newmark", "ros2") else {"tolerance": 1e-7}
    r = run(make(), integrator=integrator, **common, **settings)
    assert r.finished.outcome == "done"
    assert np.abs(r.position - fine.position).max() < 1e-5
    assert np.abs(r.joint_force - fine.joint_force).max() < 1e-4 * (1.0 + np.abs(fine.joint_force).max())


@EACH
@COORDINATES
def test_impulses_at_corners_of_drivers_keep_order_two(coordinates, method):
    errors = []
    for step in (1e-2, 5e-3, 2.5e-3):
        r = run(cart_and_arm(), coordinates=coordinates, step=step, output_interval=0.1, **METHODS[method])
        assert r.finished.outcome == "done"
        angle, rate = swing(r.time, r.joint_rate[0, 1])
        if METHODS[method].get("stabilisation", "direct") == "direct":
            motion = np.interp(r.time, RAMPS.times, RAMPS.values)
            np.testing.assert_allclose(r.joint_coordinate[:, 0], motion, rtol=0, atol=1e-9)
        errors.append([np.abs(r.joint_coordinate[:, 1] - angle).max(), np.abs(r.joint_rate[:, 1] - rate).max()])
    assert np.all(np.abs(np.log2(np.array(errors[:-1]) / errors[1:]) - 2.0) < 0.35)


def test_a_stiff_spring_is_stepped_over():
    """1e9 N/m along the rod of a slider-crank, at a step of a hundred periods of its vibration: as with multipliers."""
    from stiff_machines import elastic_crank, rigid_crank

    for method in ("penalty", "augmented"):
        for settings in ({"integrator": "generalised-alpha", "step": 1e-3}, {"integrator": "radau", "tolerance": 1e-5}):
            r = run(elastic_crank(1e9), duration=1.0, **settings, **METHODS[method])
            angle = rigid_crank(r.time)
            expected = np.transpose((0.1 * np.cos(angle), 0.1 * np.sin(angle)))
            assert np.abs(r.position[:, 0, :2] - expected).max() < 1e-4


def test_penalties_are_refused_where_multipliers_close_the_positions():
    with pytest.raises(ModelError, match="whose multipliers solve the position constraints"):
        run(machines.slider_crank(), integrator="energy-momentum", stabilisation="none", formulation="penalty")
