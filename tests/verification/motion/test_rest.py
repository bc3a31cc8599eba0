"""Machines that stand still for ten seconds: the trust report of every method is green, at rest."""

import numpy as np
import pytest

from simulating import G, hinge, machine, simulate, slide, solid
from test_friction import sled

METHODS = pytest.mark.parametrize(
    ("integrator", "coordinates"),
    [
        ("rk4", "absolute"),
        ("rk4", "relative"),
        ("dopri5", "absolute"),
        ("generalised-alpha", "absolute"),
        ("generalised-alpha", "independent"),
        ("radau", "relative"),
        ("bdf", "relative"),
        ("ros2", "relative"),
    ],
)


def on_incline():
    """A block on a rail at 16°, less than its angle of friction; its joint, origin and centre of mass are one point."""
    slope = np.radians(-16)
    return sled({"model": "stiction"}, axis=(np.cos(slope), np.sin(slope), 0))


def hanging():
    return {
        "gravity": [0, -G, 0],
        "bodies": {"bob": solid(2, position=[0, -0.5, 0])},
        "joints": {"pin": hinge("ground", "bob")},
    }


def four_bar():
    """A closed loop on which nothing acts."""
    A, B, C, D = np.array([[0.1, 0.2, 0], [0.3, 0.7, 0], [1.5, 1.1, 0], [1.3, 0.25, 0]])
    bars = {"crank": (A, B), "rod": (B, C), "rocker": (C, D)}
    return {
        "bodies": {name: solid(1.0, 0.05, position=0.5 * (p + q)) for name, (p, q) in bars.items()},
        "joints": {
            "main": hinge("ground", "crank", tuple(A)),
            "ball": {"type": "spherical", "bodies": ["crank", "rod"], "point": B},
            "cross": {
                "type": "universal",
                "bodies": ["rod", "rocker"],
                "point": C,
                "axes": [[0, 0, 1], [0.4, -1.2, 0]],
            },
            "last": hinge("rocker", "ground", tuple(D)),
        },
    }


def driven():
    """A pendulum that a driver holds aside."""
    held = {"hold": {"coordinate": "pin.angle", "value": 0.0}}
    return {**hanging(), "bodies": {"bob": solid(2, position=[0.4, -0.3, 0])}, "drivers": held}


@METHODS
@pytest.mark.parametrize("still", [on_incline, hanging, four_bar, driven])
def test_round_off_of_a_machine_at_rest_is_green(still, integrator, coordinates):
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 1e-3, "output_interval": 0.1}
    trust = simulate(still(), duration=10.0, **settings).trust
    assert trust.verdict == "green", str(trust)
    assert trust.at_rest


def test_a_scene_knows_radii_of_gyration():
    """k² = J/m about the centre of mass, the largest; a point mass has none."""
    flat = {"plate": solid(2.0, (0.1, 0.2, 0.3)), "dot": {"mass": 1.0, "point_mass": True, "position": [1, 0, 0]}}
    r = machine({"bodies": flat, "simulation": {"duration": 1e-3}}).simulate()
    assert [body["radius_of_gyration"] for body in r.scene["bodies"]] == pytest.approx([np.sqrt(0.15), 0.0])


@pytest.mark.parametrize("damping", [1.0, 1e4, 1e8])
def test_a_damper_is_no_load(damping):
    """A block of 2 kg that a damper stops from 10 µm/s is at rest: what counts is 1e-6 of its weight and of the rail's reaction, however
    hard the damper pulls, and however much of that, at 45°, the rail takes."""
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"block": solid(2.0, velocity=[1e-5, 0, 0])},
        "joints": {"rail": slide("ground", "block")},
        "forces": {
            "holder": {
                "type": "spring-damper",
                "bodies": ["ground", "block"],
                "points": [[-1, -1, 0], [0, 0, 0]],
                "damping": damping,
            }
        },
    }
    r = simulate(sections, integrator="radau", coordinates="relative", duration=0.3, step=1e-3, tolerance=1e-6)
    assert r.trust.at_rest
    assert r.trust.energy_scale_kind == "smallest energy that counts"
    assert r.trust.energy_scale == pytest.approx(1e-6 * r.trust.size * 2 * 2.0 * G, rel=1e-3)
