"""Beams in words: their lines, their sections' axes, nodes and stations."""

import pickle

import numpy as np
import pytest
from refusals import refused

from nivel import Beam
from nivel.elements.beams.beam import _divided

STEEL = {"youngs_modulus": 210e9, "poisson_ratio": 0.3, "density": 7850.0}
ROUND = {"type": "circle", "radius": 0.01}
GENERAL = {"type": "general", "stiffness": [1e6, 2e6, 3e6, 1e3, 2e3, 3e3], "mass": 2.0, "inertia": [0.03, 0.01, 0.02]}
ENDS = {"from": (0, 0, 0), "to": (1, 0, 0)}


def beam(**given):
    return Beam(name="rod", **({**ENDS, "section": ROUND, "material": STEEL} | given))


def test_a_straight_beam_has_z_up_and_x_along():
    place, axes = beam(to=(0, 2, 0)).frames(np.array([0.0, 0.25, 1.0]))
    np.testing.assert_allclose(place, [[0, 0, 0], [0, 0.5, 0], [0, 2, 0]])
    np.testing.assert_allclose(axes, np.broadcast_to([[0, -1, 0], [1, 0, 0], [0, 0, 1]], (3, 3, 3)), atol=1e-15)


def test_an_arc_has_the_length_of_its_circle_and_tangents_across_its_radii():
    arc = beam(via=(0.5, 0.5, 0))
    assert arc.line.length == pytest.approx(np.pi / 2)
    place, axes = arc.frames(np.linspace(0, 1, 7))
    np.testing.assert_allclose(np.linalg.norm(place - [0.5, 0, 0], axis=1), 0.5)
    np.testing.assert_allclose(np.einsum("ni,ni->n", axes[:, :, 0], place - [0.5, 0, 0]), 0.0, atol=1e-15)
    np.testing.assert_allclose(np.abs(axes[:, 2, 2]), 1.0)


def test_axes_of_a_curve_turn_with_its_tangent_only():
    """d(z)/ds has no part along y: the definition of a frame that does not twist. Central differences."""
    curve = beam(through=[(0.3, 0.4, 0.1), (0.6, -0.2, 0.4)], elements=40)
    s, h = np.linspace(0.05, 0.95, 7), 1e-4
    axes = curve.frames(np.sort(np.concatenate([s - h, s, s + h])))[1].reshape(7, 3, 3, 3)
    np.testing.assert_allclose(axes.swapaxes(2, 3) @ axes, np.broadcast_to(np.eye(3), axes.shape), atol=1e-12)
    twist = np.einsum("ni,ni->n", axes[:, 2, :, 2] - axes[:, 0, :, 2], axes[:, 1, :, 1]) / (2 * h * curve.line.length)
    bend = np.linalg.norm(axes[:, 2, :, 0] - axes[:, 0, :, 0], axis=1) / (2 * h * curve.line.length)
    assert bend.max() > 2.0
    np.testing.assert_allclose(twist, 0.0, atol=1e-3 * bend.max())


def test_a_curve_goes_through_its_points():
    points = [(0.3, 0.4, 0.1), (0.6, -0.2, 0.4)]
    place = beam(through=points, elements=40).frames(np.linspace(0, 1, 20001))[0]
    for point in points:
        assert np.linalg.norm(place - point, axis=1).min() < 1e-4


def test_twist_turns_the_last_section_about_the_beam():
    axes = beam(twist=0.6).frames(np.array([0.0, 0.5, 1.0]))[1]
    angles = np.arctan2(axes[:, 2, 1], axes[:, 1, 1])
    np.testing.assert_allclose(angles, [0.0, 0.3, 0.6], atol=1e-15)


@pytest.mark.parametrize("order", [1, 2, 3])
def test_stations_are_nodes_between_elements(order):
    rod = beam(stations={"late": 0.9, "early": 0.15}, elements=7, order=order)
    assert len(rod.shares) == 7 * order + 1 == len(rod.node_names)
    names = dict(zip(rod.node_names, rod.shares.tolist(), strict=True))
    assert (names["rod.start"], names["rod.early"], names["rod.late"], names["rod.end"]) == (0.0, 0.15, 0.9, 1.0)
    assert {0.15, 0.9} <= set(rod.shares[::order].tolist())
    assert np.all(np.diff(rod.shares) > 0.0)


def test_elements_are_as_even_as_stations_allow():
    """No element can be made shorter by taking one from another part without that one's becoming longer."""
    rng = np.random.default_rng(7)
    for _ in range(200):
        lengths = rng.uniform(1e-3, 1.0, rng.integers(1, 6))
        count = int(rng.integers(len(lengths), 60))
        counts = np.array(_divided(lengths, count))
        assert counts.sum() == count
        assert counts.min() >= 1
        fewer = np.where(counts > 1, lengths / np.maximum(counts - 1, 1), np.inf)
        assert fewer.min() >= (lengths / counts).max() * (1 - 1e-12)


def test_a_beam_is_a_value():
    one, other = beam(elements=4), beam(elements=4)
    assert one.node_names
    assert one == other
    assert pickle.loads(pickle.dumps(one)) == other


def test_section_of_a_material_is_that_of_the_formulas():
    """Round bar: area π r², second moments π r⁴/4, torsion π r⁴/2."""
    found = beam().properties
    area, moment = np.pi * 1e-4, np.pi * 1e-8 / 4
    np.testing.assert_allclose(
        found.stiffness[[0, 3, 4, 5], [0, 3, 4, 5]], [210e9 * area, 210e9 / 2.6 * 2 * moment, *[210e9 * moment] * 2]
    )
    assert found.mass == pytest.approx(7850 * area)
    np.testing.assert_allclose(found.inertia, 7850 * np.diag([2 * moment, moment, moment]))


def test_a_general_section_is_taken_as_it_is():
    found = Beam(name="rod", **ENDS, section=GENERAL).properties
    np.testing.assert_array_equal(found.stiffness, np.diag(GENERAL["stiffness"]))
    np.testing.assert_array_equal(found.inertia, np.diag(GENERAL["inertia"]))


def test_offsets_move_where_a_force_does_not_bend_or_twist():
    """A tension N through the centroid (y, z) bends nothing there: at the line it comes with M_y = z N, M_z = -y N.

    A shear force V_z through the shear centre twists nothing: at the line it comes with a torque y V_z; V_y with -z V_y.
    """
    (yc, zc), (ys, zs) = (0.02, -0.01), (0.005, 0.03)
    found = beam(centroid=(yc, zc), shear_centre=(ys, zs)).properties
    tension = np.linalg.solve(found.stiffness, [7.0, 0, 0, 0, zc * 7.0, -yc * 7.0])
    np.testing.assert_allclose(tension[1:], 0.0, atol=1e-18)
    shear = np.linalg.solve(found.stiffness, [0, 2.0, 5.0, ys * 5.0 - zs * 2.0, 0, 0])
    np.testing.assert_allclose(shear[[0, 3, 4, 5]], 0.0, atol=1e-18)
    np.testing.assert_array_equal(found.mass_centre, [0.0, yc, zc])


def test_python_is_told_of_faults_too():
    assert "beams.rod.to: the beam ends where it starts" in refused(beam, to=(0, 0, 0))
    assert "`material` is missing" in refused(beam, material=None)
