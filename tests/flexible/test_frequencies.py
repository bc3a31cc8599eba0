"""Frequencies and static answers of reduced bodies against closed forms, and how they converge."""

import numpy as np
import pytest

from models import bar, reduced

L, B, H = 2.0, 0.004, 0.006
E, RHO = 210e9, 7850.0

# roots of 1 + cos cosh = 0 and 1 - cos cosh = 0 (Blevins 1979, table 8-1), and n π
CLAMPED_FREE = [1.87510407, 4.69409113, 7.85475744, 10.99554073, 14.13716839, 17.27875953]
FREE_FREE = [4.73004074, 7.85320462, 10.99560783, 14.13716549, 17.27875966, 20.42035225]
SUPPORTED = [np.pi * n for n in range(1, 7)]


def thin(elements, reduction):
    return bar(length=L, width=B, height=H, elements=elements, reduction=reduction)


def bending(roots):
    """(12,) [Hz] of both planes, ascending: f = (λ/L)² √(E I / ρ A) / 2π."""
    both = [(root / L) ** 2 * np.sqrt(E * size**2 / 12 / RHO) / (2 * np.pi) for root in roots for size in (B, H)]
    return np.sort(both)


CONDITIONS = {
    "cantilever": (CLAMPED_FREE, "reference: root"),
    "free": (FREE_FREE, "reference: mean-axis"),
    "supported": (SUPPORTED, "held: [root.x, root.y, root.z, root.rx, tip.y, tip.z]"),
}


@pytest.mark.parametrize("name", CONDITIONS)
def test_first_six_frequencies_are_within_a_thousandth(name):
    roots, conditions = CONDITIONS[name]
    body, _ = reduced(thin(40, f"modes: 24, {conditions}"))
    np.testing.assert_allclose(body.frequencies[:6], bending(roots)[:6], rtol=1e-3)


@pytest.mark.parametrize("name", CONDITIONS)
def test_frequencies_converge_with_elements_from_above(name):
    """Hermite elements: the error of a frequency is of fourth order in the size of the elements."""
    roots, conditions = CONDITIONS[name]
    third = [reduced(thin(n, f"modes: {6 * n}, {conditions}"))[0].frequencies[4] for n in (6, 12)]
    exact = bending(roots)[4]
    errors = np.array(third) / exact - 1
    assert np.all(errors > -2e-5)  # rotary inertia takes off this much
    assert np.log2((errors[0] + 1e-5) / (errors[1] + 1e-5)) > 3.3


def test_frequencies_converge_with_normal_modes_from_above():
    """Rayleigh–Ritz: a larger basis lowers each frequency, never below that of the whole model."""
    errors = []
    for modes in (2, 4, 8, 16):
        _, findings = reduced(thin(20, f"modes: {modes}"))
        errors.append(findings.errors[:6])
    errors = np.array(errors)
    assert np.all(errors > -1e-9)
    assert np.all(np.diff(errors, axis=0) < 1e-9)
    assert np.all(errors[-1] < 1e-3)
    assert errors[0, 2] > 0.01


@pytest.mark.parametrize(
    "reduction",
    [
        "modes: 8",
        "modes: 8, reference: root",
        "modes: 8, held: [root.x, root.y, root.z, root.rx, tip.y, tip.z]",
        "modes: 8, method: free-interface",
        "modes: 8, mass: lumped",
    ],
)
def test_rigid_motions_are_found_and_removed(reduction):
    """No mode of a body is rigid, whatever the method and the reference; six were in the Craig–Bampton basis."""
    body, findings = reduced(thin(12, reduction))
    assert body.frequencies.min() > 0.5
    if "free-interface" not in reduction:
        assert len(findings.rigid_frequencies) == 6
        assert max(findings.rigid_frequencies) < 1e-3
        assert len(body.eigenvalues) == 12 + 8 - 6


@pytest.mark.parametrize(
    ("interfaces", "count"), [("", 0), ("root: {node: root}", 6), ("root: {node: root}, tip: {node: tip}", 6)]
)
def test_rigid_motions_are_removed_whatever_the_support(interfaces, count):
    body, findings = reduced(
        bar(length=L, width=B, height=H, elements=12, interfaces=interfaces, reduction="modes: 10")
    )
    assert len(findings.rigid_frequencies) == count  # free modes are computed without them
    np.testing.assert_allclose(body.frequencies[:2], findings.full[:2], rtol=0.02)
    assert body.frequencies.min() > 2.0
    assert np.abs(body.invariants.I3).max() < 1e-9
    assert np.abs(body.invariants.I4).max() < 1e-9


def test_mean_axis_modes_are_orthonormal_and_without_momentum():
    body, _ = reduced(thin(12, "modes: 8"))
    np.testing.assert_allclose(body.invariants.I6, np.eye(len(body.eigenvalues)), atol=1e-9)
    assert np.abs(body.invariants.I3).max() < 1e-10
    assert np.abs(body.invariants.I4).max() < 1e-10


