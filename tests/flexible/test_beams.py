"""The beam element and sections against closed forms."""

import numpy as np
import pytest

from nivel.elements.beams.sections import Box, Circle, IBeam, Material, Rectangle, Tube, Values, section_of
from nivel.flexible.model.beam import Beam, end_stress, geometric_stiffness, mass_matrix, mass_points, stiffness

STEEL = Material(youngs_modulus=210e9, poisson_ratio=0.3, density=7850.0)
RECTANGLE = section_of(Rectangle(width=0.04, height=0.06), 0.3)
SECTIONS = [
    Circle(radius=0.03),
    Tube(outer_radius=0.05, inner_radius=0.04),
    Rectangle(width=0.04, height=0.06),
    Box(width=0.08, height=0.12, wall=0.005),
    IBeam(width=0.1, height=0.2, flange=0.01, web=0.006),
]


def beam(*, length=0.5, section=RECTANGLE, shear=False):
    return Beam(length, section, STEEL, shear)


def test_consistent_mass_of_bending_is_that_of_the_book():
    """Przemieniecki 1968, eq. (11.30) without shear: Hermite's translational part and rotary inertia, plane x-y."""
    it = beam()
    L, m = it.length, it.mass
    r2 = it.section.iz / it.section.area
    move = [[156, 22 * L, 54, -13 * L], [22 * L, 4 * L**2, 13 * L, -3 * L**2]]
    move += [[54, 13 * L, 156, -22 * L], [-13 * L, -3 * L**2, -22 * L, 4 * L**2]]
    turn = [[36, 3 * L, -36, 3 * L], [3 * L, 4 * L**2, -3 * L, -(L**2)]]
    turn += [[-36, -3 * L, 36, -3 * L], [3 * L, -(L**2), -3 * L, 4 * L**2]]
    expected = m / 420 * np.array(move) + m * r2 / (30 * L**2) * np.array(turn)
    at = np.ix_([1, 5, 7, 11], [1, 5, 7, 11])
    np.testing.assert_allclose(mass_matrix(it)[at], expected, rtol=1e-13, atol=1e-13 * m)


def test_consistent_mass_of_stretch_and_twist():
    it = beam()
    two = np.array([[2, 1], [1, 2]]) / 6
    M = mass_matrix(it)
    np.testing.assert_allclose(M[np.ix_([0, 6], [0, 6])], it.mass * two, rtol=1e-13)
    polar = 7850 * (it.section.iy + it.section.iz) * it.length
    np.testing.assert_allclose(M[np.ix_([3, 9], [3, 9])], polar * two, rtol=1e-13)


@pytest.mark.parametrize("lumped", [False, True])
@pytest.mark.parametrize("shear", [False, True])
def test_mass_points_have_the_mass_and_move_rigidly(lumped, shear):
    it = beam(shear=shear)
    masses, places, shapes = mass_points(it, lumped=lumped)
    assert masses.sum() == pytest.approx(it.mass)
    np.testing.assert_allclose(masses @ places, [it.mass * it.length / 2, 0, 0], atol=1e-12)
    turn = np.array([0.2, -0.3, 0.5])
    ends = np.concatenate([np.zeros(3), turn, np.cross(turn, [it.length, 0, 0]), turn])
    np.testing.assert_allclose(shapes @ ends, np.cross(turn, places), atol=1e-14)


@pytest.mark.parametrize("record", SECTIONS, ids=lambda each: each.type)
def test_stiffness_has_no_energy_in_rigid_motions(record):
    it = beam(section=section_of(record, 0.3), shear=True)
    K = stiffness(it)
    np.testing.assert_allclose(K, K.T)
    for turn, shift in ((np.eye(3)[k], np.eye(3)[j]) for k in range(3) for j in range(3)):
        ends = np.concatenate([shift, turn, shift + np.cross(turn, [it.length, 0, 0]), turn])
        assert np.abs(K @ ends).max() < 1e-12 * np.abs(K).max()


@pytest.mark.parametrize("axis", ["y", "z"])
def test_cantilever_under_tip_force_bends_and_shears(axis):
    """δ = F L³ / 3 E I + F L / G A_s (Timoshenko); θ = F L² / 2 E I."""
    it = beam(shear=True)
    free = stiffness(it)[6:, 6:]
    at = 1 if axis == "y" else 2
    tip = np.linalg.solve(free, 1000.0 * np.eye(6)[at])
    second, shear = (it.section.iz, it.section.shear_y) if axis == "y" else (it.section.iy, it.section.shear_z)
    bending = 1000 * it.length**3 / (3 * 210e9 * second)
    assert tip[at] == pytest.approx(bending + 1000 * it.length / (STEEL.shear_modulus * shear), rel=1e-12)
    slope = 1000 * it.length**2 / (2 * 210e9 * second)
    assert tip[5 if axis == "y" else 4] == pytest.approx(slope if axis == "y" else -slope, rel=1e-12)


