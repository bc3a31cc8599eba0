"""Pairs of shapes that touch: depth, place and normal against the least distance found by projections; rest and energy."""

import itertools

import numpy as np
import pytest
from scipy.optimize import brentq, nnls

from simulating import G, simulate

pytestmark = pytest.mark.covering

PRISM = [[-0.15, -0.2], [0.2, -0.15], [0.1, 0.2], [-0.1, 0.15]]
SHAPES = {
    "sphere": {"type": "sphere", "radius": 0.2},
    "capsule": {"type": "capsule", "radius": 0.12, "length": 0.4, "along": "y"},
    "box": {"type": "box", "size": [0.5, 0.3, 0.4]},
    "cylinder": {"type": "cylinder", "radius": 0.2, "length": 0.4, "along": "z"},
    "extrusion": {"type": "extrusion", "outline": PRISM, "length": 0.4, "along": "x"},
    "ellipsoid": {"type": "ellipsoid", "semi_axes": [0.25, 0.2, 0.15]},
}
ROUND = ("sphere", "capsule", "ellipsoid")
PAIRS = [(a, b) for a, b in itertools.product(SHAPES, SHAPES) if a in ROUND or b in ROUND]


def turned(v):
    """Rotation matrix of a rotation vector (Rodrigues)."""
    angle = np.linalg.norm(v)
    K = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]]) / angle
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


RADII = {"sphere": 0.2, "capsule": 0.12}
CORNERS = np.array([[x, y, z] for x in (-0.2, 0.2) for y, z in PRISM])


def projected(name, x):
    """The point of a shape, of a round one of its core, that is nearest to x."""
    match name:
        case "sphere":
            return np.zeros(3)
        case "capsule":
            return np.array([0, np.clip(x[1], -0.2, 0.2), 0])
        case "box":
            return np.clip(x, [-0.25, -0.15, -0.2], [0.25, 0.15, 0.2])
        case "cylinder":
            flat = x[:2] * min(1.0, 0.2 / max(np.hypot(x[0], x[1]), 1e-12))
            return np.array([*flat, np.clip(x[2], -0.2, 0.2)])
        case "ellipsoid":
            return projected_on_ellipsoid(x, np.array([0.25, 0.2, 0.15]))
    # the weights of its corners, at least 0 and 1 in all, by least squares
    return CORNERS.T @ nnls(np.vstack([CORNERS.T, np.full(8, 1e4)]), np.array([*x, 1e4]))[0]


def projected_on_ellipsoid(x, a):
    """x itself inside, else a² x/(t + a²) with the t that puts it on the surface."""
    if np.sum((x / a) ** 2) <= 1.0:
        return x
    t = brentq(lambda t: np.sum((a * x / (t + a**2)) ** 2) - 1.0, 0.0, a.max() * np.linalg.norm(x), xtol=1e-15)
    return a**2 * x / (t + a**2)


def nearest(first, second, r, A):
    """(distance of the surfaces, normal from second to first) of cores that are apart: projections by turns come to the nearest points
    (Cheney, Goldstein 1959)."""
    y = np.zeros(3)
    for _ in range(3000):
        x = r + A @ projected(first, A.T @ (y - r))
        before, y = y, projected(second, x)
        if np.linalg.norm(y - before) < 1e-12:
            break
    d = x - y
    size = np.linalg.norm(d)
    return size - RADII.get(first, 0.0) - RADII.get(second, 0.0), d / size


def quaternion(v):
    """Euler parameters of a rotation vector, scalar first."""
    angle = np.linalg.norm(v)
    return [np.cos(angle / 2), *(np.sin(angle / 2) * np.array(v) / angle)]


TURNS = ([0.4, -0.3, 0.8], [1.2, 0.5, -0.4], [-0.2, 0.1, 2.0])
WAYS = ([0.9, 0.3, 0.2], [-0.2, 0.8, 0.5], [0.3, -0.2, -0.9])
DEEP = 0.02


@pytest.fixture(scope="module")
def touching():
    """All pairs at three places, moved along their normal until they overlap by DEEP, in one machine; and their normals."""
    bodies, forces, normals = {}, {}, {}
    for number, ((first, second), case) in enumerate(itertools.product(PAIRS, range(3))):
        turn, at = TURNS[case], np.array([0, 0, 3.0 * number])
        r = 0.75 * np.array(WAYS[case]) / np.linalg.norm(WAYS[case])
        gap, normal = nearest(first, second, r, turned(np.array(turn)))
        name = f"{first}_{second}_{case}"
        place = (at + r - (gap + DEEP) * normal).tolist()
        body = {"mass": 1, "inertia": [1, 1, 1]}
        bodies[f"{name}_a"] = {
            **body,
            "position": place,
            "orientation": {"euler_parameters": quaternion(turn)},
            "shape": SHAPES[first],
        }
        bodies[f"{name}_b"] = {**body, "position": at.tolist(), "shape": SHAPES[second]}
        forces[name] = {
            **{"type": "contact", "bodies": [f"{name}_a", f"{name}_b"], "stiffness": 1e3, "exponent": 1},
            "restitution": 1,
        }
        normals[name] = normal
    r = simulate({"gravity": [0, 0, 0], "bodies": bodies, "forces": forces}, integrator="rk4", step=1e-6, duration=1e-6)
    return r, normals