def test_held_freedoms_do_not_move_in_any_mode():
    body, _ = reduced(thin(12, "modes: 8, held: [root.x, root.y, root.z, root.rx, tip.y, tip.z]"))
    root, tip = body.interface("root"), body.interface("tip")
    scale = np.abs(body.modes).max()
    assert np.abs(np.vstack([root.phi, root.psi[:1], tip.phi[1:]])).max() < 1e-10 * scale
    assert np.abs(root.psi[1:]).max() > 1e-3 * scale
    np.testing.assert_allclose(body.invariants.I6, np.eye(len(body.eigenvalues)), atol=1e-9)


@pytest.mark.parametrize("method", ["craig-bampton", "free-interface"])
def test_static_answer_to_interface_loads_is_that_of_the_whole_model(method):
    """Correction modes and residual flexibility are exact for loads on interfaces: δ = F L³ / 3 E I of a cantilever."""
    body, _ = reduced(thin(8, f"modes: 3, method: {method}, reference: root"))
    tip = body.interface("tip")
    q = tip.phi.T @ [0, 0, 2.0] / body.eigenvalues
    second = B * H**3 / 12
    np.testing.assert_allclose(tip.phi @ q, [0, 0, 2.0 * L**3 / (3 * E * second)], atol=1e-9)
    np.testing.assert_allclose(tip.psi @ q, [0, -2.0 * L**2 / (2 * E * second), 0], atol=1e-9)


def test_normal_modes_alone_miss_the_static_answer():
    body, _ = reduced(thin(8, "modes: 3, method: normal-modes, reference: root"))
    tip = body.interface("tip")
    q = tip.phi.T @ [0, 0, 2.0] / body.eigenvalues
    assert abs((tip.phi @ q)[2]) < 0.999 * 2.0 * L**3 / (3 * E * B * H**3 / 12)


def test_modes_up_to_a_frequency():
    _, findings = reduced(thin(20, "modes: {up_to: 60 Hz}"))
    _, more = reduced(thin(20, "modes: 40"))
    assert findings.normal == pytest.approx([f for f in more.normal if f <= 60], rel=1e-6)
    assert len(findings.normal) == 7


def test_assumed_mode_shapes_give_rayleighs_quotient():
    """One shape (x/L)² of a cantilever: ω² = ∫ E I w''² / ∫ ρ A w² = 20 E I / ρ A L⁴, of which rotary inertia takes 6e-6."""
    shapes = "shapes: [{z: (x/2)^2}]"
    text = thin(40, f"modes: given, {shapes}, reference: root")
    body, _ = reduced(text)
    expected = np.sqrt(20 * E * H**2 / 12 / RHO / L**4) / (2 * np.pi)
    assert body.frequencies == pytest.approx([expected], rel=1e-4)


def test_effective_masses_add_up_to_the_whole():
    """All normal modes of a bar clamped at both ends move its mass but what is lumped on the ends."""
    _, findings = reduced(thin(8, "modes: 42"))
    total = np.sum(findings.effective_mass, axis=0)
    assert np.all(total < 1.0)
    assert np.all(total[:3] > 0.85)


def test_mass_centre_and_inertia_of_a_bar():
    body, _ = reduced(bar(tip=(1.2, 0.9, 0.0), width=0.05, height=0.1, elements=5, theory="timoshenko"))
    m = 7850 * 0.05 * 0.1 * 1.5
    assert body.mass == pytest.approx(m, rel=1e-12)
    np.testing.assert_allclose(body.centre_of_mass, [0.6, 0.45, 0], atol=1e-12)
    moments = m / 12 * np.array([0.05**2 + 0.1**2, 1.5**2 + 0.05**2, 1.5**2 + 0.1**2])
    np.testing.assert_allclose(np.sort(np.linalg.eigvalsh(body.inertia)), np.sort(moments), rtol=1e-10)


def test_lumped_mass_raises_the_inertia_as_the_theory_says():
    """About the end by the share 1 / 2 n²: m L²/3 (1 + 1/(2 n²)) for n elements."""
    for n in (4, 8):
        body, _ = reduced(bar(elements=n, width=0.001, height=0.001, reduction="modes: 4, mass: lumped"))
        about_end = body.invariants.I7[2, 2]
        assert about_end / (body.mass * 4 / 3) - 1 == pytest.approx(1 / (2 * n**2), rel=1e-4)


def test_point_mass_lowers_the_frequency_of_a_cantilever():
    """A heavy tip on a light bar: ω² = 3 E I / (M + 33/140 m) L³."""
    text = bar(length=L, width=B, height=H, elements=8, reduction="modes: 8, reference: root")
    text = text.replace("elements: 8}}", "elements: 8}}\n  masses: {payload: {node: tip, mass: 5 kg}}")
    body, _ = reduced(text)
    bar_mass = RHO * B * H * L
    expected = np.sqrt(3 * E * H * B**3 / 12 / ((5 + 33 / 140 * bar_mass) * L**3)) / (2 * np.pi)
    assert body.frequencies[0] == pytest.approx(expected, rel=1e-3)
    assert body.mass == pytest.approx(5 + bar_mass)
