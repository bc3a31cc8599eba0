"""Ropes over pulleys and winches, against closed forms and SciPy on equations written anew."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from nivel.errors import ModelError
from simulating import G, simulate, slide, solid

K, D = 5e4, 800.0


def hanging(mass=10.0, height=-2.0):
    """A body on a vertical rail below the origin."""
    return {
        "gravity": [0, 0, -G],
        "bodies": {"load": solid(mass, position=[0, 0, height])},
        "joints": {"guide": slide("ground", "load", point=[0, 0, height], axis=[0, 0, 1])},
        "markers": {
            "top": {"body": "ground", "position": [0, 0, 0]},
            "hook": {"body": "load", "position": [0, 0, 0]},
        },
    }


def rope(**more):
    return {"type": "rope", "markers": ["top", "hook"], "stiffness": K, "damping": D, "length": 2.0, **more}


def test_a_load_on_a_winch_follows_its_equation():
    """m z̈ = T - m g with T = k x + d ẋ ≥ 0 of the stretch x = -z - l, l̇ = 0.5 sin 3t."""
    mass = 10.0
    given = {**hanging(mass), "forces": {"rope": rope(speed="0.5*sin(3*time)")}}
    result = simulate(given, duration=2.0, step=2e-4, output_interval=0.02)

    def rate(t, y):
        z, v, length = y
        speed = 0.5 * np.sin(3.0 * t)
        stretch, change = -z - length, -v - speed
        tension = max(K * stretch + D * change, 0.0) if stretch > 0.0 else 0.0
        return v, tension / mass - G, speed

    want = solve_ivp(rate, (0, 2), (-2.0, 0.0, 2.0), t_eval=result.time, rtol=1e-9, atol=1e-11, max_step=1e-3).y
    np.testing.assert_allclose(result.array("guide.displacement"), want[0] + 2.0, atol=1e-5)
    np.testing.assert_allclose(result.array("state.rope.length"), want[2], atol=1e-9)
    stretch = -want[0] - want[2]
    np.testing.assert_allclose(result.array("force.rope.stretch"), stretch, atol=1e-5)


def test_a_slack_rope_does_nothing():
    """Free fall until it is taut."""
    result = simulate({**hanging(), "forces": {"rope": rope(length=2.5)}}, duration=0.25, step=1e-3)
    np.testing.assert_allclose(result.array("guide.displacement"), -0.5 * G * result.time**2, atol=1e-9)
    assert np.all(result.array("force.rope.magnitude") == 0.0)


def test_a_rope_through_a_pulley_block_carries_by_its_falls():
    """Four falls: at rest each has a quarter of the weight, and the rope is stretched by a quarter of it over its stiffness."""
    mass = 40.0
    falls = ["top", "hook", "top", "hook", "top"]
    given = {**hanging(mass), "forces": {"rope": rope(markers=falls, length=8.0, damping=4000.0)}}
    result = simulate(given, duration=4.0, step=1e-3)
    assert result.array("force.rope.magnitude")[-1] == pytest.approx(0.25 * mass * G, rel=1e-5)
    assert result.array("guide.displacement")[-1] == pytest.approx(-0.25 * 0.25 * mass * G / K, rel=1e-4)


def test_two_loads_over_a_pulley_are_atwoods_machine():
    """a = g (m₂ - m₁)/(m₂ + m₁) of a rope that hardly stretches, on average over its vibration."""
    given = hanging(3.0)
    given["bodies"]["other"] = solid(2.0, position=[0, 1, -2.0])
    given["joints"]["other_guide"] = slide("ground", "other", point=[0, 1, -2.0], axis=[0, 0, 1])
    given["markers"] |= {"left": {"body": "ground", "position": [0, 1, 0]}, "other_hook": {"body": "other"}}
    stretched = 2.0 * 2.0 * 3.0 / 5.0 * G / K  # T = 2 m₁ m₂ g/(m₁ + m₂)
    forces = {"rope": rope(markers=["hook", "top", "left", "other_hook"], length=5.0 - 0.5 * stretched)}
    result = simulate({**given, "forces": forces}, duration=0.5, step=5e-4)
    fall = -result.array("guide.displacement")[-1]
    assert fall == pytest.approx(0.5 * G * (3.0 - 2.0) / 5.0 * 0.5**2, rel=1e-3)


def test_work_of_the_winch_and_dissipation_balance_the_energy():
    forces = {"rope": rope(speed="-0.4*(1 + sin(5*time))", length=1.9)}
    result = simulate({**hanging(), "forces": forces}, duration=1.5, step=1e-4)
    work = np.abs(result.array("external_work")).max()
    assert work > 10.0
    # where the rope goes slack or taut within a step, the work of that step is off by a share of the step
    assert np.abs(result.array("energy_error")).max() < 1e-5 * work


def test_the_length_of_a_rope_on_a_winch_is_a_signal():
    """l̇ = v (1 - l/3 m): to 3 m in an exponential."""
    forces = {"rope": rope(speed="2*(1 - rope.length/3)", length=2.0)}
    result = simulate({**hanging(), "forces": forces}, duration=1.0, step=1e-3)
    np.testing.assert_allclose(result.array("state.rope.length"), 3.0 - np.exp(-2.0 / 3.0 * result.time), atol=1e-9)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"markers": ["top"]}, "a rope needs two markers at least"),
        ({"markers": ["top", "top", "hook"]}, "follows itself"),
        ({"markers": ["top", "hock"]}, "did you mean `hook`"),
        ({"length": "2 kg"}, "kg"),
        ({"speed": "rope.lenght"}, "length"),
        ({"stiffness": -1}, "zero or more|greater"),
    ],
)
def test_faults_of_a_rope_are_told(changes, message):
    with pytest.raises(ModelError, match=message):
        simulate({**hanging(), "forces": {"rope": rope(**{"speed": "1", **changes})}})