@pytest.mark.parametrize(("first", "second"), PAIRS)
def test_depth_and_normal_are_those_of_the_nearest_points(touching, first, second):
    r, normals = touching
    # against an ellipsoid a cylinder is a prism, whose radius and normals differ so much
    near, turned_by = (7e-4, 0.1) if {first, second} == {"cylinder", "ellipsoid"} else (1e-6, 1e-4)
    for case in range(3):
        name = f"{first}_{second}_{case}"
        assert r.array(f"force.{name}.depth")[0] == pytest.approx(DEEP, abs=near)
        normal = [r.array(f"force.{name}.normal_{axis}")[0] for axis in "xyz"]
        np.testing.assert_allclose(normal, normals[name], atol=turned_by)
        assert r.array(f"force.{name}.normal_force")[0] >= 1e3 * (DEEP - near)


def on_table(shape, **more):
    """A body on a table, which is a box."""
    return {
        "gravity": [0, 0, -G],
        "bodies": {
            "table": {"position": [0, 0, -0.1], "shape": {"type": "box", "size": [2, 2, 0.2]}, "density": 700},
            "body": {"mass": 1.0, "shape": shape, **more},
        },
        "joints": {"held": {"type": "fixed", "bodies": ["ground", "table"], "point": [0, 0, 0]}},
    }


POINTS = {"type": "contact", "stiffness": 1e5, "exponent": 1, "restitution": 0.5, "friction": 0.5}


def test_a_capsule_rests_on_a_table_with_both_ends():
    """It lies on two points, each of which carries half its weight, and stays."""
    overlap = G / (2 * POINTS["stiffness"])
    sections = on_table({"type": "capsule", "radius": 0.1, "length": 0.4}, position=[0.1, 0.2, 0.1 - overlap])
    sections["forces"] = {"lies": {**POINTS, "bodies": ["body", "table"]}}
    r = simulate(sections, integrator="radau", duration=0.5)
    assert np.abs(r.array("body.position") - r.array("body.position")[0]).max() < 1e-9
    assert r.array("force.lies.normal_force")[-1] == pytest.approx(G, rel=1e-9)
    assert r.array("force.lies.depth")[-1] == pytest.approx(overlap, rel=1e-6)


def test_a_ball_rolls_over_the_edge_of_a_table_without_loss():
    """Kinetic and potential energy and that of the contact are conserved from the side around the edge and away."""
    sections = on_table({"type": "sphere", "radius": 0.1}, position=[0.9, 0, 0.1 - G / 1e5], velocity=[0.8, 0, 0])
    contact = {**POINTS, "restitution": 1, "friction": 0}
    sections["forces"] = {"rolls": {**contact, "bodies": ["table", "body"]}}
    r = simulate(sections, integrator="dopri5", tolerance=1e-9, duration=0.4)
    assert np.abs(r.array("energy_error")).max() < 1e-6
    assert r.array("body.position.z")[-1] < 0.0
    assert r.array("force.rolls.normal_force")[-1] == 0.0


def test_a_cylinder_stands_on_a_table_and_rolls_on_it():
    """Two solids; the prism in its place rolls as a cylinder to the share by which it differs: v0 stays."""
    sections = on_table(
        {"type": "cylinder", "radius": 0.1, "length": 0.3, "along": "y"},
        position=[-0.5, 0, 0.1],
        velocity=[1, 0, 0],
        angular_velocity=[0, 10, 0],
    )
    sections["forces"] = {
        "rolls": {
            **{"type": "contact", "bodies": ["body", "table"], "foundation_modulus": 1e8, "damping": 5},
            "friction": 0.5,
        }
    }
    r = simulate(sections, integrator="radau", duration=0.5, tolerance=1e-6)
    assert r.array("body.velocity.x")[-1] == pytest.approx(1.0, rel=0.05)
    assert r.array("body.position.z")[-1] == pytest.approx(0.1, rel=0.01)


def test_parallel_capsules_bounce_without_a_turn():
    """They touch along a line, which has two ends: equal masses exchange (1 + e)/2 of their speed, and nothing turns."""
    bar = {"type": "capsule", "radius": 0.1, "length": 0.4}
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {
            "upper": {"mass": 1, "shape": bar, "position": [0, 0, 0.22], "velocity": [0, 0, -1]},
            "lower": {"mass": 1, "shape": bar},
        },
        "forces": {"touch": {"type": "contact", "bodies": ["upper", "lower"], "stiffness": 1e5, "restitution": 0.5}},
    }
    r = simulate(sections, duration=0.1)
    assert r.array("upper.velocity.z")[-1] == pytest.approx(-0.25, rel=1e-5)
    assert np.abs(r.array("upper.angular_velocity")).max() < 1e-9


@pytest.mark.parametrize("other", ["capsule", "box"])
def test_a_capsule_that_lies_on_a_part_of_another_body_presses_in_the_middle_of_that_part(other):
    """Of a bar of 0.4 m, 0.25 m are above the other one: the forces at the ends of these are equal."""
    long = {"type": "capsule", "radius": 0.1, "length": 0.4, "along": "x"}
    below = long if other == "capsule" else {"type": "box", "size": [0.4, 1, 0.2]}
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {
            "upper": {"mass": 1, "shape": long, "position": [0.15, 0, 0.199]},
            "lower": {"mass": 1, "shape": below},
        },
        "forces": {"touch": {**POINTS, "bodies": ["upper", "lower"]}},
    }
    r = simulate(sections, integrator="rk4", step=1e-6, duration=1e-6)
    assert r.array("force.touch.x")[0] == pytest.approx(0.075, abs=1e-9)
    assert r.array("force.touch.normal_force")[0] == pytest.approx(2 * 1e5 * 1e-3, rel=1e-6)
