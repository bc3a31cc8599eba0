"""Ropes around wheels: winding, arcs, wheels that are left, and motion out of the plane, against closed forms and conservation laws."""

import numpy as np
import pytest

from nivel.errors import ModelError
from simulating import G, machine, simulate, slide, solid

R, M = 0.05, 0.3


def winch(start=0.5, drum=0.00125, radius=R, **rope):
    """A load on a rail below the rim of a drum about y, on which the rope is wound `start` turns."""
    given = {"type": "rope", "bodies": ["drum", "load"], "points": [[0, 0, 0.5], [radius, 0, 0]], "axis": [0, 1, 0]}
    given |= {"radii": [radius, 0], "wound": [start, 0], "stiffness": 1e6, "damping": 200.0, **rope}
    return {
        "gravity": [0, 0, -G],
        "bodies": {"drum": solid(1.0, drum, position=[0, 0, 0.5]), "load": solid(M, 1e-4, position=[radius, 0, 0])},
        "joints": {
            "axle": {"type": "revolute", "bodies": ["ground", "drum"], "point": [0, 0, 0.5], "axis": [0, 1, 0]},
            "guide": slide("ground", "load", point=[radius, 0, 0], axis=[0, 0, 1]),
        },
        "forces": {"rope": given},
    }


def test_a_load_turns_its_drum():
    """a = m g/(m + J/R²); the rope is as long as its free part and half a turn, and runs off without end."""
    r = simulate(winch(start=8.0), duration=1.0, step=5e-5, output_interval=0.01, integrator="rk4")
    acceleration = M * G / (M + 0.00125 / R**2)
    np.testing.assert_allclose(r.array("guide.displacement"), -0.5 * acceleration * r.time**2, atol=2e-5)
    stretched = winch(length=0.5 + np.pi * R)
    first = simulate(stretched, duration=1e-3, step=5e-5, integrator="rk4").array("force.rope.stretch")[0]
    assert abs(first) < 1e-12


@pytest.mark.parametrize("integrator", ["rk4", "radau", "generalised-alpha"])
def test_a_winch_hauls_in_by_its_turns(integrator):
    """Driven by a turn and a half: the load is where R φ says, less what its weight stretches the rope."""
    sections = winch(start=3.0) | {"drivers": {"haul": {"coordinate": "axle", "value": "-3*pi*step(time, 0, 0, 1, 1)"}}}
    r = simulate(sections, duration=1.2, step=1e-4, output_interval=0.01, integrator=integrator)
    expected = -R * r.array("axle.angle") - M * G / 1e6
    late = r.time > 0.1
    np.testing.assert_allclose(r.array("guide.displacement")[late], expected[late], atol=2e-5)
    assert r.array("guide.displacement")[-1] > 3 * np.pi * R - 1e-4


def test_two_winches_lift_a_hook_block_by_the_mean_of_what_they_haul_in():
    """The rope runs from one drum around the sheave of the block to the other drum: z = (R φ₁ + R φ₂)/2 - (m g/2)/(2 k)."""
    sheave, block, stiffness = 0.1, 2.0, 1e6
    away = sheave + R
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {
            "left": solid(1.0, position=[-away, 0, 1]),
            "right": solid(1.0, position=[away, 0, 1]),
            "block": solid(block),
        },
        "joints": {
            "first": {"type": "revolute", "bodies": ["ground", "left"], "point": [-away, 0, 1], "axis": [0, 1, 0]},
            "second": {"type": "revolute", "bodies": ["ground", "right"], "point": [away, 0, 1], "axis": [0, 1, 0]},
            "guide": slide("ground", "block", point=[0, 0, 0], axis=[0, 0, 1]),
        },
        "drivers": {
            "one": {"coordinate": "first", "value": "-4*pi*step(time, 0, 0, 1, 1)"},
            "two": {"coordinate": "second", "value": "1*pi*step(time, 0.2, 0, 0.8, 1)"},
        },
        "forces": {
            "rope": {
                **{"type": "rope", "bodies": ["left", "block", "right"], "axis": [0, 1, 0], "radii": [R, -sheave, R]},
                **{"points": [[-away, 0, 1], [0, 0, 0], [away, 0, 1]], "wound": [3, 3]},
                **{"stiffness": stiffness, "damping": 2e3},
            }
        },
    }
    r = simulate(sections, duration=1.1, step=1e-4, output_interval=0.01, integrator="rk4")
    hauled = R * (r.array("second.angle") - r.array("first.angle"))
    late = r.time > 0.1
    np.testing.assert_allclose(
        r.array("guide.displacement")[late], 0.5 * hauled[late] - 0.25 * block * G / stiffness, atol=2e-5
    )
    assert hauled[-1] == pytest.approx(5.0 * np.pi * R, rel=1e-6)


