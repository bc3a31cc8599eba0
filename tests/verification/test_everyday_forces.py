"""Springs along the global axes, and contact by a law of the user, against closed forms."""

import numpy as np
import pytest

import nivel
from nivel.errors import ModelError
from nivel.files import parse_machine

BLOCK = """
format: 1
bodies: {block: {mass: 2, inertia: [1, 1, 1], position: [0.1, 0.2, 0.3]}}
forces:
  springs:
    type: three-axis-spring
    bodies: [ground, block]
    points: [[0, 0, 0], [0.1, 0.2, 0.3]]
    stiffness: [50 N/m, 200 N/m, 800 N/m]
    free_displacement: [0, 0.1, 0]
    preload: [0, 0, 80 N]
simulation: {duration: 0.5, step: 1 ms}
"""
BALL = """
format: 1
bodies: {ball: {shape: {type: sphere, radius: 10 cm}, mass: 0.5, position: [0, 0, 0.2], velocity: [0, 0, -2]}}
forces:
  floor: {type: contact, body: ball, plane: {body: ground}, law: LAW}
simulation: {duration: 0.2, step: 0.1 ms, output_interval: 0.1 ms}
"""


def run(text):
    return nivel.Machine.from_record(parse_machine(text)).simulate()


def test_every_axis_is_an_oscillator_of_its_own():
    """x = x₀ + A cos(√(k/m) t), about the place where preload and spring balance."""
    result = run(BLOCK)
    k, rest = np.array([50.0, 200.0, 800.0]), np.array([0.0, 0.1, -0.1])
    start = np.array([0.1, 0.2, 0.3])
    t = result.time[:, None]
    expected = rest + (start - rest) * np.cos(np.sqrt(k / 2) * t)
    # error of rk4: (ω h)⁴ ω t / 120
    np.testing.assert_allclose(result.array("block.position"), expected, atol=2e-8)
    np.testing.assert_allclose(result.array("force.springs.force_x"), -50 * expected[:, 0], atol=1e-6)


def test_their_axes_do_not_turn_with_the_bodies():
    """Both ends turn with their bodies by any angle; the force stays -K (r₂ - r₁)."""
    turned = BLOCK.replace("position: [0.1, 0.2, 0.3]", "position: [0.1, 0.2, 0.3], angular_velocity: [3, 5, -4]")
    result = run(turned)
    np.testing.assert_allclose(result.array("block.position"), run(BLOCK).array("block.position"), atol=1e-8)


def test_a_ball_stays_half_a_period_on_a_linear_law_and_leaves_as_fast_as_it_came():
    """Contact lasts π √(m/k), after a free way of 0.1 m at 2 m/s."""
    result = run(BALL.replace("LAW", '"2 kN/m * depth"'))
    down, up = 0.05, 0.05 + np.pi * np.sqrt(0.5 / 2000)
    t, v = result.time, result.array("ball.velocity.z")
    assert v[-1] == pytest.approx(2.0, rel=1e-4)
    touching = result.array("force.floor.normal_force") > 0
    assert t[touching].min() == pytest.approx(down, abs=2e-4)
    assert t[touching].max() == pytest.approx(up, abs=2e-4)


def test_a_law_never_pulls_and_what_its_damping_takes_is_work_done_outside():
    result = run(BALL.replace("LAW", '"2 kN/m * depth + 60 N s/m * rate"'))
    assert result.array("force.floor.normal_force").min() == 0.0
    speed = result.array("ball.velocity.z")[-1]
    assert 0.1 < speed < 1.5
    assert result.array("external_work")[-1] == pytest.approx(0.25 * (speed**2 - 4), rel=1e-4)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("law: LAW", "law: 5 N, stiffness: 4", "must not be given with a `law`"),
        ("law: LAW", "law: 5 N, restitution: 0.4", "must not be given with a `law`"),
        ("law: LAW", "law: 5 N*length", "`length`"),
        ("law: LAW", "stiffness: 1e5", "`restitution` is missing"),
        ("law: LAW", "restitution: 1", "a contact needs a `stiffness`, a `law`"),
    ],
)
def test_a_contact_with_too_much_or_too_little_is_refused(old, new, message):
    with pytest.raises(ModelError, match=message):
        parse_machine(BALL.replace(old, new))


def test_springs_that_do_nothing_are_refused():
    text = BLOCK.replace("    stiffness: [50 N/m, 200 N/m, 800 N/m]\n", "").replace("    preload: [0, 0, 80 N]\n", "")
    with pytest.raises(ModelError, match="needs a `stiffness`, a `damping` or a `preload`"):
        parse_machine(text)
