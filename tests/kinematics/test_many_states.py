"""Mechanics asked for rows of states, and its quick equations against those of the reduction."""

from pathlib import Path

import numpy as np
import pytest

import nivel

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize(
    "file",
    ["control/robot-arm.yaml", "mechanisms/slider-crank.yaml", "mechanisms/andrews-squeezer.yaml", "robots/leg.yaml"],
)
def test_quick_equations_are_those_of_the_reduction(file):
    machine = nivel.load(EXAMPLES / file)
    quick, slow = machine.mechanics(), machine.mechanics()
    assert quick._states is not None
    slow._states = None
    rng, body, count = np.random.default_rng(7), [*machine.bodies][-1], len(quick.names)
    marker = next((each.name for each in machine.record.markers if each.body in machine.bodies), body)
    for _ in range(3):
        q = quick.displaced(quick.start, 0.03 * rng.standard_normal(count))
        v, a = rng.standard_normal((2, count))
        pairs = [
            (
                each.mass_matrix(q),
                each.bias(q, v),
                each.inverse_dynamics(q, v, a),
                each.forward_dynamics(q, v, a),
                each.jacobian(body, q),
                each.jacobian(marker, q),
            )
            for each in (quick, slow)
        ]
        for mine, other in zip(*pairs, strict=True):
            np.testing.assert_allclose(mine, other, rtol=1e-8, atol=1e-9 * (1.0 + np.abs(other).max()))


def test_positions_that_are_open_are_closed_first():
    quick, slow = (nivel.load(EXAMPLES / "mechanisms/slider-crank.yaml").mechanics() for _ in range(2))
    slow._states = None
    q = quick.start.copy()
    q[quick.position_names.index(quick.names[0])] += 0.4
    np.testing.assert_allclose(quick.mass_matrix(q), slow.mass_matrix(q), rtol=1e-9)


def test_rows_of_states_give_rows_of_results():
    mechanics = nivel.load(EXAMPLES / "control/robot-arm.yaml").mechanics()
    rng, count = np.random.default_rng(3), len(mechanics.names)
    q, v, a = mechanics.start + 0.2 * rng.standard_normal((3, 5, count))
    rows = mechanics.inverse_dynamics(q, v, a)
    assert rows.shape == (5, count)
    np.testing.assert_array_equal(rows[3], mechanics.inverse_dynamics(q[3], v[3], a[3]))
    assert mechanics.mass_matrix(q).shape == (5, count, count)
    assert mechanics.jacobian([*mechanics._machine.body_named][-1], q).shape == (5, 6, count)
    # one state for all rows of the others
    np.testing.assert_array_equal(mechanics.bias(q[0], v)[4], mechanics.bias(q[0], v[4]))
    back = mechanics.forward_dynamics(q, v, rows)
    np.testing.assert_allclose(back, a, rtol=1e-7, atol=1e-8)


def test_the_arm_of_the_examples_has_its_matrices_whatever_controls_it():
    """Drives on elastic gears move rotors of their own: M of the arm is that without them, and at rest at the start so is its weight."""
    arm = nivel.load(EXAMPLES / "control/six-axis-arm.yaml")
    own, bare = arm.mechanics(), arm.replace(control=(), forces=(), sensors=(), events=()).mechanics()
    random = np.random.default_rng(3)
    q, a = random.uniform(-1.0, 1.0, (2, 6))
    np.testing.assert_allclose(own.mass_matrix(q), bare.mass_matrix(q), rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(own.bias(own.start), bare.bias(own.start), rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(
        own.inverse_dynamics(q, 0.0 * a, a), own.bias(q, 0.0 * a) + own.mass_matrix(q) @ a, rtol=1e-12, atol=1e-9
    )


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
@pytest.mark.parametrize(
    ("file", "step"),
    [
        ("control/robot-arm.yaml", 1e-3),
        ("mechanisms/slider-crank.yaml", 1.0),
        ("mechanisms/andrews-squeezer.yaml", 1.0),
        ("robots/leg.yaml", 1.0),
    ],
)
def test_derivatives_of_efforts_are_those_of_differences(file, step, coordinates):
    """By Richardson's differences of order four. Efforts are quadratic in v, unless the arm's drives reach their limits: steps of 1."""
    mechanics = nivel.load(EXAMPLES / file).mechanics(coordinates=coordinates)
    rng, count = np.random.default_rng(1), len(mechanics.names)
    q = mechanics.displaced(mechanics.start, 0.02 * rng.standard_normal(count))
    v, a = rng.standard_normal((2, count))
    by_q, by_v = mechanics.inverse_dynamics_derivatives(q, v, a)

    def differences(efforts, size):
        near, far = (
            np.array([efforts(h * e) - efforts(-h * e) for e in np.eye(count)]).T / (2.0 * h)
            for h in (0.5 * size, size)
        )
        return (4.0 * near - far) / 3.0

    others = (
        differences(lambda change: mechanics.inverse_dynamics(mechanics.displaced(q, change), v, a), 1e-3),
        differences(lambda change: mechanics.inverse_dynamics(q, v + change, a), step),
    )
    for mine, other in zip((by_q, by_v), others, strict=True):
        np.testing.assert_allclose(mine, other, atol=2e-10 * np.abs(other).max())


def test_derivatives_of_accelerations_follow_from_those_of_efforts():
    mechanics = nivel.load(EXAMPLES / "control/robot-arm.yaml").mechanics()
    rng, count = np.random.default_rng(5), len(mechanics.names)
    q = mechanics.start + 0.2 * rng.standard_normal((2, count))
    v, a = rng.standard_normal((2, 2, count))
    tau = mechanics.inverse_dynamics(q, v, a)
    by_q, by_v = mechanics.inverse_dynamics_derivatives(q, v, a)
    assert by_q.shape == by_v.shape == (2, count, count)
    h, change = 1e-5, rng.standard_normal(count)
    moved = mechanics.forward_dynamics(q + h * change, v, tau) - mechanics.forward_dynamics(q - h * change, v, tau)
    mass = mechanics.mass_matrix(q)
    found = -np.linalg.solve(mass, (by_q @ change)[..., None])[..., 0]
    np.testing.assert_allclose(found, moved / (2.0 * h), atol=1e-7 * np.abs(found).max())


def test_rows_of_other_counts_are_refused():
    mechanics = nivel.load(EXAMPLES / "control/robot-arm.yaml").mechanics()
    q = np.tile(mechanics.start, (3, 1))
    with pytest.raises(nivel.ModelError, match=r"as many in all that is given; got \[2, 3\]"):
        mechanics.bias(q, np.zeros((2, 6)))
    with pytest.raises(nivel.ModelError, match="6 numbers"):
        mechanics.bias(q, np.full((3, 6), np.nan))