def test_an_unwound_drum_holds_the_rope_at_its_rim():
    """A drum that is turned back by a whole turn from a quarter: the free part ends at the rim, which goes around."""
    sections = winch(start=0.25, stiffness=1e5) | {
        "drivers": {"turn": {"coordinate": "axle", "value": "2*pi*step(time, 0, 0, 1, 1)"}}
    }
    r = simulate(sections, duration=1.0, step=1e-4, output_interval=0.01, integrator="rk4")
    angle, z = r.array("axle.angle"), r.array("guide.displacement")
    length = 0.5 + 0.25 * 2 * np.pi * R
    # the end of the rope is fixed at the top at first; from a quarter turn on the rope is straight from there
    rim = R * np.sin(angle), 0.5 + R * np.cos(angle)
    straight = np.hypot(rim[0] - R, rim[1] - z)
    slack = r.array("force.rope.magnitude") == 0.0
    beyond = (angle > 0.5 * np.pi + 0.05) & ~slack
    assert beyond.sum() > 20
    np.testing.assert_allclose((straight - length)[beyond], r.array("force.rope.stretch")[beyond], atol=1e-9)


def test_a_pulley_of_any_radius_is_passed_without_turning_it():
    """Atwood's machine: a = g (m1 - m2)/(m1 + m2), and the pulley stays."""
    m1, m2, radius = 3.0, 2.0, 0.2
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {
            "pulley": solid(1.0, 0.01),
            "one": solid(m1, position=[-radius, 0, -1]),
            "two": solid(m2, position=[radius, 0, -1]),
        },
        "joints": {
            "axle": {"type": "revolute", "bodies": ["ground", "pulley"], "point": [0, 0, 0], "axis": [0, 1, 0]},
            "left": slide("ground", "one", point=[-radius, 0, -1], axis=[0, 0, 1]),
            "right": slide("ground", "two", point=[radius, 0, -1], axis=[0, 0, 1]),
        },
        "forces": {
            "rope": {
                **{"type": "rope", "bodies": ["one", "pulley", "two"], "axis": [0, 1, 0], "radii": [0, radius, 0]},
                **{"points": [[-radius, 0, -1], [0, 0, 0], [radius, 0, -1]], "stiffness": 1e6, "damping": 1e3},
                "length": 2.0 + np.pi * radius,
            }
        },
    }
    r = simulate(sections, duration=0.4, step=5e-5, output_interval=0.01, integrator="rk4")
    a = G * (m1 - m2) / (m1 + m2)
    np.testing.assert_allclose(r.array("right.displacement"), 0.5 * a * r.time**2, atol=2e-5)
    assert np.abs(r.array("axle.angle")).max() < 1e-12
    tension = 2 * m1 * m2 / (m1 + m2) * G
    np.testing.assert_allclose(r.array("force.rope.magnitude")[10:], tension, rtol=2e-3)
    # the ground, the first body of the axle, bears both parts of the rope and the weight
    np.testing.assert_allclose(r.array("joint_force")[10:, 0, 2], -2 * tension - G, rtol=2e-3)


def test_a_weight_that_winds_itself_around_a_post():
    """Without gravity, on a rope of length l - R θ, the speed stays and l l̇ = -R v: l² = l0² - 2 R v t (involute)."""
    length, speed = 1.0, 2.0
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {"ball": solid(1.0, position=[R, -length, 0], velocity=[speed, 0, 0])},
        "joints": {
            "plane": {"type": "planar", "bodies": ["ground", "ball"], "point": [R, -length, 0], "axis": [0, 0, 1]}
        },
        "forces": {
            "rope": {
                **{"type": "rope", "bodies": ["ground", "ball"], "points": [[0, 0, 0], [R, -length, 0]]},
                # it leaves the post at x = R towards -y, and winds itself up where the ball runs left-handed
                **{"axis": [0, 0, 1], "radii": [-R, 0], "wound": [1, 0], "stiffness": 1e8, "damping": 1e3},
            }
        },
    }
    r = simulate(sections, duration=2.0, step=2e-5, output_interval=0.02, integrator="rk4")
    x, y = r.array("ball.position.x"), r.array("ball.position.y")
    free = np.sqrt(x**2 + y**2 - R**2)
    grown = np.abs(free**2 - length**2)
    np.testing.assert_allclose(grown, 2 * R * speed * r.time, atol=2e-3)
    np.testing.assert_allclose(np.hypot(r.array("ball.velocity.x"), r.array("ball.velocity.y")), speed, rtol=1e-3)


