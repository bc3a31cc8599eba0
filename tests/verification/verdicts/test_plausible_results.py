"""Plausibility of results: numbers that no real machine has are amber lines with the number named; the motion is as exact as before."""

import pytest

import nivel

CART = """\
format: 1
bodies:
  cart: {mass: 1, inertia: [1, 1, 1], position: [0.5, 0, 0]}
joints:
  rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}
forces:
  push: {type: force, body: cart, vector: [FORCE, 0, 0]}
simulation: {duration: 10 ms, step: 1 ms}
"""


def lines(path, text, **settings):
    path.write_text(text, encoding="utf-8")
    result = nivel.load(path).simulate(**settings)
    return result, [item for item in result.trust.items if item.name == "plausible"]


def test_a_force_that_is_a_thousand_times_too_large_is_told_by_its_speed_and_power(tmp_path):
    """F = 1 MN on 1 kg for 10 ms: v = 10 km/s, P = F v = 10 GW; a rail has up to 1 km/s, a force 1 GW."""
    result, found = lines(tmp_path / "cart.yaml", CART.replace("FORCE", "1 MN"), verify=False)
    assert result.array("velocity")[-1, 0, 0] == pytest.approx(1e4)
    assert result.trust.verdict == "amber"
    assert {item.row: item.fraction for item in found} == {
        "rate of rail.displacement": pytest.approx(10.0),
        "push.power": pytest.approx(10.0),
    }
    assert any("push.power is 10000 MW, and up to 1000 MW is usual, at t = 0.01 s" in item.text for item in found)


def test_a_usual_force_has_no_line(tmp_path):
    result, found = lines(tmp_path / "cart.yaml", CART.replace("FORCE", "1 kN"), verify=False)
    assert not found
    assert result.trust.verdict == "green"


def test_statics_have_the_line_too(tmp_path):
    path = tmp_path / "hung.yaml"
    text = CART.replace("FORCE", "-9.81 N").replace("simulation:", "gravity: [0, -9810, 0]\nsimulation:")
    spring = "  spring: {type: joint-spring-damper, coordinate: rail.displacement, stiffness: 100 N/m, damping: 0}\nsimulation:"
    path.write_text(text.replace("gravity", f"{spring[:-11]}gravity", 1), encoding="utf-8")
    (line,) = [item for item in nivel.load(path).statics().trust.items if item.name == "plausible"]
    assert line.row == "gravity"
    assert line.verdict == "amber"
