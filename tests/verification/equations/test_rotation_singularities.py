"""Where rotation coordinates carry a motion for ever, and how a run ends where they cannot."""

import numpy as np
import pytest

import machines
from nivel.errors import SolveError
from references import slider_crank as slider_crank_reference
from running import run
from simulating import simulate, solid

# sin φ₂ or sin(ψ/2)/(ψ/2) at which a run stops
NEAREST = 0.05


def test_angles_turn_for_ever_where_the_axis_of_the_turn_stays():
    """The crank makes more than ten turns in 8 s; the hinge's axis is its third, so it stays as far from the singular position."""
    result = run(
        machines.slider_crank(), step=1e-3, output_interval=0.05, formulation="lagrange", rotations="euler-angles"
    )
    assert result.finished.outcome == "done"
    assert np.abs(result.joint_coordinate[-1, 0]) > 20 * np.pi
    expected = slider_crank_reference.solve(result.time)
    assert np.abs(result.position - expected.position).max() < 1e-6
    assert np.abs(result.energy_error).max() < 1e-6 * result.kinetic_energy.max()
    regularity = result.prepared.motion.system.record.rotations.regularity
    assert abs(regularity[0] - 1.0) < 1e-10


def test_a_rotation_vector_stops_the_crank_before_a_full_turn():
    """sin(ψ/2)/(ψ/2) = 0.05 at ψ = 5.982 rad; the frames up to there are those of Euler parameters."""
    settings = {"step": 1e-3, "output_interval": 1e-3, "formulation": "lagrange"}
    result = run(machines.slider_crank(), rotations="rotation-vector", **settings)
    assert result.finished.outcome == "failed"
    message, advice, time = result.finished.failure
    assert "rotation coordinates of crank" in message
    assert "euler-parameters" in advice
    expected = run(machines.slider_crank(), **settings)
    np.testing.assert_allclose(result.position, expected.position[: len(result.time)], atol=1e-7)
    angle = np.abs(np.interp(time, expected.time, expected.joint_coordinate[:, 0]) - expected.joint_coordinate[0, 0])
    half = angle / 2
    assert np.sin(half) / half == pytest.approx(NEAREST, abs=0.01)


@pytest.mark.parametrize(
    ("rotations", "angle"),
    [
        # from φ₂ = π/2 to sin φ₂ = 0.05
        ("euler-angles", np.pi / 2 - np.arcsin(NEAREST)),
        # sin(ψ/2) = 0.05 ψ/2
        ("rotation-vector", 5.981960),
    ],
)
def test_a_tumbling_body_stops_before_the_singular_position_and_keeps_its_result(rotations, angle):
    """At rest and free, turned about x by a constant torque T: t = √(2 J angle/T). The third axis is z, the first y."""
    J, T = 0.5, 2.0
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {"rock": solid(inertia=(J, 0.7, 0.9)), "still": solid(position=[1, 0, 0])},
        "forces": {"twist": {"type": "torque", "body": "rock", "vector": [T, 0, 0]}},
    }
    with pytest.raises(SolveError, match="rotation coordinates of rock come to a singular position") as caught:
        simulate(sections, duration=4.0, step=1e-3, output_interval=0.01, formulation="lagrange", rotations=rotations)
    failure = caught.value
    stopped = np.sqrt(2 * J * angle / T)
    assert stopped - 1.1e-3 <= failure.time <= stopped
    assert "--rotations euler-parameters" in failure.advice
    result = failure.result
    assert result.outcome == "failed"
    t = result.time
    assert t[-1] == pytest.approx(failure.time, abs=0.01)
    np.testing.assert_allclose(result.array("angular_velocity")[:, 0, 0], T * t / J, atol=1e-9)
