"""Friction with stiction on a motion that drivers prescribe: however slowly it goes, the effort is all that the load gives, against it."""

import numpy as np
import pytest

from simulating import G, hinge, simulate, solid
from test_friction import MASS, MU, sled
from test_held_friction import crank

pytestmark = pytest.mark.covering

LIMIT = MU * MASS * G
STEPS = [
    ("rk4", "absolute"),
    ("rk4", "relative"),
    ("generalised-alpha", "absolute"),
    ("generalised-alpha", "independent"),
]
FIXED = pytest.mark.parametrize(("integrator", "coordinates"), STEPS)
METHODS = pytest.mark.parametrize(
    ("integrator", "coordinates"), [*STEPS, ("radau", "relative"), ("bdf", "relative"), ("ros2", "relative")]
)


def drawn(place, **friction):
    """A block on a rail that a driver moves to `place`."""
    sections = sled({"model": "stiction", **friction})
    sections["drivers"] = {"winch": {"coordinate": "rail", "value": place}}
    return sections


@METHODS
def test_a_creeping_driver_overcomes_all_of_it(integrator, coordinates):
    """1 µm/s: μ N + b v is the effort of the driver, and its work (μ N + b v) v t is heat."""
    speed, viscous = 1e-6, 3.0
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 1e-3, "output_interval": 0.02}
    r = simulate(drawn(f"{speed}*time", viscous=viscous), duration=0.1, **settings)
    np.testing.assert_allclose(r.array("force.rub.magnitude"), -LIMIT - viscous * speed, rtol=1e-9)
    np.testing.assert_allclose(r.array("driver.winch.effort"), LIMIT + viscous * speed, rtol=1e-9)
    np.testing.assert_allclose(r.array("dissipated_energy"), LIMIT * speed * r.time, rtol=1e-6, atol=1e-15)
    assert r.trust.verdict == "green"


@FIXED
def test_it_turns_with_the_driver(integrator, coordinates):
    """To and fro by 1 µm: the heat of the way, 4 µm a period, is μ N times it; a step may be wrong by its own way."""
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 1e-3}
    r = simulate(drawn("1e-6*sin(2*pi*(10*time + 0.03))"), duration=0.2, **settings)
    phase = 2 * np.pi * (10 * r.time + 0.03)
    away = np.abs(np.cos(phase)) > 1e-3
    np.testing.assert_allclose(r.array("force.rub.magnitude")[away], -LIMIT * np.sign(np.cos(phase))[away], rtol=1e-9)
    turning = 1e-6 * (20 * np.pi * 1e-3) ** 2
    assert abs(r.array("dissipated_energy")[-1] - LIMIT * 8e-6) < 4 * LIMIT * turning


