"""Runs whose integrator chooses its steps: frames, chunks, limits of the step, failures."""

import numpy as np
import pytest

import machines
from nivel import Body, Joint, JointSpringDamper, MachineRecord, PointForce, SimulationSettings
from nivel.errors import ModelError
from running import run

pytestmark = pytest.mark.covering

CHOOSING = pytest.mark.parametrize("integrator", ["dopri5", "dop853", "adams", "gear", "radau"])
NEWTON = {"corrector": {"iteration": "newton"}}


@CHOOSING
def test_result_is_bit_identical_for_every_chunk_and_buffer(integrator, monkeypatch):
    from nivel.analysis.run import history

    settings = {"duration": 0.5, "integrator": integrator, "tolerance": 1e-5, "output_interval": 7e-3}
    whole = run(machines.slider_crank(), chunk_steps=10_000, **settings)
    for chunk in (1, 7):
        parts = run(machines.slider_crank(), chunk_steps=chunk, **settings)
        assert np.array_equal(whole.frames, parts.frames)
    monkeypatch.setattr(history, "BUFFER_BYTES", 1)
    small = run(machines.slider_crank(), chunk_steps=3, **settings)
    assert np.array_equal(whole.frames, small.frames)


@CHOOSING
def test_frames_are_at_the_multiples_of_the_interval_and_at_the_end(integrator):
    """The interval does not divide the duration; most frames are inside steps."""
    result = run(machines.slider_crank(), duration=0.5, integrator=integrator, tolerance=1e-4, output_interval=3e-3)
    expected = np.append(3e-3 * np.arange(167), 0.5)
    assert np.array_equal(result.time[:-1], 3e-3 * np.arange(167))
    np.testing.assert_allclose(result.time, expected, rtol=0, atol=0)
    assert result.finished.timing["steps"] < 140
    assert np.abs(result.constraint_violation).max() < 1e-12
    assert np.abs(result.constraint_rate_violation).max() < 1e-11


def test_frames_do_not_depend_on_how_many_there_are():
    """Frames inside steps are looked at, not stepped to: the same steps, the same states where times agree."""
    settings = {"duration": 1.0, "integrator": "dopri5", "tolerance": 1e-6}
    few = run(machines.slider_crank(), output_interval=0.5, **settings)
    many = run(machines.slider_crank(), output_interval=2.5e-3, **settings)
    assert few.finished.timing["steps"] == many.finished.timing["steps"]
    np.testing.assert_allclose(many.position[::200], few.position, rtol=0, atol=1e-13)


def test_output_may_be_finer_than_the_first_step():
    result = run(machines.slider_crank(), duration=0.01, integrator="dopri5", step=1e-3, output_interval=1e-4)
    assert len(result.time) == 101


@CHOOSING
@pytest.mark.parametrize("step", [1e-9, 10.0])
def test_first_step_is_only_tried(integrator, step):
    """Far too small or far too large: the motion is the same within the tolerance."""
    settings = {"duration": 1.0, "integrator": integrator, "tolerance": 1e-6, "output_interval": 0.1}
    sensible = run(machines.slider_crank(), step=1e-3, **settings)
    other = run(machines.slider_crank(), step=step, **settings)
    assert np.abs(other.position - sensible.position).max() < 2e-5
    assert other.finished.timing["steps"] < 2 * sensible.finished.timing["steps"] + 40


def test_largest_step_is_kept():
    settings = {"duration": 1.0, "integrator": "dop853", "tolerance": 1e-4, "output_interval": 1.0}
    assert run(machines.slider_crank(), **settings).finished.timing["steps"] < 90
    assert run(machines.slider_crank(), largest_step=0.01, **settings).finished.timing["steps"] >= 100


def spinner(rate):
    return MachineRecord(
        name="spinner",
        bodies=(Body(name="disc", mass=1, inertia=(1, 1, 1), angular_velocity=(0, 0, rate)),),
        joints=(Joint(name="hinge", type="revolute", bodies=("ground", "disc"), point=(0, 0, 0), axis=(0, 0, 1)),),
    )


