"""Contacts that steps pass on arcs, as of a sphere at the end of an arm that turns by 0.6 rad a step."""

import json

import pytest

from nivel import Machine
from nivel.files import parse_machine
from nivel.judge.after import touching_pairs

ARM = """
format: 1
name: arm
bodies:
  arm: {mass: 1, inertia: [0.1, 0.1, 0.1], shape: {type: sphere, radius: 2 mm, centre: [1, 0, 0]}}
  pin: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [0, %s, 0], shape: {type: sphere, radius: 2 mm}}
joints:
  hub: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1], start_rates: {angle: 60}}
  rail: {type: translational, bodies: [ground, pin], point: [0, 1, 0], axis: [1, 0, 0]}
forces:
  knock: {type: contact, bodies: [arm, pin], stiffness: 1e10, restitution: 1}
simulation: {duration: 0.2, step: 10 ms, output_interval: 10 ms, integrator: rk4}
"""


def contacts(text, **settings):
    trust = Machine.from_record(parse_machine(text)).simulate(verify=False, **settings).trust
    return [item for item in trust.items if item.name == "contact"]


def test_an_arm_that_steps_carry_through_a_pin_is_red():
    """The tip meets the pin after a quarter of a turn, or one and a quarter."""
    (line,) = contacts(ARM % 1)
    assert line.verdict == "red"
    assert (60.0 * line.time / (2.0 * 3.141592653589793)) % 1.0 == pytest.approx(0.25, abs=0.01)


def test_an_arm_that_misses_the_pin_is_not_told():
    assert contacts(ARM % 1.01) == []


def test_an_arm_that_knocks_the_pin_away_is_not_told():
    assert contacts(ARM % 1, step="1 us", output_interval="1 ms", duration="40 ms") == []


SHAPES = {
    "capsule": "capsule, radius: 2 mm, length: 10 mm",
    "ellipsoid": "ellipsoid, semi_axes: [3 mm, 2 mm, 4 mm]",
    "box": "box, size: [4 mm, 6 mm, 4 mm]",
    "cylinder": "cylinder, radius: 2 mm, length: 6 mm",
}


@pytest.mark.parametrize("shape", list(SHAPES))
def test_a_pin_of_any_shape_that_steps_pass_is_red(shape):
    """The sphere at the end of the arm goes through the middle of the pin within a step; half a metre beside it it does not."""
    text = ARM.replace("{type: sphere, radius: 2 mm}}", f"{{type: {SHAPES[shape]}}}}}")
    (line,) = contacts(text % 1)
    assert line.verdict == "red"
    assert line.row == "knock"
    assert contacts(text % 1.5) == []


SHOT = """
format: 1
name: shot
bodies:
  shot: {density: 7850, velocity: [100, 0, 0], shape: {type: sphere, radius: 1 cm}}
  ball: {density: 7850, position: [%s, 0, 0], shape: {type: sphere, radius: 1 cm}}
forces:
  heap: {type: contacts, between: all, stiffness: 1e6, restitution: 1}
simulation: {duration: 20 ms, step: 1 ms, output_interval: 1 ms, integrator: rk4}
"""


def test_a_ball_that_steps_carry_through_another_of_a_heap_is_red():
    (line,) = contacts(SHOT % 0.525)
    assert line.verdict == "red"
    assert line.time == pytest.approx(5.25e-3, abs=1e-4)
    assert "ball" in line.text
    assert contacts(SHOT.replace("[%s, 0, 0]", "[0.525, 0.05, 0]")) == []


def shots(count):
    """`count` spheres, each shot through a plate of its own, and contacts of every sphere with every plate."""
    still = {"density": 7850, "shape": {"type": "box", "size": [0.01, 0.1, 0.1]}}
    shot = {"density": 7850, "velocity": [100, 0, 0], "shape": {"type": "sphere", "radius": 0.01}}
    places = range(count)
    bodies = {f"plate{k}": {**still, "position": [0.23, k, 0]} for k in places}
    bodies |= {f"shot{k}": {**shot, "position": [0, k, 0]} for k in places}
    pairs = [(i, j) for i in places for j in places]
    touch = {"type": "contact", "stiffness": 1e6, "restitution": 1}
    forces = {f"touch{i}_{j}": {**touch, "bodies": [f"shot{i}", f"plate{j}"]} for i, j in pairs}
    rates = {"duration": "5 ms", "step": "1 ms", "output_interval": "1 ms", "integrator": "rk4"}
    return {"format": 1, "name": "shots", "bodies": bodies, "forces": forces, "simulation": rates}


def test_only_pairs_that_come_near_are_looked_at(monkeypatch):
    """Twice the bodies, four times the contacts: the looks double."""
    looks = []
    depth = touching_pairs._depth
    monkeypatch.setattr(touching_pairs, "_depth", lambda *pose: looks.append(1) or depth(*pose))
    counts = []
    for count in (3, 6):
        looks.clear()
        result = Machine.from_record(parse_machine(json.dumps(shots(count)))).simulate(verify=False)
        assert len([item for item in result.trust.items if item.name == "contact"]) == min(count, 5)
        counts.append(len(looks))
    assert counts[1] == 2 * counts[0] > 0


def test_contacts_that_are_not_looked_at_are_told(monkeypatch):
    monkeypatch.setattr(touching_pairs, "MOST_LOOKS", 0)
    trust = Machine.from_record(parse_machine(json.dumps(shots(2)))).simulate(verify=False).trust
    (line,) = [item for item in trust.items if item.name == "unexamined" and "pass through" in item.text]
    assert "touch0_0" in line.text
    assert "touch1_1" in line.text
