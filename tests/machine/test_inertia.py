"""Mass, centre of mass and inertia of shapes against integrals over the solid, and of given tensors."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from nivel import Body
from nivel.errors import ModelError
from nivel.machine.bodies.inertia import impossible, mass_properties, point_mass_inertia
from nivel.machine.bodies.shape import Box, Cylinder, Sphere, Tube
from nivel.machine.bodies.solids import volume

lengths = st.floats(0.01, 10)
DENSITY = 7850.0


def _body(shape, **given):
    return Body(name="solid", shape=shape, **({"density": DENSITY} | given))


def _moments(second):
    """Moments of inertia from the second moments (∫x² dm, ∫y² dm, ∫z² dm)."""
    xx, yy, zz = second
    return np.diag([yy + zz, xx + zz, xx + yy])


def _axial(axis, along, across):
    second = [across, across, across]
    second["xyz".index(axis)] = along
    return _moments(second)


@given(lengths, lengths, lengths)
def test_box(a, b, c):
    # ∫x² dm over a block = m a²/12
    properties = mass_properties(_body(Box(size=(a, b, c))))
    mass = DENSITY * a * b * c
    assert properties.mass == pytest.approx(mass)
    assert np.allclose(properties.inertia, mass / 12 * _moments([a**2, b**2, c**2]), rtol=1e-12)


@given(lengths, lengths, st.sampled_from("xyz"))
def test_cylinder(radius, length, axis):
    # ∫x² dm along = m L²/12, ∫y² dm = ∫z² dm = ∫r²/2 dm = m R²/4
    properties = mass_properties(_body(Cylinder(radius=radius, length=length, along=axis)))
    mass = DENSITY * np.pi * radius**2 * length
    assert properties.mass == pytest.approx(mass)
    assert np.allclose(properties.inertia, mass * _axial(axis, length**2 / 12, radius**2 / 4), rtol=1e-12)


@given(lengths, st.floats(0.01, 0.99), lengths, st.sampled_from("xyz"))
def test_tube_is_a_cylinder_without_its_core(outer, ratio, length, axis):
    inner = ratio * outer
    properties = mass_properties(_body(Tube(outer_radius=outer, inner_radius=inner, length=length, along=axis)))
    whole, core = (mass_properties(_body(Cylinder(radius=r, length=length, along=axis))) for r in (outer, inner))
    assert properties.mass == pytest.approx(whole.mass - core.mass)
    assert np.allclose(properties.inertia, whole.inertia - core.inertia, rtol=1e-9)


@given(lengths)
def test_sphere(radius):
    # ∫x² dm = ∫r² dm / 3 = m 3/5 R² / 3
    properties = mass_properties(_body(Sphere(radius=radius)))
    mass = DENSITY * 4 / 3 * np.pi * radius**3
    assert properties.mass == pytest.approx(mass)
    assert np.allclose(properties.inertia, mass * _moments([radius**2 / 5] * 3), rtol=1e-12)


SHAPES = [
    Box(size=(0.3, 0.7, 1.1), centre=(0.1, 0, -0.2)),
    Cylinder(radius=0.3, length=1.2, along="y"),
    Tube(outer_radius=0.5, inner_radius=0.3, length=0.8, along="z"),
    Sphere(radius=0.6, centre=(1, 2, 3)),
]


def _inside(shape, p):
    x, y, z = p
    match shape:
        case Box():
            return np.all(np.abs(p) <= np.array(shape.size)[:, None] / 2, axis=0)
        case Sphere():
            return x**2 + y**2 + z**2 <= shape.radius**2
        case Cylinder():
            return (x**2 + z**2 <= shape.radius**2) & (np.abs(y) <= shape.length / 2)
        case Tube():
            r2 = x**2 + y**2
            return (r2 <= shape.outer_radius**2) & (r2 >= shape.inner_radius**2) & (np.abs(z) <= shape.length / 2)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.type)
def test_against_a_sum_over_small_cubes(shape):
    n, half = 120, 0.7
    line = (np.arange(n) + 0.5) / n * 2 * half - half
    p = np.array(np.meshgrid(line, line, line, indexing="ij")).reshape(3, -1)
    p = p[:, _inside(shape, p)]
    cell = (2 * half / n) ** 3
    inertia = DENSITY * cell * (np.sum(p**2) * np.eye(3) - p @ p.T)
    properties = mass_properties(_body(shape))
    # cubes at the surface are in or out as a whole: an error of the order of one cell in the size
    assert volume(shape) == pytest.approx(p.shape[1] * cell, rel=0.02)
    assert np.allclose(properties.inertia, inertia, atol=0.03 * np.abs(inertia).max())
    assert np.array_equal(properties.centre_of_mass, shape.centre or (0, 0, 0))


def test_a_shape_between_two_points_lies_along_x():
    between = mass_properties(_body(Cylinder(**{"from": (1, 1, 1), "to": (1, 1, 3)}, radius=0.1)))
    along = mass_properties(_body(Cylinder(radius=0.1, length=2)))
    assert np.allclose(between.inertia, along.inertia)
    block = mass_properties(_body(Box(from_=(0, 0, 0), to=(0, 3, 0), width=0.1, height=0.2)))
    assert np.allclose(block.inertia, mass_properties(_body(Box(size=(3, 0.1, 0.2)))).inertia)


def test_a_given_mass_is_spread_over_the_shape():
    light = mass_properties(Body(name="a", mass=2, shape=Sphere(radius=0.5, centre=(1, 0, 0))))
    assert light.mass == 2
    assert np.allclose(light.inertia, 0.4 * 2 * 0.25 * np.eye(3))
    assert np.array_equal(light.centre_of_mass, [1, 0, 0])


def test_a_shape_may_be_for_looks_only():
    looks = Body(name="a", mass=2, inertia=(1, 1, 1), centre_of_mass=(0, 1, 0), shape=Sphere(radius=0.3))
    assert np.array_equal(mass_properties(looks).inertia, np.eye(3))
    assert np.array_equal(mass_properties(looks).centre_of_mass, [0, 1, 0])


def test_about_the_origin_is_moved_to_the_centre_of_mass():
    centre = np.array([0.3, -0.2, 0.5])
    about_centre = np.array([[2.0, 0.1, -0.2], [0.1, 3.0, 0.3], [-0.2, 0.3, 4.0]])
    about_origin = about_centre + point_mass_inertia(5.0, centre)
    body = Body(name="a", mass=5, centre_of_mass=centre, inertia=about_origin, inertia_about="origin")
    assert np.allclose(mass_properties(body).inertia, about_centre, atol=1e-14)
    # two points of half the mass each at ±d from the centre: the parallel-axis theorem by its definition
    d = np.array([0.1, 0.4, 0.2])
    pair = point_mass_inertia(2.5, centre + d) + point_mass_inertia(2.5, centre - d)
    assert np.allclose(pair - point_mass_inertia(5.0, centre), point_mass_inertia(5.0, d))


def test_all_ways_to_write_a_tensor_agree():
    matrix = [[2, 0.1, -0.2], [0.1, 3, 0.3], [-0.2, 0.3, 4]]
    ways = [
        matrix,
        np.array(matrix),
        {"xx": 2, "yy": 3, "zz": 4, "xy": 0.1, "xz": -0.2, "yz": 0.3},
        [["20000 kg*cm^2", 0.1, -0.2], [0.1, "3", 0.3], [-0.2, 0.3, 4]],
    ]
    for way in ways:
        assert np.allclose(mass_properties(Body(name="a", mass=1, inertia=way)).inertia, matrix)
    assert np.array_equal(mass_properties(Body(name="a", mass=1, inertia=(1, 2, 2.5))).inertia, np.diag([1, 2, 2.5]))


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(*[st.floats(-1, 1)] * 3), min_size=5, max_size=9), st.tuples(*[st.floats(-3, 3)] * 3))
def test_real_bodies_are_never_called_impossible(points, turn):
    # small balls at any points are a body
    p = np.array(points) - np.mean(points, axis=0)
    inertia = sum(point_mass_inertia(1.0, each) + 1e-3 * np.eye(3) for each in p)
    rotation = Rotation.from_rotvec(turn).as_matrix()
    assert impossible(rotation @ inertia @ rotation.T) == ""


@pytest.mark.parametrize(
    ("moments", "axis"), [((9, 1, 2), "body x axis"), ((1, 9, 2), "body y axis"), ((1, 2, 9), "body z axis")]
)
def test_an_impossible_moment_is_named_with_its_axis(moments, axis):
    with pytest.raises(ModelError, match=f"{axis}, 9 kg.*exceeds"):
        Body(name="a", mass=1, inertia=moments)


def test_the_principal_axis_of_an_impossible_tensor_is_given():
    rotation = Rotation.from_euler("z", 30, degrees=True).as_matrix()
    with pytest.raises(ModelError, match=r"principal axis \(0.866, 0.5, 0\)"):
        Body(name="a", mass=1, inertia=rotation @ np.diag([9, 1, 2]) @ rotation.T)


def test_three_digit_data_of_a_thin_bar_are_taken():
    assert Body(name="crank", mass=78.1, inertia=(8.14e-2, 26.1, 26.0))
    with pytest.raises(ModelError, match="exceeds"):  # with the misprint
        Body(name="crank", mass=78.1, inertia=(8.14e-2, 26.1, 16.0))


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"mass": 1, "inertia": (0, 1, 1)}, "body x axis, 0 kg*m^2, must be greater than zero"),
        ({"mass": 1, "inertia": (1, 1, -1)}, "must be greater than zero"),
        ({"mass": 1, "inertia": (0, 0, 0)}, "must be greater than zero"),
        (
            {"mass": 1, "inertia": (1, 1, 1), "centre_of_mass": (2, 0, 0), "inertia_about": "origin"},
            "about the centre of mass",
        ),
        ({"mass": 1, "inertia": [[1, 2, 0], [0, 1, 0], [0, 0, 1]]}, "symmetric"),
        ({"mass": 1, "inertia": [[1, 0, 0], [0, 1, 0]]}, "a list of 2"),
        ({"mass": 1, "inertia": [[1, 0, 0], [0, 1, 0], [0, 0]]}, "three rows of three"),
        ({"mass": 1, "inertia": 5}, "three moments"),
        ({"mass": 1, "inertia": {"xx": 1, "yy": 1}}, "`zz` is missing"),
        ({"mass": 1, "inertia": {"xx": 1, "yy": 1, "zz": 1, "xv": 1}}, "the key `xv` is not known"),
    ],
)
def test_refusals(given, part):
    with pytest.raises(ModelError) as caught:
        Body(name="a", **given)
    assert part in str(caught.value)
