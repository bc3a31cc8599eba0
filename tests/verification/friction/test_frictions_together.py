"""Frictions with stiction that hold one motion at rest together: what they hold is known, their shares are not, and the report says so."""

import numpy as np
import pytest

from nivel.errors import SolveError
from nivel.results.result import Result
from simulating import G, hinge, simulate, slide, solid
from test_friction import MASS, sled
from test_held_friction import crank, found

pytestmark = pytest.mark.covering

METHODS = pytest.mark.parametrize(
    ("integrator", "coordinates"),
    [("rk4", "absolute"), ("rk4", "relative"), ("generalised-alpha", "absolute"), ("radau", "relative")],
)
LOW, HIGH = 0.1, 0.3


def incline(degrees):
    return G * np.sin(np.radians(degrees)), -G * np.cos(np.radians(degrees)), 0


def pair(degrees=0.0, speed=0.0, forces=None):
    """A block on a rail that two frictions rub."""
    scrape = {"type": "friction", "coordinate": "rail", "coefficient": HIGH, "model": "stiction"}
    both = {"scrape": scrape, **(forces or {})}
    return sled({"model": "stiction", "coefficient": LOW}, speed, forces=both, gravity=incline(degrees))


@METHODS
@pytest.mark.parametrize("degrees", [3, 16])
def test_two_frictions_of_one_rail(degrees, integrator, coordinates):
    """m g sin α is what both hold: at 3° either could do it alone, at 16° neither the weaker one, which may be at its limit, nor the other
    is known."""
    r = simulate(pair(degrees), integrator=integrator, coordinates=coordinates, duration=0.5, step=1e-3)
    (item,) = found(r)
    assert (item.verdict, r.trust.verdict) == ("amber", "green")
    assert "rub and scrape hold rail.displacement at rest together (t = " in item.text
    assert item.text.split(" to ")[1].startswith("0.5 s)")
    assert r.trust.undetermined_efforts == ("force.rub.magnitude", "force.scrape.magnitude")
    held = r.array("force.rub.magnitude") + r.array("force.scrape.magnitude")
    np.testing.assert_allclose(held[1:], -MASS * incline(degrees)[0], rtol=1e-9)


@METHODS
def test_they_are_named_from_the_stop_on(integrator, coordinates):
    """While it slides each is μ N; v0/(g (μ + μ')) is when it stops, and a speed of 1e-6 of the first is reached some 14 τ behind."""
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 1e-3, "output_interval": 1e-3}
    r = simulate(pair(speed=1.0), duration=0.5, **settings)
    stop = 1.0 / (G * (LOW + HIGH))
    (item,) = found(r)
    assert stop < (item.time or 0.0) < stop + 0.05
    slides = (r.time > 0) & (r.time < stop - 5e-3)
    np.testing.assert_allclose(r.array("force.rub.magnitude")[slides], -LOW * MASS * G, rtol=1e-9)


@METHODS
def test_frictions_of_a_loop(integrator, coordinates):
    """A slider-crank at rest: the joints tie its hinge and its slide to each other."""
    sections = crank(0.0)
    del sections["drivers"]
    rub = {"type": "friction", "coefficient": 0.5, "model": "stiction", "normal_load": 200.0}
    sections["forces"] = {"rub": {**rub, "coordinate": "slide"}, "scrape": {**rub, "coordinate": "main", "radius": 0.1}}
    (item,) = found(simulate(sections, integrator=integrator, coordinates=coordinates, duration=0.2, step=1e-3))
    assert "rub and scrape hold slide.displacement and main.angle at rest together" in item.text


def test_groups_that_have_nothing_to_do_with_each_other_are_told_apart():
    sections = pair(3)
    sections["bodies"]["other"] = solid(MASS, 0.01, position=[0, 1, 0])
    sections["joints"]["track"] = slide("ground", "other", point=[0, 1, 0])
    for name in ("rub", "scrape"):
        sections["forces"][f"{name}2"] = {**sections["forces"][name], "coordinate": "track"}
    (item,) = found(simulate(sections, duration=0.2, step=1e-3))
    assert "rub and scrape hold rail.displacement at rest together" in item.text
    assert "rub2 and scrape2 hold track.displacement at rest together" in item.text


def arms():
    """A double pendulum that friction holds in both of its hinges."""
    rub = {"type": "friction", "coefficient": 0.5, "model": "stiction", "normal_load": 1000.0, "radius": 0.1}
    return {
        "gravity": [0, -G, 0],
        "bodies": {"a": solid(position=[0.5, 0, 0]), "b": solid(position=[1.5, 0, 0])},
        "joints": {"main": hinge("ground", "a"), "pin": hinge("a", "b", (1, 0, 0))},
        "forces": {"rub": {**rub, "coordinate": "main"}, "scrape": {**rub, "coordinate": "pin"}},
    }


def swinging():
    """A block to and fro on a spring that is stronger than both frictions at every turn of 0.4 s."""
    spring = {"type": "joint-spring-damper", "coordinate": "rail", "stiffness": 1500.0}
    return pair(speed=10.0, forces={"spring": spring})


@pytest.mark.parametrize(
    "sections",
    [pair(40, 0.1), arms(), swinging(), sled({"model": "stiction"})],
    ids=["sliding", "each its own", "turning", "one"],
)
@pytest.mark.parametrize("integrator", ["rk4", "generalised-alpha"])
def test_nothing_is_said_where_shares_are_known(sections, integrator):
    r = simulate(sections, integrator=integrator, duration=0.4, step=1e-3, output_interval=1e-3)
    assert not found(r)
    assert r.trust.undetermined_efforts == ()


def test_a_run_that_grows_beyond_all_bounds_is_no_worse_for_it():
    """An unstable damper takes both frictions with it: what is no number rests nowhere, and the failure names the damper."""
    damper = {"type": "joint-spring-damper", "coordinate": "rail", "damping": 1e6}
    with pytest.raises(SolveError, match="holder is the force that takes most power") as caught:
        simulate(pair(speed=1.0, forces={"holder": damper}), integrator="rk4", duration=10.0, step=1e-3)
    assert isinstance(caught.value.result, Result)
    assert not found(caught.value.result)
