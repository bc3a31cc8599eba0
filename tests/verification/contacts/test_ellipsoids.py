"""Ellipsoids that touch: rest, rocking, spheres as a special case, conserved energy."""

import numpy as np
import pytest

from simulating import G, simulate

FLOOR = {"floor": {"body": "ground", "axis": [0, 0, 1]}}
CONTACT = {"type": "contact", "stiffness": 1e6, "exponent": 1, "restitution": 0.5}


def test_an_ellipsoid_rests_at_the_depth_of_its_weight():
    """m g = K δ, on its flat side, and in another way on a box."""
    table = {"type": "box", "size": [2, 2, 0.2]}
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {
            "egg": {"mass": 2, "position": [0, 0, 0.1], "shape": {"type": "ellipsoid", "semi_axes": [0.3, 0.2, 0.1]}},
            "pill": {
                **{"mass": 2, "position": [0.1, 3, 0.1]},
                "shape": {"type": "ellipsoid", "semi_axes": [0.3, 0.2, 0.1]},
            },
            "table": {"mass": 5, "position": [0, 3, -0.1], "shape": table},
        },
        "markers": FLOOR,
        "joints": {"held": {"type": "fixed", "bodies": ["ground", "table"], "point": [0, 3, 0]}},
        "forces": {
            "plane": {**CONTACT, "body": "egg", "plane": "floor", "friction": 0.5},
            "box": {**CONTACT, "bodies": ["table", "pill"], "friction": 0.5},
        },
    }
    r = simulate(sections, integrator="radau", duration=1.0)
    for name in ("plane", "box"):
        assert r.array(f"force.{name}.depth")[-1] == pytest.approx(2 * G / 1e6, rel=1e-6)
        assert r.array(f"force.{name}.normal_z")[-1] == pytest.approx(1.0 if name == "plane" else -1.0, abs=1e-9)


@pytest.mark.parametrize("on", ["plane", "box"])
def test_an_ellipsoid_rocks_with_the_frequency_of_its_curvature(on):
    """Rolling without slip about y on a bottom with the radius of curvature R = a²/c:  ω² = m g (R - c)/(I + m c²)."""
    a, b, c, mass, tilt = 0.3, 0.2, 0.2, 1.5, 0.02
    inertia = mass / 5 * (a**2 + c**2)
    omega = np.sqrt(mass * G * (a**2 / c - c) / (inertia + mass * c**2))
    # the centre is above the point of contact by √(c² cos² θ + a² sin² θ)
    height = np.hypot(c * np.cos(tilt), a * np.sin(tilt)) - mass * G / 1e7
    egg = {"type": "ellipsoid", "semi_axes": [a, b, c]}
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {
            "egg": {
                **{"mass": mass, "position": [0, 0, height], "shape": egg},
                "orientation": {"euler_parameters": [np.cos(tilt / 2), 0, np.sin(tilt / 2), 0]},
            }
        },
        "markers": FLOOR,
        "forces": {"rolls": {**CONTACT, "stiffness": 1e7, "body": "egg", "plane": "floor", "friction": 0.8}},
    }
    if on == "box":
        sections["bodies"]["table"] = {
            "mass": 5,
            "position": [0, 0, -0.1],
            "shape": {"type": "box", "size": [2, 2, 0.2]},
        }
        sections["joints"] = {"held": {"type": "fixed", "bodies": ["ground", "table"], "point": [0, 0, 0]}}
        sections["forces"]["rolls"] = {**CONTACT, "stiffness": 1e7, "bodies": ["egg", "table"], "friction": 0.8}
    r = simulate(sections, integrator="radau", duration=1.0, tolerance=1e-8, step=1e-4, output_interval=5e-3)
    t, angle = r.time, 2 * r.array("egg.orientation")[:, 2]
    np.testing.assert_allclose(angle, tilt * np.cos(omega * t), atol=0.01 * tilt)


def pair(shape, other, on):
    """A body with a shape that falls on another one, frictionless, without gravity."""
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {
            "ball": {
                **{"mass": 1, "inertia": [0.02, 0.02, 0.02]},
                "position": on,
                "velocity": [0, 0, -1],
                "shape": shape,
            }
        },
        "markers": FLOOR,
        "forces": {"touch": {**CONTACT, "stiffness": 1e4, "restitution": 1, "body": "ball", "plane": "floor"}},
    }
    if other is not None:
        sections["bodies"]["other"] = {"mass": 2, "inertia": [0.04, 0.05, 0.06], "shape": other}
        sections["forces"]["touch"] = {**CONTACT, "stiffness": 1e4, "restitution": 1, "bodies": ["ball", "other"]}
    return simulate(sections, integrator="dopri5", tolerance=1e-10, duration=0.25, output_interval=0.01)


OTHERS = {
    "plane": (None, [0, 0, 0.3]),
    "sphere": ({"type": "sphere", "radius": 0.15}, [0.1, 0.05, 0.4]),
    "capsule": ({"type": "capsule", "radius": 0.1, "length": 0.4}, [0.05, 0.1, 0.35]),
    "box": ({"type": "box", "size": [0.3, 0.4, 0.2]}, [0.2, 0.05, 0.35]),
}


@pytest.mark.parametrize("name", OTHERS)
def test_an_ellipsoid_of_equal_axes_is_a_sphere(name):
    """The same motion, against a face, an edge and round bodies; and energy is conserved."""
    other, on = OTHERS[name]
    sphere = pair({"type": "sphere", "radius": 0.2}, other, on)
    ellipsoid = pair({"type": "ellipsoid", "semi_axes": [0.2, 0.2, 0.2]}, other, on)
    assert sphere.array("force.touch.normal_force").max() > 10.0
    np.testing.assert_allclose(ellipsoid.array("ball.position"), sphere.array("ball.position"), atol=1e-8)
    np.testing.assert_allclose(
        ellipsoid.array("ball.angular_velocity"), sphere.array("ball.angular_velocity"), atol=1e-6
    )


@pytest.mark.parametrize("name", [*OTHERS, "ellipsoid"])
def test_frictionless_contact_of_an_ellipsoid_conserves_energy(name):
    """Also where it touches askew, and turns: the force has a potential."""
    other, on = OTHERS.get(name, ({"type": "ellipsoid", "semi_axes": [0.1, 0.2, 0.15]}, [0.1, 0.05, 0.45]))
    r = pair({"type": "ellipsoid", "semi_axes": [0.3, 0.2, 0.25]}, other, [on[0], on[1], on[2] + 0.05])
    assert r.array("force.touch.normal_force").max() > 10.0
    assert np.abs(r.array("energy_error")).max() < 1e-7