@CHOOSING
@pytest.mark.parametrize("rate", [100.0, -100.0])
def test_joint_angles_count_their_turns(integrator, rate):
    """At a tolerance where the error would allow a step of more than half a turn."""
    result = run(spinner(rate), duration=1.0, integrator=integrator, tolerance=1e-3, output_interval=0.5)
    np.testing.assert_allclose(result.joint_coordinate[:, 0], rate * result.time, atol=0.05)


def test_force_that_jumps_is_passed():
    """A push that ends at once, at a corner of `abs`: a step ends there, or is cut down to the jump and grows again."""
    machine = MachineRecord(
        name="pushed",
        bodies=(Body(name="stone", mass=2, inertia=(1, 1, 1)),),
        forces=(PointForce(name="push", body="stone", vector=("2 - 2*(time - 0.3)/abs(time - 0.3)", 0, 0)),),
        simulation=SimulationSettings(duration=1.0),
    )
    for integrator in ("dopri5", "dop853", "adams", "gear"):
        result = run(machine, integrator=integrator, tolerance=1e-8, output_interval=0.5)
        assert abs(result.position[-1, 0, 0] - (0.09 + 0.6 * 0.7)) < 1e-7
        assert result.finished.timing["rejected"] < 100


def test_force_that_becomes_infinite_is_named():
    machine = MachineRecord(
        name="burst",
        bodies=(Body(name="stone", mass=1, inertia=(1, 1, 1)),),
        forces=(PointForce(name="push", body="stone", vector=("sqrt(0.5 - time)", 0, 0)),),
        simulation=SimulationSettings(duration=1.0),
    )
    for integrator in ("dopri5", "gear", "radau"):
        result = run(machine, integrator=integrator, output_interval=0.01)
        assert result.finished.outcome == "failed"
        assert "the force push is not a number at t = 0.5" in result.finished.failure[0]
        assert 0.48 < result.time[-1] < 0.5


def test_motion_that_ends_in_infinity_says_that_no_step_is_small_enough():
    """x'' = 6 x² from x = 1, x' = 2: x = 1/(1 - t)², which leaves every bound at t = 1."""
    machine = MachineRecord(
        name="runaway",
        bodies=(Body(name="stone", mass=1, inertia=(1, 1, 1), position=(1, 0, 0), velocity=(2, 0, 0)),),
        joints=(Joint(name="rail", type="translational", bodies=("ground", "stone"), point=(0, 0, 0), axis=(1, 0, 0)),),
        forces=(JointSpringDamper(name="push", coordinate="rail", law="-6*(value + 1)**2"),),
        simulation=SimulationSettings(duration=2.0),
    )
    for integrator in ("dopri5", "dop853", "adams", "gear", "radau"):
        result = run(machine, integrator=integrator, output_interval=0.01, tolerance=1e-6)
        assert result.finished.outcome == "failed"
        message, advice, time = result.finished.failure
        assert 0.99 < time < 1.01
        assert "no step from here" in message
        assert "jump" in advice
        assert "`integrator: bdf`" in advice
        assert ("`integrator: radau`" in advice) == (integrator != "radau")
        np.testing.assert_allclose(result.position[:50, 0, 0], 1 / (1 - result.time[:50]) ** 2, rtol=1e-4)


def test_baumgarte_needs_own_coefficients():
    with pytest.raises(ModelError, match=r"1/step.*`integrator: dopri5` chooses its steps.*own coefficients"):
        run(machines.slider_crank(), integrator="dopri5", stabilisation="baumgarte")
    own = {"stabilisation": "baumgarte", "baumgarte": {"alpha": 20, "beta": 20}}
    result = run(machines.slider_crank(), integrator="dopri5", duration=0.1, **own)
    assert result.finished.outcome == "done"


def test_penalty_without_omega_needs_corrected_states():
    with pytest.raises(ModelError, match=r"0.1/step.*omega"):
        run(machines.slider_crank(), integrator="dop853", formulation="penalty", stabilisation="none")


def test_tolerance_below_round_off_is_refused():
    with pytest.raises(ModelError, match="round-off"):
        run(machines.slider_crank(), integrator="gear", tolerance=1e-13)
