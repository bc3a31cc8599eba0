"""Friction with stiction on motions that are prescribed: at rest it and the driver share the load in many ways, and the report says so."""

import numpy as np
import pytest

from simulating import G, hinge, simulate, slide, solid
from test_friction import sled

pytestmark = pytest.mark.covering

RADIUS, LOAD, MU = 0.1, 100.0, 0.5
STOPS = "0.2/(1+exp(-100*(time-0.3)))"  # rests from 0.55 s on: its rate is below 3e-10 rad/s
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


def rubbing(coordinate="pin", **more):
    rub = {"type": "friction", "coordinate": coordinate, "coefficient": MU, "model": "stiction", "normal_load": LOAD}
    return {"rub": {**rub, "radius": RADIUS, **more}}


def arms(value, coordinate="pin", forces=None):
    """A double pendulum, one of whose hinges is driven."""
    return {
        "gravity": [0, -G, 0],
        "bodies": {"a": solid(position=[0.5, 0, 0]), "b": solid(position=[1.5, 0, 0])},
        "joints": {"main": hinge("ground", "a"), "pin": hinge("a", "b", (1, 0, 0))},
        "drivers": {"turn": {"coordinate": coordinate, "value": value}},
        "forces": forces or rubbing(),
    }


def crank(value):
    """A slider-crank, driven at its crank: the slide rubs, which the joints tie to the driver."""
    return {
        "gravity": [0, -G, 0],
        "bodies": {
            "crank": solid(position=[0.3, 0.4, 0]),
            "rod": solid(position=[1.1, 0.4, 0]),
            "block": solid(position=[1.6, 0, 0]),
        },
        "joints": {
            "main": hinge("ground", "crank"),
            "ball": {"type": "spherical", "bodies": ["crank", "rod"], "point": [0.6, 0.8, 0]},
            "cross": {
                "type": "universal",
                "bodies": ["rod", "block"],
                "point": [1.6, 0, 0],
                "axes": [[0, 0, 1], [0.8, 1, 0]],
            },
            "slide": slide("ground", "block", point=[1.6, 0, 0]),
        },
        "drivers": {"turn": {"coordinate": "main", "value": value}},
        "forces": {"rub": {k: v for k, v in rubbing("slide")["rub"].items() if k != "radius"}},
    }


def found(result):
    return [item for item in result.trust.items if item.name == "shared_friction"]


@METHODS
def test_the_report_names_who_shares_the_load_and_when(integrator, coordinates):
    """While it turns friction is -μ N r; at rest results show none of it, and all of the load with the driver."""
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 1e-3, "output_interval": 0.05}
    r = simulate(arms(STOPS), duration=1.0, **settings)
    (item,) = found(r)
    assert (item.verdict, r.trust.verdict, item.time) == ("amber", "green", 0.0)
    assert "rub and driver turn hold pin.angle at rest together (t = 0 to 0.05 s, 0.55 to 1 s)" in item.text
    assert r.trust.undetermined_efforts == ("force.rub.magnitude", "driver.turn.effort")
    turning = np.abs(r.time - 0.3) < 0.06
    np.testing.assert_allclose(r.array("force.rub.magnitude")[turning], -MU * LOAD * RADIUS, rtol=1e-9)
    np.testing.assert_allclose(r.array("force.rub.magnitude")[r.time > 0.7], 0.0, atol=1e-6)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_what_joints_tie_to_a_driver_is_prescribed_too(coordinates):
    r = simulate(crank(0.0), coordinates=coordinates, duration=0.1, step=1e-3)
    (item,) = found(r)
    assert "rub and driver turn hold slide.displacement at rest together" in item.text


def test_a_coordinate_that_joints_hold_shares_its_load_with_them():
    """A triangle of three bars does not move, and one of its hinges rubs."""
    A, B = (0.0, 0.0, 0.0), (0.5, 0.7, 0.0)
    sections = {
        "bodies": {"a": solid(position=[0.25, 0.35, 0]), "b": solid(position=[0.75, 0.35, 0])},
        "joints": {
            "left": hinge("ground", "a", A),
            "top": {"type": "spherical", "bodies": ["a", "b"], "point": list(B)},
            "right": {
                "type": "universal",
                "bodies": ["b", "ground"],
                "point": [1, 0, 0],
                "axes": [[0, 0, 1], [0.5, 0.7, 0]],
            },
        },
        "forces": rubbing("left"),
    }
    (item,) = found(simulate(sections, duration=0.1, step=1e-3))
    assert "rub and left, top, right hold left.angle at rest together" in item.text


@pytest.mark.parametrize(
    "sections",
    [
        arms("10*time"),
        arms("0.3*sin(20*time)"),
        arms(0.0, "main"),
        arms(0.0, forces={"push": {"type": "torque", "body": "b", "vector": [0, 0, 1]}}),
        arms(0.0, forces=rubbing(model="coulomb", transition_speed=0.01)),
        sled({"model": "stiction"}),
    ],
    ids=["turning", "turning back", "driven elsewhere", "no friction", "no stiction", "no driver"],
)
def test_nothing_is_said_where_the_load_is_known(sections):
    r = simulate(sections, duration=1.0, step=1e-3, output_interval=0.01)
    assert not found(r)
    assert r.trust.undetermined_efforts == ()
