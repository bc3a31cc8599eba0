"""Campbell's diagram of a rotor on springs of two stiffnesses, against an eigenproblem written by hand."""

import numpy as np
import pytest
from scipy.optimize import brentq

from nivel.results.analyses.linear_sweep import LinearSweep
from simulating import machine

MASS, ACROSS, AXIAL = 12.0, 0.21, 0.34
# place along the axis, stiffness and damping across it
BEARINGS = ((-0.18, (80e3, 50e3), (30.0, 20.0)), (0.27, (60e3, 45e3), (25.0, 40.0)))


def rotor(speed):
    supports = {
        f"bearing_{k}": {
            "type": "three-axis-spring",
            "bodies": ["ground", "rotor"],
            "points": [[0, 0, z], [0, 0, z]],
            "stiffness": [*stiffness, 0],
            "damping": [*damping, 0],
        }
        for k, (z, stiffness, damping) in enumerate(BEARINGS)
    }
    body = {"mass": MASS, "inertia": [ACROSS, ACROSS, AXIAL], "angular_velocity": [0, 0, speed]}
    thrust = {
        "type": "three-axis-spring",
        "bodies": ["ground", "rotor"],
        "points": [[0, 0, 0], [0, 0, 0]],
        "stiffness": [0, 0, 1e5],
        "damping": [0, 0, 0],
    }
    return machine({"bodies": {"rotor": body}, "forces": {**supports, "thrust": thrust}})


def reference(speed):
    """Eigenvalues (4,) of x, y and the tilts a, b about them, points moving by x + z b, y - z a; those above the real axis."""
    M, D, K = np.diag([MASS, MASS, ACROSS, ACROSS]), np.zeros((4, 4)), np.zeros((4, 4))
    for z, stiffness, damping in BEARINGS:
        points = np.array([[1.0, 0.0, 0.0, z], [0.0, 1.0, -z, 0.0]])
        K += points.T @ np.diag(stiffness) @ points
        D += points.T @ np.diag(damping) @ points
    D[2, 3], D[3, 2] = AXIAL * speed, -AXIAL * speed
    A = np.block([[np.zeros((4, 4)), np.eye(4)], [-np.linalg.solve(M, K), -np.linalg.solve(M, D)]])
    values = np.linalg.eigvals(A)
    return np.sort_complex(values[values.imag > 0.0] * -1j) * 1j


@pytest.mark.parametrize("speed", [0.0, 60.0, 300.0])
def test_whirling_has_the_eigenvalues_of_the_equations_by_hand(speed):
    found = rotor(speed).linearise().eigenvalues
    for wanted in reference(speed):
        assert np.min(np.abs(found - wanted)) < 1e-8 * abs(wanted)


def test_crossings_in_rpm_are_those_of_the_equations_by_hand():
    """86.7, 103.4 and 108.6 rad/s, and the bounce along the axis at √(k/m)."""

    def gap(speed, k):
        return reference(speed)[k].imag - speed

    met = [k for k in range(4) if gap(40.0, k) * gap(160.0, k) < 0.0]
    wanted = [np.sqrt(1e5 / MASS), *(brentq(gap, 40.0, 160.0, args=(k,)) for k in met)]
    values = np.linspace(400.0, 1500.0, 12)
    models = tuple(rotor(value * np.pi / 30.0).linearise() for value in values)
    found = LinearSweep("speed", "rpm", values, models).crossings([1.0])
    np.testing.assert_allclose(sorted(each.speed for each in found), sorted(wanted), rtol=2e-3)
    np.testing.assert_allclose(sorted(wanted)[::2] + sorted(wanted)[3:], [86.7, 103.4, 108.6], rtol=1e-3)


@pytest.mark.parametrize("speed", [0.0, 150.0, 700.0])
def test_a_jeffcott_rotor_off_the_middle_whirls_as_its_quartic_says(speed):
    """A thin disc on a massless shaft that is simply supported, a from one end and b from the other. With w = x + iy and the slope
    s = w' of the shaft at the disc, w = F a²b²/(3EIL) + M ab(b-a)/(3EIL), s = F ab(b-a)/(3EIL) + M (a³+b³)/(3EIL²); whirling e^{iωt} has
    (k₁₁ - m ω²)(k₂₂ + I_p Ω ω - I_d ω²) = k₁₂², forward where ω > 0 (Genta 2005, §2.4). Two springs have the stiffness of the shaft: one at
    the disc, and one of k₁₂²/k₂₂ at k₂₂/k₁₂ along the axis."""
    a, b, bending, mass, across, axial = 0.25, 0.55, 210e9 * np.pi * 0.02**4 / 64.0, 8.0, 0.06, 1e7
    length, spin, coupled = a + b, 2.0 * across * speed, a * b * (b - a)
    give = np.array([[a**2 * b**2, coupled], [coupled, (a**3 + b**3) / length]]) / (3.0 * bending * length)
    (k11, k12), (_, k22) = np.linalg.inv(give)
    springs = {
        f"at_{k}": {
            "type": "three-axis-spring",
            "bodies": ["ground", "disc"],
            "points": [[0, 0, z], [0, 0, z]],
            "stiffness": [stiffness, stiffness, along],
        }
        for k, (z, stiffness, along) in enumerate([(0.0, k11 - k12**2 / k22, axial), (k22 / k12, k12**2 / k22, 0.0)])
    }
    disc = {"mass": mass, "inertia": [across, across, 2.0 * across], "angular_velocity": [0, 0, speed]}
    model = machine({"bodies": {"disc": disc}, "forces": springs}).linearise()
    quartic = np.polysub(np.polymul([-mass, 0.0, k11], [-across, spin, k22]), [k12**2])
    wanted = np.sort([*np.abs(np.roots(quartic)), np.sqrt(axial / mass)])
    frequencies = np.sort(model.eigenvalues.imag[model.eigenvalues.imag > 1.0])
    np.testing.assert_allclose(frequencies, wanted, rtol=1e-10)
    assert model.trust.verdict == "green"