@pytest.mark.parametrize("stabilisation", ["none", "direct"])
def test_a_driver_that_comes_to_rest_is_left_with_all_of_the_load(stabilisation):
    """On an incline the driver lowers the block and then holds it: m g sin α - μ N before, m g sin α behind. Velocities that `none` leaves
    open do not matter, for the driver says which way it goes."""
    slope, way, rate = np.radians(40), 1e-6, 200.0
    sections = sled({"model": "stiction"}, gravity=(G * np.sin(slope), -G * np.cos(slope), 0))
    sections["drivers"] = {"winch": {"coordinate": "rail", "value": f"{way}/(1 + exp(-{rate}*(time - 0.1)))"}}
    settings = {"integrator": "generalised-alpha", "coordinates": "absolute", "step": 1e-3}
    r = simulate(sections, duration=0.3, stabilisation=stabilisation, **settings)
    share = 1 / (1 + np.exp(-rate * (r.time - 0.1)))
    push = MASS * (way * rate**2 * share * (1 - share) * (1 - 2 * share) - G * np.sin(slope))
    drag = LIMIT * np.cos(slope)
    lowers, holds = np.abs(r.time - 0.1) < 0.04, r.time > 0.17
    np.testing.assert_allclose(r.array("force.rub.magnitude")[lowers], -drag, rtol=1e-9)
    np.testing.assert_allclose(r.array("driver.winch.effort")[lowers], (push + drag)[lowers], rtol=1e-9)
    np.testing.assert_allclose(r.array("force.rub.magnitude")[holds], 0.0, atol=1e-9)
    np.testing.assert_allclose(r.array("driver.winch.effort")[holds], push[holds], rtol=1e-9)
    (item,) = [item for item in r.trust.items if item.name == "shared_friction"]
    assert "rub and driver winch hold rail.displacement at rest together" in item.text


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("integrator", ["rk4", "generalised-alpha"])
def test_what_joints_tie_to_a_slow_driver_slides_too(integrator, coordinates):
    """The crank turns by 20 µrad: the slide goes along, with all friction that its reaction gives."""
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 1e-3, "output_interval": 0.01}
    r = simulate(crank("1e-4*time"), duration=0.2, **settings)
    rate = r.array("slide.displacement.rate")
    assert np.abs(rate).min() > 1e-6
    np.testing.assert_allclose(
        r.array("force.rub.magnitude"), -np.sign(rate) * r.array("force.rub.normal_load") * 0.5, rtol=1e-9
    )
    assert np.abs(r.array("energy_error")).max() < 1e-6 * r.array("dissipated_energy")[-1]


def test_two_drivers_move_it_together():
    """The hinge between two arms turns by the sum of what two drivers turn, of which one goes back: +2 and -3 µrad/s."""
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {
            "a": solid(position=[0.5, 0, 0]),
            "b": solid(position=[1.5, 0, 0]),
            "c": solid(position=[1.5, 1, 0]),
        },
        "joints": {
            "main": hinge("ground", "a"),
            "pin": hinge("a", "b", (1, 0, 0)),
            "last": hinge("b", "c", (2, 0, 0)),
        },
        "couplings": {
            "sum": {"type": "linear", "coordinates": ["main.angle", "pin.angle", "last.angle"], "factors": [1, 1, -1]}
        },
        "drivers": {
            "turn": {"coordinate": "main", "value": "2e-6*time"},
            "back": {"coordinate": "pin", "value": "-3e-6*time"},
        },
        "forces": {
            "rub": {
                "type": "friction",
                "coordinate": "last",
                "coefficient": 0.5,
                "model": "stiction",
                "normal_load": 10,
                "radius": 0.1,
            }
        },
    }
    r = simulate(sections, duration=0.1, step=1e-3, output_interval=0.02)
    np.testing.assert_allclose(r.array("force.rub.magnitude"), -0.5 * np.sign(r.array("last.angle.rate")), rtol=1e-9)


@pytest.mark.parametrize(
    ("integrator", "settings"),
    [
        ("rk4", {"coordinates": "absolute"}),
        ("rk4", {"coordinates": "absolute", "formulation": "penalty"}),
        ("rk4", {"coordinates": "relative", "formulation": "augmented-lagrangian"}),
        ("generalised-alpha", {"coordinates": "independent"}),
    ],
    ids=["multipliers", "penalty", "iterated", "independent"],
)
def test_it_never_drives(integrator, settings):
    """A crank turns at 20 rad/s: up to its dead points, where it slows down by more than its speed in τ, the slide rubs against its
    motion."""
    sections = crank("20*time")
    sections["forces"]["rub"] |= {"coefficient": 0.2}
    del sections["forces"]["rub"]["normal_load"]
    r = simulate(sections, integrator=integrator, duration=0.5, step=1e-3, output_interval=1e-3, **settings)
    load, rate = r.array("force.rub.normal_load"), r.array("slide.displacement.rate")
    assert np.count_nonzero(np.diff(np.sign(rate))) == 3
    np.testing.assert_allclose(r.array("force.rub.magnitude"), -0.2 * np.sign(rate) * load, atol=1e-7 * load.max())
