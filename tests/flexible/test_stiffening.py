"""Geometric stiffness against closed forms of spinning and loaded beams."""

import numpy as np
import pytest

from flexible_reference import quadratic_velocity, stiffening
from models import bar, block, reduced
from needing import needs

L, B, H, E, RHO = 2.0, 0.02, 0.03, 210e9, 7850.0


def spinning_frequencies(body, speed, axis=2):
    """[rad/s] of small vibration about steady spin of a body clamped to its frame, which turns about `axis`, without Coriolis terms.

    Elastic, geometric and centrifugal stiffness (the derivative of Q_v with respect to q).
    """
    n = len(body.eigenvalues)
    omega = speed * np.eye(3)[axis]
    K = np.diag(body.eigenvalues) + stiffening(body.stiffening, np.zeros(3), np.zeros(3), omega)
    zero = quadratic_velocity(body.invariants, np.eye(3), omega, np.zeros(n), np.zeros(n))[6:]
    softening = np.array(
        [quadratic_velocity(body.invariants, np.eye(3), omega, row, np.zeros(n))[6:] - zero for row in np.eye(n)]
    )
    return np.sqrt(np.linalg.eigvals(K - softening).real.clip(0))


def test_spinning_beam_flaps_at_the_frequency_of_southwell():
    """Out of the plane of spin: ω² ≈ ω₀² + 1.193 Ω² for the first mode of a cantilever without hub (Southwell & Gough 1921 give a
    lower bound with their constant; 1.193 from Wright et al. 1982, J. Appl. Mech. 49, table of exact solutions at small speeds).
    """
    body, _ = reduced(bar(elements=24, reduction="modes: 24, reference: root, stiffening: true"))
    first = np.sqrt(E * H**2 / 12 / RHO) * (1.87510407 / L) ** 2
    rest = np.sort(spinning_frequencies(body, 0.0))
    flap = np.argmin(abs(rest - first))
    assert rest[flap] == pytest.approx(first, rel=2e-3)
    speed = 0.5 * first
    expected = np.sqrt(first**2 + 1.193 * speed**2)
    assert np.min(np.abs(spinning_frequencies(body, speed) - expected)) < 2e-3 * expected


def test_without_stiffening_the_spin_would_soften():
    """In the plane of spin, 1.193 Ω² - Ω²: without geometric stiffness only the centrifugal -Ω² is left."""
    body, _ = reduced(bar(elements=24, reduction="modes: 24, reference: root, stiffening: true"))
    first = np.sqrt(E * B**2 / 12 / RHO) * (1.87510407 / L) ** 2
    speed = 0.5 * first
    with_it = np.sqrt(first**2 + 0.193 * speed**2)
    assert np.min(np.abs(spinning_frequencies(body, speed) - with_it)) < 2e-3 * with_it
    bare = type(body)(**{**body.__dict__, "stiffening": {k: 0 * v for k, v in body.stiffening.items()}})
    without = np.sqrt(first**2 - speed**2)
    assert np.min(np.abs(spinning_frequencies(bare, speed) - without)) < 2e-3 * without


@pytest.mark.parametrize("name", ["acceleration", "angular_acceleration", "centrifugal"])
def test_matrices_are_symmetric(name):
    body, _ = reduced(bar(elements=8, tip=(1.5, 0.8, 0.4), reduction="modes: 6, reference: root, stiffening: true"))
    matrices = body.stiffening[name]
    assert matrices.shape == (6 if name == "centrifugal" else 3, 12, 12)
    np.testing.assert_array_equal(matrices, matrices.transpose(0, 2, 1))
    assert np.abs(matrices).max() > 0


def test_hanging_beam_is_stiffened_by_its_weight():
    """Body frame at rest, a = -g along the beam away from the clamp: a chain's tension ρ A g (L - x). K_g is ∫ N w'ᵀ w' dx over
    the modes, here by slopes of chords between nodes.
    """
    body, _ = reduced(bar(elements=64, reduction="modes: 10, reference: root, stiffening: true"))
    K = stiffening(body.stiffening, np.array([-9.81, 0, 0]), np.zeros(3), np.zeros(3))
    order = np.argsort(body.position[:, 0])
    x, w = body.position[order, 0], body.modes[order][:, 1:3]
    slope = np.diff(w, axis=0) / np.diff(x)[:, None, None]
    tension = RHO * B * H * 9.81 * (L - (x[1:] + x[:-1]) / 2)
    expected = np.einsum("e,eaj,eak,e->jk", tension, slope, slope, np.diff(x))
    low = np.ix_(range(10), range(10))  # slopes of chords are too small for short waves
    np.testing.assert_allclose(K[low], expected[low], atol=0.01 * np.abs(expected[low]).max())


def test_interface_load_stiffens_by_the_string_formula():
    """A pull F on the tip: K_g = F ∫ w' w' dx."""
    body, _ = reduced(bar(elements=64, reduction="modes: 10, reference: root, stiffening: true"))
    K = 100.0 * body.stiffening["interface.tip"][0]
    order = np.argsort(body.position[:, 0])
    x, w = body.position[order, 0], body.modes[order][:, 1:3]
    slope = np.diff(w, axis=0) / np.diff(x)[:, None, None]
    expected = np.einsum("eaj,eak,e->jk", slope, slope, np.diff(x)) * 100.0
    low = np.ix_(range(10), range(10))  # slopes of chords are too small for short waves
    np.testing.assert_allclose(K[low], expected[low], atol=0.01 * np.abs(expected[low]).max())


def test_solid_and_beam_agree():
    """The same cantilever of solids: spinning frequencies of the first flapping mode within 1 % of those of beams."""
    needs("gmsh")
    root = "root: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}"
    solid, _ = reduced(block(interfaces=root, reduction="modes: 8, reference: root, stiffening: true"))
    beam, _ = reduced(
        bar(
            length=1.0,
            width=0.1,
            height=0.1,
            elements=12,
            theory="timoshenko",
            interfaces="root: {node: root}",
            reduction="modes: 8, reference: root, stiffening: true",
        )
    )
    gains = []
    for body in (solid, beam):
        rest, spun = (np.sort(spinning_frequencies(body, speed))[:2] for speed in (0.0, 300.0))
        gains.append((spun**2 - rest**2) / 300.0**2)
    np.testing.assert_allclose(gains[0], gains[1], atol=0.02)
    np.testing.assert_allclose(gains[1], [0.193, 1.193], atol=0.06)
