"""Ground with heights is met at every speed by methods that choose their steps, and fixed steps that pass it are red."""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

import nivel
from lanes import tail
from nivel import Machine
from nivel.files import parse_machine

FAULTS = Path(__file__).parent
SPEEDS, METHODS = (1, 20, 400), ("radau", "dopri5", "dop853", "bdf")


def states(result):
    return [item for item in result.trust.items if item.name == "state"]


RIDGE = """
format: 1
bodies: {{b: {{position: [-8, 0, {z}], shape: {{type: sphere, radius: 0.05}}, mass: 0.5, velocity: [{v}, 0, 0]}}}}
markers: {{land: {{body: ground, axis: [0, 0, 1], x_axis: [1, 0, 0]}}}}
forces:
  c:
    {{type: contact, body: b, plane: land, stiffness: {k}, exponent: 1, restitution: 1,
     heights: {{size: [20, 2], function: "1 - 10*x^2", points: [401, 3]}}}}
simulation: {{duration: {duration}, output_interval: {duration}/40, step: {duration}/400, integrator: {method}}}
"""


def over_ridge(speed, method, height=0.5):
    stiffness = 1e7 * speed**2
    text = RIDGE.format(v=speed, z=height, k=stiffness, duration=12.0 / speed, method=method)
    return Machine.from_record(parse_machine(text)), np.sqrt(stiffness / 0.5)


def touch_of_ridge(height, radius=0.05):
    """(x, normal) where the middle of the ball, at this height, is its radius from the parabola 1 - 10 x² (exact between heights)."""
    s = brentq(lambda s: 1.0 - 10.0 * s * s + radius / np.hypot(1.0, 20.0 * s) - height, -3.0, -1e-9)
    normal = np.array([20.0 * s, 0.0, 1.0]) / np.hypot(1.0, 20.0 * s)
    return s + radius * normal[0], normal


@pytest.mark.parametrize("method", tail(METHODS, ["radau", "dopri5"]))
@pytest.mark.parametrize("speed", tail(SPEEDS, [400]))
def test_a_ball_meets_a_ridge_at_its_time_at_any_speed(speed, method):
    """Steps without the ridge would be metres long. The straight ways before and after meet in the middle of the contact, a quarter of a
    period π/ω behind its begin."""
    machine, omega = over_ridge(speed, method)
    result = machine.simulate(verify=False)
    x, normal = touch_of_ridge(0.5)
    place, velocity = result.array("b.position")[-1], result.array("b.velocity")[-1]
    mirrored = np.array([1.0, 0.0, 0.0]) - 2.0 * normal[0] * normal
    np.testing.assert_allclose(velocity / speed, mirrored, atol=2e-3)
    # along x: -8 + v t = place - velocity (T - t)
    middle = (place[0] + 8.0 - velocity[0] * result.time[-1]) / (speed - velocity[0])
    assert (middle - 0.5 * np.pi / omega) * speed - 8.0 == pytest.approx(x, abs=1e-4)
    assert states(result) == []


def test_the_ball_above_the_ridge_flies_on():
    machine, _ = over_ridge(400, "dopri5", height=1.0501)
    result = machine.simulate(verify=False)
    np.testing.assert_allclose(result.array("b.position")[-1], [4.0, 0.0, 1.0501], atol=1e-9)
    assert result.array("force.c.normal_force").max() == 0.0


@pytest.mark.parametrize("method", tail(METHODS, ["radau"]))
def test_the_hill_of_the_fault_is_met(method):
    """The surface 6 exp(-((x - 30.1)/0.8)²) of fine steps, to the error of the cubics between its heights."""
    result = nivel.load(FAULTS / "terrain.yaml").simulate(verify=True, integrator=method)
    touches = result.array("force.c.normal_force") > 0.0
    at = result.array("b.position")[np.argmax(touches)]
    assert 0.587 < result.time[np.argmax(touches)] < 0.59
    assert at[2] == pytest.approx(2.0 + 5.0 * 0.589 - 0.5 * 9.81 * 0.589**2, abs=0.01)
    assert result.array("b.position")[-1, 0] < 29.5
    assert result.trust.verdict == "green"


SLIDES = """
format: 1
gravity: [0, 0, -9.81]
bodies:
  b: {{position: [-20, 0, {z}], shape: {shape}, mass: 1, inertia: [0.1, 0.1, 0.1], velocity: [{v}, 0, 0]}}
markers: {{land: {{body: ground, axis: [0, 0, 1], x_axis: [1, 0, 0]}}}}
forces:
  c:
    {{type: contact, body: b, plane: land, stiffness: {k}, exponent: 1, restitution: 1,
     heights: {{size: [200, 2], function: "if(abs(x - 10.17) < 0.16, 0.5, 0)", points: [2001, 3]}}}}
simulation: {{duration: 40/{v}, output_interval: 1/{v}, step: 0.1/{v}, integrator: {method}}}
"""


@pytest.mark.parametrize("method", tail(["radau", "dopri5", "dop853"], ["radau"]))
@pytest.mark.parametrize("speed", tail(SPEEDS, [400]))
@pytest.mark.parametrize(
    "shape", tail(["sphere, radius: 0.05", "box, size: [0.2, 0.2, 0.2]"], ["sphere, radius: 0.05"])
)
def test_what_slides_does_not_pass_a_kerb(shape, speed, method):
    """It rests on the floor, whose force it has all the way; the kerb of three meshes comes after 30 m."""
    if shape.startswith("box") and method != "radau":
        pytest.skip("four corners of a stiff box make a million explicit steps")
    stiffness, points = 1e6 * max(1.0, speed) ** 2, 4 if shape.startswith("box") else 1
    reach = 0.05 if points == 1 else 0.1
    z = reach - 9.81 / stiffness / points
    text = SLIDES.format(z=z, shape=f"{{type: {shape}}}", v=speed, k=stiffness, method=method)
    result = Machine.from_record(parse_machine(text)).simulate(verify=False)
    place = result.array("b.position")[:, 0]
    before = result.time < (30.0 - reach - 0.1) / speed
    np.testing.assert_allclose(place[before], -20.0 + speed * result.time[before], atol=1e-6)
    assert place.max() < 10.1
    assert states(result) == []


def test_fixed_steps_that_pass_a_ridge_are_red():
    machine, _ = over_ridge(20, "rk4")
    (line,) = states(machine.simulate(verify=False, step=0.03, output_interval=0.03))
    assert line.verdict == "red"
    assert line.row == "c"
    assert line.time == pytest.approx(0.4, abs=0.02)  # 8 m at 20 m/s, half the width of the ridge 0.2 m
    above, _ = over_ridge(20, "rk4", height=1.06)
    assert states(above.simulate(verify=False, step=0.03, output_interval=0.03)) == []


def test_no_point_of_the_ground_is_found_through_a_hill():
    """From beside a steep hill Newton's method comes to its far side, seen from where it stands the distance would be negative."""
    result = nivel.load(FAULTS / "terrain.yaml").simulate(verify=False, integrator="rk4", step=1e-4)
    place, depth = result.array("b.position"), result.array("force.c.depth")
    height = 6.0 * np.exp(-(((place[:, 0] - 30.1) / 0.8) ** 2))
    above = place[:, 2] > height + 0.05 * np.hypot(1.0, 10.0)
    assert above.sum() > 400
    assert depth[above].max() < 0.0
