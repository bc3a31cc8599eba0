"""Capsules, extrusions and meshes: volume, centroid and inertia against closed forms, and what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nivel import Body, MachineRecord
from nivel.errors import ModelError
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Extrusion, Mesh, Sphere
from nivel.machine.bodies.solids import centroid, squared_gyration, volume
from nivel.machine.bodies.surface import enclosed, surface_arrays, surface_text, why_open
from nivel.machine.core.orientation import Orientation, rotation_matrix
from solid_meshes import ball_mesh, box_mesh

sizes = st.floats(0.05, 3.0)
places = st.tuples(*[st.floats(-5.0, 5.0)] * 3)


def mesh(vertices, triangles, **given):
    return Mesh(
        surface=surface_text(np.asarray(vertices, dtype=float), np.asarray(triangles, dtype=np.uint32)), **given
    )


@given(sizes, st.sampled_from("xyz"))
def test_a_capsule_without_length_is_nearly_a_ball(radius, axis):
    capsule, ball = Capsule(radius=radius, length=1e-9 * radius, along=axis), Sphere(radius=radius)
    assert volume(capsule) == pytest.approx(volume(ball))
    np.testing.assert_allclose(squared_gyration(capsule), squared_gyration(ball), rtol=1e-8, atol=1e-12)


@given(sizes, st.floats(10.0, 1e3), st.sampled_from("xyz"))
def test_a_long_capsule_is_nearly_a_cylinder_of_its_volume(radius, slenderness, axis):
    straight = slenderness * radius
    capsule = Capsule(radius=radius, length=straight, along=axis)
    across = 1 if axis == "x" else 0
    # I = m L²/12 to leading order with L the straight part and 4R/3 of ball; what is left out is of order R/L
    about = (straight + 4 / 3 * radius) ** 2 / 12
    assert squared_gyration(capsule)[across, across] == pytest.approx(about, rel=2.0 / slenderness)


@given(sizes, sizes)
def test_capsule_is_the_integral_over_its_slices(radius, straight):
    # discs of radius r(x) at x: dV = π r², about the axis r²/2, across r²/4 + x²; 60-point Gauss over bar and caps
    nodes, weights = np.polynomial.legendre.leggauss(60)
    half = straight / 2
    parts = [(0.0 * nodes + half * nodes, np.full(60, radius), half * weights)]
    for sign in (1.0, -1.0):
        s = 0.5 * radius * (nodes + 1.0)
        parts.append((sign * (half + s), np.sqrt(radius**2 - s**2), 0.5 * radius * weights))
    x, r, w = (np.concatenate(each) for each in zip(*parts, strict=True))
    whole = np.sum(w * np.pi * r**2)
    capsule = Capsule(radius=radius, length=straight)
    assert volume(capsule) == pytest.approx(whole)
    about = np.sum(w * np.pi * r**2 * r**2 / 2) / whole
    across = np.sum(w * np.pi * r**2 * (r**2 / 4 + x**2)) / whole
    np.testing.assert_allclose(squared_gyration(capsule), np.diag([about, across, across]), rtol=1e-10)


@given(sizes, sizes, sizes, st.sampled_from("xyz"), places)
def test_an_extruded_rectangle_is_a_box(a, b, length, axis, place):
    order = ["xyz".index(axis), ("xyz".index(axis) + 1) % 3, ("xyz".index(axis) + 2) % 3]
    size = np.empty(3)
    size[order] = length, a, b
    corners = [(0, 0), (a, 0), (a, b), (0, b)]
    for outline in (corners, corners[::-1]):  # either way round
        prism = Extrusion(outline=outline, length=length, along=axis, centre=place)
        box = Box(size=tuple(size))
        assert volume(prism) == pytest.approx(volume(box))
        np.testing.assert_allclose(squared_gyration(prism), squared_gyration(box), rtol=1e-9, atol=1e-12)
        offset = np.zeros(3)
        offset[order[1:]] = a / 2, b / 2
        np.testing.assert_allclose(centroid(prism), np.array(place) + offset, atol=1e-12)


@given(sizes, sizes)
def test_an_extruded_right_triangle_has_a_product_of_inertia(a, b):
    # corners (0, 0), (a, 0), (0, b) in y and z: ∫∫ (y - a/3)(z - b/3) dA = -a² b²/72, area a b/2
    tensor = squared_gyration(Extrusion(outline=[(0, 0), (a, 0), (0, b)], length=1.0))
    assert tensor[1, 2] == pytest.approx(a * b / 36)
    assert tensor[0, 0] == pytest.approx((a**2 + b**2) / 18)


@pytest.mark.parametrize(
    ("outline", "said"),
    [
        ([(0, 0), (1, 0)], "at least three corners"),
        ([(0, 0), (1, 1), (1, 0), (0, 1)], "crosses or touches"),
        ([(0, 0), (1, 0), (2, 0)], "on a line"),
        ([(0, 0), (1, 0), (1, 0), (1, 1)], "stands twice in a row"),
    ],
)
def test_outlines_without_an_inside_are_refused(outline, said):
    with pytest.raises(ModelError, match=said):
        Extrusion(outline=outline, length=1)


@given(sizes, sizes, sizes, places, st.booleans())
def test_a_box_of_triangles_is_a_box(a, b, c, place, inwards):
    vertices, triangles = box_mesh(a, b, c)
    shape = mesh(vertices + place, triangles[:, ::-1] if inwards else triangles)
    assert volume(shape) == pytest.approx(a * b * c)
    np.testing.assert_allclose(centroid(shape), place, atol=1e-9)
    np.testing.assert_allclose(squared_gyration(shape), squared_gyration(Box(size=(a, b, c))), rtol=1e-7, atol=1e-9)


def test_a_fine_ball_of_triangles_comes_near_a_ball_with_the_square_of_its_fineness():
    errors = []
    for fineness in (3, 4, 5):
        inside = enclosed(*ball_mesh(fineness))
        errors.append(np.abs(inside.moments[0, 0] / (0.4 * 4 / 3 * np.pi) - 1.0))
    ratios = np.array(errors[:-1]) / errors[1:]
    np.testing.assert_allclose(ratios, 4.0, rtol=0.05)  # halved sides: a quarter of the error


def test_a_mesh_is_placed_turned_and_scaled_by_its_words():
    turn = Orientation(axis=(1, 2, 3), angle=0.7)
    vertices, triangles = box_mesh(100.0, 200.0, 300.0)
    placed = mesh(vertices + np.array([10, 20, 30]), triangles, unit="1 mm", position=(1, 2, 3), orientation=turn)
    A = rotation_matrix(turn)
    assert volume(placed) == pytest.approx(0.1 * 0.2 * 0.3)
    np.testing.assert_allclose(centroid(placed), A @ [0.01, 0.02, 0.03] + np.array([1, 2, 3]))
    box = squared_gyration(Box(size=(0.1, 0.2, 0.3)))
    np.testing.assert_allclose(squared_gyration(placed), A @ box @ A.T, rtol=1e-9, atol=1e-14)
    body = mass_properties(Body(name="block", shape=placed, density=1000))
    assert body.mass == pytest.approx(6.0)


def test_open_and_wrong_surfaces_are_refused_for_a_density_and_taken_with_an_inertia():
    vertices, triangles = box_mesh(1, 1, 1)
    opened = mesh(vertices, triangles[:-1])
    with pytest.raises(ModelError, match="not closed: 3 edges belong to one triangle only"):
        Body(name="tin", shape=opened, density=1000)
    with pytest.raises(ModelError, match="not closed"):
        Body(name="tin", shape=opened, mass=1)
    assert Body(name="tin", shape=opened, mass=1, inertia=(1, 1, 1)).mass == 1
    turned = triangles.copy()
    turned[0] = turned[0][::-1]
    assert "closed" in why_open(turned)
    flat = mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2], [2, 1, 0]])
    with pytest.raises(ModelError, match="no volume"):
        Body(name="sheet", shape=flat, density=1000)


@pytest.mark.parametrize("text", ["", "nonsense", "AAAA", surface_text(np.zeros((1, 3)), np.array([[0, 0, 5]]))])
def test_texts_that_are_no_surface_are_refused(text):
    with pytest.raises(ValueError, match="not a packed surface"):
        surface_arrays(text)
    with pytest.raises(ModelError, match=r"no triangles|name of a `file`"):
        Mesh(surface=text)


def test_a_mesh_without_a_surface_says_how_to_read_it():
    with pytest.raises(ModelError, match=r"nivel\.files\.read_mesh"):
        Mesh(file="part.stl")


def test_a_capsule_between_two_points_reaches_them_with_the_centres_of_its_balls():
    body = Body(name="link", shape=Capsule(from_=(0, 0, 0), to=(0, 3, 4), radius=0.1), density=1000)
    assert mass_properties(body).mass == pytest.approx(1000 * np.pi * 0.01 * (5 + 0.4 / 3))
    cylinder = Cylinder(from_=(0, 0, 0), to=(0, 3, 4), radius=0.1)
    assert volume(body.shape) > volume(cylinder)


def test_looks_are_solids_of_the_body_frame_without_mass():
    plain = Body(name="a", mass=2, shape={"type": "sphere", "radius": 0.1})
    looks = [{"type": "box", "size": (1, 2, 3), "centre": (5, 0, 0), "colour": "orange"}]
    seen = plain.replace(looks=looks)
    np.testing.assert_array_equal(mass_properties(seen).inertia, mass_properties(plain).inertia)
    with pytest.raises(ModelError, match="`from` and `to` are global"):
        plain.replace(looks=[{"type": "capsule", "radius": 0.1, "from": (0, 0, 0), "to": (1, 0, 0)}])
    np.testing.assert_array_equal(
        mass_properties(plain.replace(looks=[mesh(*box_mesh(1, 1, 1))])).inertia, mass_properties(plain).inertia
    )
    with pytest.raises(ModelError, match="a colour was expected, one of yellow"):
        plain.replace(looks=[{**looks[0], "colour": "pink"}])


def test_surroundings_are_solids_at_global_places_and_change_no_number():
    alone = MachineRecord(name="m", bodies=[Body(name="a", mass=2, shape={"type": "sphere", "radius": 0.1})])
    wall = {"type": "box", "size": (1, 2, 3), "centre": (5, 0, 0), "colour": "grey"}
    beside = alone.replace(surroundings=[wall])
    assert beside.surroundings[0].centre == (5, 0, 0)
    assert beside.bodies == alone.bodies
    with pytest.raises(ModelError, match="stands along the axes, at its `centre`"):
        alone.replace(surroundings=[{"type": "capsule", "radius": 0.1, "from": (0, 0, 0), "to": (1, 0, 0)}])
    assert alone.replace(surroundings=[mesh(*box_mesh(1, 1, 1))]).bodies == alone.bodies
    with pytest.raises(ModelError, match=r"solids have no names: write `- \{type: box"):
        alone.replace(surroundings={"floor": wall})
    with pytest.raises(ModelError, match=r"in Python use nivel\.files\.read_mesh"):
        alone.replace(surroundings=[{"type": "mesh", "file": "quay.stl"}])