def test_a_wheel_that_is_left_is_passed_over():
    """A rope from (-1, 0) over a wheel at the origin to a load that rises from below to above: then its way is the straight line."""
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {"load": solid(1.0, position=[1, 0, -0.5], velocity=[0, 0, 1])},
        "joints": {"guide": slide("ground", "load", point=[1, 0, -0.5], axis=[0, 0, 1])},
        "forces": {
            "rope": {
                **{"type": "rope", "bodies": ["ground", "ground", "load"], "axis": [0, 1, 0], "radii": [0, 0.1, 0]},
                **{"points": [[-1, 0, 0], [0, 0, 0], [1, 0, -0.5]], "stiffness": 1e-6, "length": 0.1},
            }
        },
    }
    r = simulate(sections, duration=1.0, step=1e-3, integrator="rk4")
    z = r.array("load.position.z")
    stretch = r.array("force.rope.stretch") + 0.1
    straight = np.hypot(2.0, z)
    above = z > 0.21
    np.testing.assert_allclose(stretch[above], straight[above], atol=1e-12)
    # below: two tangents and the arc between them
    a, rho = np.arcsin(0.1 / 1.0), np.hypot(1.0, z)
    b = np.arcsin(0.1 / rho)
    arc = a + b + np.arctan2(-z, 1.0)
    touched = z < 0.19
    tangents = np.sqrt(1.0 - 0.01) + np.sqrt(rho**2 - 0.01)
    np.testing.assert_allclose(stretch[touched], (tangents + 0.1 * arc)[touched], atol=1e-12)


def test_momenta_and_energy_of_free_bodies():
    """A carrier with a drum and a load that swings out of the plane, all free: momentum, angular momentum and energy stay."""
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {
            "carrier": solid(5.0, [0.3, 0.2, 0.4], angular_velocity=[0.5, 0.2, -0.3]),
            "drum": solid(
                1.0, 0.01, position=[0.3, 0, 0], angular_velocity=[0.5, 4.0, -0.3], velocity=[0, -0.09, -0.06]
            ),
            "load": solid(2.0, 0.02, position=[0.5, 0.1, -1], velocity=[0.3, 1.0, -0.5], angular_velocity=[1, 2, 3]),
        },
        "joints": {
            "axle": {"type": "revolute", "bodies": ["carrier", "drum"], "point": [0.3, 0, 0], "axis": [0, 1, 0]}
        },
        "markers": {
            "axis": {"body": "drum", "orientation": {"euler": [0, "-90 deg", 0], "sequence": "zxz"}},
            "sheave": {
                "body": "carrier",
                "position": [0.1, 0, -0.3],
                "orientation": {"euler": [0, "-90 deg", 0], "sequence": "zxz"},
            },
            "hook": {"body": "load", "position": [0, 0.02, 0.1]},
        },
        "forces": {
            "rope": {
                "type": "rope",
                "markers": ["axis", "sheave", "hook"],
                "radii": [0.08, -0.05, 0],
                "wound": [2, 0],
                "stiffness": 5e3,
            }
        },
    }
    r = simulate(sections, duration=1.0, step=2e-4, output_interval=0.01, integrator="rk4")
    assert r.array("force.rope.magnitude").max() > 10.0
    mass = np.array([5.0, 1.0, 2.0])
    v, x, w = (r.array(name) for name in ("velocity", "position", "angular_velocity"))
    momentum = np.einsum("b,tbi->ti", mass, v)
    np.testing.assert_allclose(momentum, momentum[:1] + 0 * momentum, atol=1e-9)
    inertia = [np.diag([0.3, 0.2, 0.4]), 0.01 * np.eye(3), 0.02 * np.eye(3)]
    angular = np.einsum("b,tbi->ti", mass, np.cross(x, v))
    for b in range(3):
        A = rotations(r.array("orientation")[:, b])
        angular += np.einsum("tij,jk,tlk,tl->ti", A, inertia[b], A, w[:, b])
    np.testing.assert_allclose(angular, angular[:1] + 0 * angular, atol=1e-7)
    assert np.abs(r.array("energy_error")).max() < 1e-7 * r.array("kinetic_energy").max()


def rotations(e):
    """(n, 3, 3) of Euler parameters (n, 4)."""
    e0, ev = e[:, 0], e[:, 1:]
    eye = np.eye(3)
    skew = np.zeros((len(e), 3, 3))
    skew[:, 0, 1], skew[:, 0, 2], skew[:, 1, 2] = -ev[:, 2], ev[:, 1], -ev[:, 0]
    skew -= np.transpose(skew, (0, 2, 1))
    outer = np.einsum("ti,tj->tij", ev, ev)
    return (2 * e0**2 - 1)[:, None, None] * eye + 2 * (outer + e0[:, None, None] * skew)


@pytest.mark.parametrize(
    ("change", "part"),
    [
        ({"radii": [R]}, "one radius for each point is needed, 0 for a point; there are 2 points"),
        ({"radii": [0, 0], "wound": [0, 0]}, "are all zero: such a rope runs from point to point"),
        ({"axis": None}, "`axis` is missing: the direction of the axes of the wheels"),
        ({"wound": [0, 1]}, "at this end there is no drum"),
        ({"radii": [1.0, 0]}, "lie in each other, seen along their axis: no rope runs between them"),
    ],
)
def test_refused(change, part):
    sections = winch()
    rope = sections["forces"]["rope"] | change
    sections["forces"]["rope"] = {key: value for key, value in rope.items() if value is not None}
    with pytest.raises(ModelError) as refused:
        machine(sections).check()
    assert part in str(refused.value)