@pytest.mark.parametrize("axis", ["y", "z"])
def test_stress_of_a_cantilever_under_tip_force(axis):
    """σ = M c / I at the clamp, tension on the side that the force comes from; none at the tip."""
    it = beam()
    at = 1 if axis == "y" else 2
    tip = np.linalg.solve(stiffness(it)[6:, 6:], 1000.0 * np.eye(6)[at])
    stress = end_stress(it) @ np.concatenate([np.zeros(6), tip])
    half, second = (0.02, it.section.iz) if axis == "y" else (0.03, it.section.iy)
    fibre = it.section.fibres[:, 0 if axis == "y" else 1]
    expected = -1000 * it.length * fibre / second
    np.testing.assert_allclose(stress[0, :, 0], expected, rtol=1e-10)
    assert np.abs(expected).max() == pytest.approx(1000 * it.length * half / second)
    assert np.abs(stress[1, :, 0]).max() < 1e-6 * np.abs(expected).max()
    shear = it.section.shear_y if axis == "y" else it.section.shear_z
    np.testing.assert_allclose(stress[:, :, 3 if axis == "y" else 5], 1000 / shear, rtol=1e-10)


def test_twist_of_a_tube_has_the_stress_of_the_closed_form():
    """τ = T r / J all around, J = π (a⁴ - b⁴) / 2."""
    it = beam(section=section_of(SECTIONS[1], 0.3))
    tip = np.linalg.solve(stiffness(it)[6:, 6:], 500.0 * np.eye(6)[3])
    stress = (end_stress(it) @ np.concatenate([np.zeros(6), tip]))[1]
    J = np.pi * (0.05**4 - 0.04**4) / 2
    np.testing.assert_allclose(np.hypot(stress[:, 3], stress[:, 5]), 500 * 0.05 / J, rtol=1e-12)
    assert stress[0, 5] > 0  # at +y a torque about +x shears towards +z


def test_torsion_of_rectangles_is_that_of_the_table():
    """Timoshenko & Goodier 1951, torsion: J = k b³ h, τ = T / (k2 b² h) with k = 0.141, 0.229, 0.312; k2 = 0.208, 0.246, 0.312."""
    for ratio, k, k2 in ((1, 0.1406, 0.208), (2, 0.229, 0.246), (10, 0.312, 0.312)):
        its = section_of(Rectangle(width=0.01, height=0.01 * ratio), 0.3)
        assert its.torsion == pytest.approx(k * 0.01**4 * ratio, rel=3e-3)
        assert np.abs(its.twist).max() == pytest.approx(1 / (k2 * 0.01**3 * ratio), rel=3e-3)


def test_sections_by_integration():
    """Area and second moments of the box and the I as differences of rectangles, counted on a grid."""
    grid = np.linspace(-0.11, 0.11, 1601)
    y, z = np.meshgrid(grid, grid, indexing="ij")
    cell = (grid[1] - grid[0]) ** 2
    box = (abs(y) < 0.04) & (abs(z) < 0.06) & ~((abs(y) < 0.035) & (abs(z) < 0.055))
    i = ((abs(z) < 0.1) & (abs(z) > 0.09) & (abs(y) < 0.05)) | ((abs(z) <= 0.09) & (abs(y) < 0.003))
    for record, inside in ((SECTIONS[3], box), (SECTIONS[4], i)):
        its = section_of(record, 0.3)
        assert its.area == pytest.approx(inside.sum() * cell, rel=2e-2)
        assert its.iy == pytest.approx((z**2 * inside).sum() * cell, rel=2e-2)
        assert its.iz == pytest.approx((y**2 * inside).sum() * cell, rel=2e-2)


def test_buckling_load_of_a_clamped_bar_converges_to_euler():
    """Smallest P of K - P K_g: π² E I / 4 L²; one element 0.75 % too high, four far less."""
    errors = []
    for count in (1, 4):
        it = beam(length=0.5 / count)
        K, G = np.zeros((6 * count + 6,) * 2), np.zeros((6 * count + 6,) * 2)
        for e in range(count):
            at = slice(6 * e, 6 * e + 12)
            K[at, at] += stiffness(it)
            G[at, at] += geometric_stiffness(it)
        plane = [6 * e + k for e in range(1, count + 1) for k in (1, 5)]
        loads = 1 / np.linalg.eigvals(np.linalg.solve(K[np.ix_(plane, plane)], G[np.ix_(plane, plane)])).real
        errors.append(loads.min() / (np.pi**2 * 210e9 * it.section.iz / (4 * 0.5**2)) - 1)
    assert errors[0] == pytest.approx(0.0075, abs=5e-4)
    assert 0 < errors[1] < errors[0] / 100


def test_section_of_values_is_taken_as_it_is():
    its = section_of(Values(area=1e-3, iy=2e-6, iz=3e-6, torsion=4e-6, stress_z=0.05), 0.3)
    assert (its.area, its.iy, its.iz, its.torsion) == (1e-3, 2e-6, 3e-6, 4e-6)
    assert np.isinf(its.shear_y)
    assert np.abs(its.fibres).max() == 0.05
