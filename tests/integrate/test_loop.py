"""The loop: chunks, last step, output times, joint angles, failures."""

import numpy as np
import pytest

import machines
from nivel import Body, Joint, MachineRecord, PointForce, SimulationSettings
from running import run


@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
@pytest.mark.parametrize("stabilisation", ["none", "direct", "baumgarte"])
def test_result_is_bit_identical_for_every_chunk_length(formulation, stabilisation):
    settings = {"duration": 0.2, "step": 1e-3, "output_interval": 3e-3, "formulation": formulation}
    whole = run(machines.slider_crank(), stabilisation=stabilisation, chunk_steps=10_000, **settings)
    for chunk in (1, 7, 64):
        parts = run(machines.slider_crank(), stabilisation=stabilisation, chunk_steps=chunk, **settings)
        assert np.array_equal(whole.frames, parts.frames)


def test_full_output_buffers_lose_nothing(monkeypatch):
    from nivel.analysis.run import history

    whole = run(machines.slider_crank(), duration=0.1, step=1e-3, output_interval=1e-3)
    monkeypatch.setattr(history, "BUFFER_BYTES", 1)
    small = run(machines.slider_crank(), duration=0.1, step=1e-3, output_interval=1e-3)
    assert len(whole.time) == 101
    assert np.array_equal(whole.frames, small.frames)


def test_last_step_ends_at_the_end_and_keeps_its_order():
    """0.25 s at 0.03 s: eight steps and a shorter one; frames at the multiples of the interval and at the end."""
    fall = MachineRecord(name="fall", gravity=(0, 0, -9.81), bodies=(Body(name="b", mass=1, inertia=(1, 1, 1)),))
    result = run(fall, duration=0.25, step=0.03, output_interval=0.06)
    np.testing.assert_allclose(result.time, [0, 0.06, 0.12, 0.18, 0.24, 0.25], atol=1e-15)
    np.testing.assert_allclose(result.position[:, 0, 2], -0.5 * 9.81 * result.time**2, atol=1e-14)
    assert result.finished.timing["steps"] == 9


def test_evaluations_are_four_a_step_and_one_at_the_end():
    result = run(machines.slider_crank(), duration=0.1, step=1e-3)
    assert result.finished.timing["evaluations"] == 4 * 100 + 1


def spinner(rate):
    return MachineRecord(
        name="spinner",
        bodies=(Body(name="disc", mass=1, inertia=(1, 1, 1), angular_velocity=(0, 0, rate)),),
        joints=(Joint(name="hinge", type="revolute", bodies=("ground", "disc"), point=(0, 0, 0), axis=(0, 0, 1)),),
        simulation=SimulationSettings(duration=1.0, step=1e-3, output_interval=0.5),
    )


@pytest.mark.parametrize("rate", [100.0, -100.0])
def test_joint_angles_count_their_turns_between_frames(rate):
    """Eight turns from frame to frame."""
    result = run(spinner(rate))
    np.testing.assert_allclose(result.joint_coordinate[:, 0], rate * result.time, atol=1e-7)
    np.testing.assert_allclose(result.joint_rate[:, 0], rate, atol=1e-11)


@pytest.mark.parametrize("step", [0.5, 1e7, 1e200])
def test_impossible_step_is_named_with_time_joint_and_coordinate(step):
    result = run(machines.slider_crank(), duration=100 * step, step=step, output_interval=step, stabilisation="none")
    assert result.finished.outcome == "failed"
    message, advice, time = result.finished.failure
    assert f"t = {time:.6g} s" in message
    assert f"step of {step:.3g} s" in message
    assert any(joint in message for joint in ("hinge", "pin", "knee", "slide"))
    assert "--step" in advice
    assert np.all(np.isfinite(result.frames))


def test_force_that_becomes_infinite_keeps_what_was_computed():
    machine = MachineRecord(
        name="burst",
        bodies=(Body(name="stone", mass=1, inertia=(1, 1, 1)),),
        forces=(PointForce(name="push", body="stone", vector=("log(0.5 - time)", 0, 0)),),
        simulation=SimulationSettings(duration=1.0, step=1e-3, output_interval=1e-3),
    )
    result = run(machine)
    assert result.finished.outcome == "failed"
    assert 0.49 < result.time[-1] < 0.5
    assert "the force push is not a number" in result.finished.failure[0]


def test_singular_position_is_named():
    """A straight strut closed against the ground by two sliding pins: a planar loop folded flat loses a row."""

    def bar(name, x, angle):
        return Body(
            name=name,
            mass=1,
            inertia=(1e-3, 0.1, 0.1),
            position=(x, 0, 0),
            orientation={"axis": [0, 0, 1], "angle": angle},
        )

    flat = MachineRecord(
        name="flat",
        bodies=(bar("a", 0.5, 0.0), bar("b", 1.5, 0.0)),
        joints=(
            Joint(name="left", type="revolute", bodies=("ground", "a"), point=(0, 0, 0), axis=(0, 0, 1)),
            Joint(name="middle", type="spherical", bodies=("a", "b"), point=(1, 0, 0)),
            Joint(name="right", type="spherical", bodies=("b", "ground"), point=(2, 0, 0)),
        ),
    )
    from nivel.errors import ModelError

    with pytest.raises(ModelError, match="singular position"):
        run(flat)


def test_baumgarte_records_the_reactions_of_the_machine_and_not_of_its_feedback():
    """With α = 1/h the fed-back multipliers are per cent off at any step; the recorded ones converge to those of `direct`."""
    differences = []
    for step in (1e-3, 2.5e-4):
        settings = {"duration": 1.0, "step": step, "output_interval": 0.05}
        plain = run(machines.slider_crank(), stabilisation="direct", **settings)
        fed = run(machines.slider_crank(), stabilisation="baumgarte", **settings)
        differences.append(np.abs(fed.joint_force - plain.joint_force).max() / np.abs(plain.joint_force).max())
    assert differences[0] < 2e-3
    assert differences[1] < differences[0] / 3


def test_expression_that_is_no_number_is_named_with_its_time():
    machine = MachineRecord(
        name="root",
        bodies=(Body(name="stone", mass=1, inertia=(1, 1, 1)),),
        forces=(PointForce(name="push", body="stone", vector=("sqrt(0.5 - time)", 0, 0)),),
        simulation=SimulationSettings(duration=1.0, step=1e-2),
    )
    message, advice, _ = run(machine).finished.failure
    assert "the force push is not a number at t = 0.5" in message
    assert "root" in advice
