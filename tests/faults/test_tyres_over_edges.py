"""Tyres on kerbs, steps, walls and in ditches: the disc comes to the nearest ground, and nothing is gained or lost by it."""

import numpy as np
import pytest

from simulating import machine

pytestmark = pytest.mark.covering

RADIUS, WIDTH, STIFFNESS, MASS = 0.4, 0.2, 150e3, 420.0  # [m], [m], [N/m], [kg]
AXLE = [0, 1, 0]


def wheel(function, speed, height, points=6001):
    """A wheel in an upright hub that a planar joint guides, rolling along x towards what stands or lies at x = 2 m."""
    own = {"position": [0, 0, height], "velocity": [speed, 0, 0]}
    return {
        "gravity": [0, 0, -9.81],
        "bodies": {
            "hub": {"mass": MASS - 20, "inertia": [20, 20, 20], **own},
            "wheel": {"mass": 20, "inertia": [0.6, 1, 0.6], "angular_velocity": [0, speed / RADIUS, 0], **own},
        },
        "markers": {
            "axle": {"body": "wheel", "axis": AXLE},
            "road": {"body": "ground", "axis": [0, 0, 1], "x_axis": [1, 0, 0]},
            "rail": {"body": "ground", "axis": AXLE},
            "side": {"body": "hub", "axis": AXLE},
        },
        "joints": {
            "level": {"type": "planar", "markers": ["rail", "side"]},
            "bearing": {"type": "revolute", "bodies": ["hub", "wheel"], "point": [0, 0, height], "axis": AXLE},
        },
        "forces": {
            "t": {
                "type": "tyre",
                "wheel": "axle",
                "plane": "road",
                "heights": {"size": [60, 2], "points": [points, 3], "function": function},
                "radius": RADIUS,
                "width": WIDTH,
                "nominal_load": 4000,
                "stiffness": STIFFNESS,
                "damping": 1,
                "rolling_resistance": 0,
            }
        },
    }


GROUND = {
    "kerb": ("if(x > 2, 0.05, 0)", 5.0),
    "step": ("if(x > 2, -0.1, 0)", 5.0),
    "ditch": ("if(x > 2, if(x < 2.3, -0.1, 0), 0)", 5.0),
    "furrow": ("-max(0, 0.3 - 2*abs(x - 2))", 4.0),
    "wall": ("if(x > 2, 1, 0)", 2.0),
}


@pytest.mark.parametrize("ground", GROUND)
def test_energy_is_kept_over_edges_and_in_ditches(ground):
    """Corners of the way of the centre, where two places are equally near, cost an order of the step."""
    function, speed = GROUND[ground]
    lost = []
    for step in (1e-3, 1e-4):
        settings = {
            "duration": 1.4 if ground == "wall" else 0.7,
            "step": step,
            "integrator": "rk4",
            "output_interval": 1e-3,
        }
        run = machine(wheel(function, speed, 0.39)).simulate(verify=False, **settings)
        lost.append(np.abs(run.array("energy_error")).max() / run.array("kinetic_energy")[0])
    assert lost[0] < 2e-3
    assert lost[1] < 4e-4
    if ground == "step":
        # between the step and the ground it flies, and no force acts
        place, force = run.array("position")[:, 0, 0], run.array("force.t.magnitude")
        assert np.count_nonzero((place > 2.15) & (place < 2.4)) > 40
        assert not force[(place > 2.15) & (place < 2.4)].any()
    if ground == "wall":
        assert run.array("position")[:, 0, 0].max() < 2.0 - 0.6 * RADIUS
        assert run.array("velocity")[-1, 0, 0] < -0.9 * speed


@pytest.mark.parametrize("ahead", [-0.3, -0.2, -0.12, -0.06, 0.03, 0.1])
def test_the_deflection_is_the_radius_less_the_distance_to_the_nearest_edge(ahead):
    """The mean of four places 0.1 radius before and behind and beside is a stair of 1/4, 3/4 and all of the kerb.

    Meshes are 2 mm long, and the cubic between heights passes a stair of half a kerb by 3.7 mm.
    """
    kerb, height = 0.1, 0.38
    sections = wheel(f"if(x > {-ahead}, {kerb}, 0)", 0.0, height, points=30001)
    run = machine(sections).simulate(verify=False, duration=1e-6, step=1e-6)
    stairs = [
        (-np.inf, 0.0),
        *((-ahead + k * 0.1 * RADIUS, share * kerb) for k, share in ((-1, 0.25), (0, 0.75), (1, 1.0))),
    ]
    nearest = min(np.hypot(max(edge, 0.0), height - h) for edge, h in stairs)
    assert run.array("force.t.deflection")[0] == pytest.approx(RADIUS - nearest, abs=5e-3)
