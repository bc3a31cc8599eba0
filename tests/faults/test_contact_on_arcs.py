"""Contacts that steps pass on arcs, as of a sphere at the end of an arm that turns by 0.6 rad a step."""

import pytest

from nivel import Machine
from nivel.files import parse_machine

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


def test_contacts_of_shapes_without_a_check_are_named():
    text = (ARM % 1.01).replace(
        "shape: {type: sphere, radius: 2 mm}}", "shape: {type: capsule, radius: 2 mm, length: 10 mm}}"
    )
    trust = Machine.from_record(parse_machine(text)).simulate(verify=False).trust
    (line,) = [item for item in trust.items if item.name == "unexamined"]
    assert "pass through each other within a step at knock" in line.text
