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


ROPE = """
format: 1
bodies:
  jib: {mass: 5, inertia: [1, 1, 1], position: [1, 0, 2], orientation: {axis: [0, 0, 1], angle: 40 deg}}
  load: {mass: 2, inertia: [1, 1, 1], position: [1, 0, 0]}
joints: {clamp: {type: fixed, bodies: [ground, jib], point: [1, 0, 2]}}
markers: {drum: {body: ground}, head: {body: jib}, hook: {body: load}}
forces: {rope: {type: rope, WAY, stiffness: 1e4, length: 4}}
simulation: {duration: 0.05, step: 1 ms}
"""
POINTS = "bodies: [ground, jib, load], points: [[0, 0, 0], [1, 0, 2], [1, 0, 0]]"


def test_a_rope_by_points_is_the_rope_by_markers_there():
    by_points, by_markers = (run(ROPE.replace("WAY", way)) for way in (POINTS, "markers: [drum, head, hook]"))
    tension = by_points.array("force.rope.magnitude")
    np.testing.assert_array_equal(tension, by_markers.array("force.rope.magnitude"))
    assert tension[0] == pytest.approx(1e4 * (np.sqrt(5) + 2 - 4), rel=1e-12)


@pytest.mark.parametrize(
    ("way", "message"),
    [
        ("bodies: [ground, load]", "one of `points` for each"),
        ("bodies: [ground, load], points: [[0, 0, 0]]", "there are 2 bodies, 1 points"),
        ("bodies: [load], points: [[0, 0, 0]]", "needs two points at least"),
        ("bodies: [ground, load, load], points: [[0, 0, 0], [1, 0, 0], [1, 0, 0]]", "follows itself"),
        ("markers: [drum, hook], bodies: [ground, load]", "must not be given with `markers`"),
        ("bodies: [ground, laod], points: [[0, 0, 0], [1, 0, 0]]", "did you mean `load`"),
    ],
)
def test_a_rope_whose_way_is_not_clear_is_refused(way, message):
    with pytest.raises(ModelError, match=message):
        parse_machine(ROPE.replace("WAY", way))


def placed(angle):
    machine = nivel.Machine.from_record(parse_machine(BLOCK))
    return machine.with_part("left", machine, orientation={"axis": [0, 0, 1], "angle": angle}).forces["left_springs"]


def test_a_part_turned_by_a_quarter_has_its_springs_along_the_other_axes():
    spring = placed("90 deg")
    np.testing.assert_allclose(spring.stiffness, [200, 50, 800], rtol=1e-12)
    np.testing.assert_allclose(spring.free_displacement, [-0.1, 0, 0], atol=1e-15)
    np.testing.assert_allclose(spring.preload, [0, 0, 80], atol=1e-12)


def test_a_part_turned_otherwise_is_refused_where_its_springs_would_leave_the_global_axes():
    with pytest.raises(ModelError, match=r"along other axes than the global ones; take a bushing"):
        placed("30 deg")
