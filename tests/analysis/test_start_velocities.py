"""Velocities at the start: given ones are kept, the others follow with the least kinetic energy, and what cannot be reached is said."""

import numpy as np
import pytest

from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.equations import equations
from nivel.api import Machine
from nivel.errors import ModelError
from nivel.files import parse_machine

LENGTHS, MASSES, ANGLES = np.array([0.4, 0.7, 0.3]), np.array([2.0, 0.5, 30.0]), np.array([0.3, -0.9, 1.4])
MOMENTS = np.array([0.1, 0.02, 3.0])


def chain(rates, velocities=("", "", "")):
    """Three rods in a row in the plane, each turned by one of ANGLES. rates : of the first hinge; velocities : further keys of the rods."""
    places = np.vstack(
        [np.zeros(2), np.cumsum(LENGTHS[:, None] * np.stack([np.cos(ANGLES), np.sin(ANGLES)], 1), axis=0)]
    )
    lines = ["format: 1", "bodies:"]
    for k in range(3):
        x, y = 0.5 * (places[k] + places[k + 1])
        lines.append(
            f"  rod{k}: {{mass: {MASSES[k]}, inertia: [{MOMENTS[k]}, {MOMENTS[k]}, {MOMENTS[k]}], position: [{x}, {y}, 0]{velocities[k]}}}"
        )
    lines.append("joints:")
    for k in range(3):
        bodies = f"[{'ground' if k == 0 else f'rod{k - 1}'}, rod{k}]"
        start = rates if k == 0 else ""
        lines.append(
            f"  j{k}: {{type: revolute, bodies: {bodies}, point: [{places[k][0]}, {places[k][1]}, 0], axis: [0, 0, 1]{start}}}"
        )
    return parse_machine("\n".join(lines))


def mass_matrix():
    """(3, 3) of the angular velocities of the rods: T = ½ Σ m |ṙ|² + J ω², ṙ_k = Σ l_j ω_j n_j + ½ l_k ω_k n_k, n across the rod."""
    across = np.stack([-np.sin(ANGLES), np.cos(ANGLES)], 1)
    M = np.diag(MOMENTS)
    for k in range(3):
        J = np.zeros((2, 3))
        for j in range(k + 1):
            J[:, j] = LENGTHS[j] * across[j] * (0.5 if j == k else 1.0)
        M = M + MASSES[k] * J.T @ J
    return M


def turning(machine, formulation="newton-euler"):
    """Angular velocities of the rods about z as assembled, by the machine's own motion equations."""
    motion = equations(machine, formulation)
    assembly = assemble(machine, motion)
    motion.evaluate(0.0, assembly.y)
    return motion.system.record.bodies.omega[:3, 2].copy(), assembly


@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
def test_what_a_rate_sets_in_motion_has_the_least_kinetic_energy(formulation):
    """ω₁ given: M₂₂ ω₂ = -M₂₁ ω₁ for the rest (Kelvin's theorem of a motion by impulses)."""
    M = mass_matrix()
    expected = np.append(5.0, -np.linalg.solve(M[1:, 1:], M[1:, 0] * 5.0))
    found, assembly = turning(chain(", start_rates: {angle: 5}"), formulation)
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    assert assembly.followed == ("rod0", "rod1", "rod2")


def test_given_velocities_are_kept_and_the_rest_follows():
    """The last rod turns as given, and so does the first: only the one between has to follow, by -M₂ᵢ ωᵢ/M₂₂."""
    M = mass_matrix()
    expected = np.array([5.0, 0.0, -2.0])
    expected[1] = -(M[1] @ expected) / M[1, 1]
    found, assembly = turning(chain(", start_rates: {angle: 5}", ("", "", ", angular_velocity: [0, 0, -2]")))
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    assert assembly.followed == ("rod0", "rod1")


def test_a_velocity_of_the_middle_gives_a_hinged_rod_its_turning():
    """Given alone, it is kept to the last digit, and the angular velocity is v over the half length."""
    speed = 0.5 * LENGTHS[0] * 3.0 * np.array([-np.sin(ANGLES[0]), np.cos(ANGLES[0])])
    machine = chain("", (f", velocity: [{speed[0]}, {speed[1]}, 0]", "", ""))
    assert turning(machine)[0][0] == pytest.approx(3.0, rel=1e-12)


def test_given_velocities_that_do_not_fit_are_changed_and_named():
    """Across the hinge the rod cannot go: it keeps nothing of it."""
    away = np.array([np.cos(ANGLES[0]), np.sin(ANGLES[0])])
    found, assembly = turning(chain("", (f", velocity: [{away[0]}, {away[1]}, 0]", "", "")))
    np.testing.assert_allclose(found, 0.0, atol=1e-9)
    assert [(name, pytest.approx(speed)) for name, speed, _ in assembly.velocity_change] == [("rod0", 1.0)]
    assert assembly.followed == ()


def test_the_check_tells_what_follows_from_the_joints():
    text = str(Machine.from_record(chain(", start_rates: {angle: 5}")).check())
    assert "follow from the joints and the masses (least kinetic energy): rod0, rod1, rod2" in text


def test_rates_that_contradict_a_given_velocity_are_kept_and_the_velocity_yields():
    found, assembly = turning(chain(", start_rates: {angle: 5}", (", angular_velocity: [0, 0, 1]", "", "")))
    assert found[0] == pytest.approx(5.0, rel=1e-12)
    assert [name for name, _, _ in assembly.velocity_change if name not in assembly.followed] == ["rod0"]


def test_rates_that_cannot_be_had_are_still_refused():
    fixed = chain(", start_rates: {angle: 5}", ("", "", ""))
    locked = fixed.replace(joints=(*fixed.joints, fixed.joints[0].replace(name="again", start_rates={"angle": 1.0})))
    with pytest.raises(ModelError, match="cannot be reached"):
        turning(locked)
