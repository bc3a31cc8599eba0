"""Stiff states: between two steps they forget what an implicit method does not see, and *Loads* has nothing against them."""

from pathlib import Path

import numpy as np
import pytest

import nivel

FAULT = (Path(__file__).parent / "stiff-state.yaml").read_text(encoding="utf-8")


def run(tmp_path, text, **settings):
    path = tmp_path / "stiff.yaml"
    path.write_text(text, encoding="utf-8")
    return nivel.load(path).simulate(verify=True, **settings)


@pytest.mark.parametrize(("integrator", "rate"), [("hht", 2e3), ("generalised-alpha", 2e5), ("newmark", 2e6)])
def test_a_stiff_state_that_is_right_is_green(tmp_path, integrator, rate):
    """ȧ = -k (a - sin ωt) has a = (k² sin ωt - k ω cos ωt)/(k² + ω²) once the start has decayed, for α methods within 20 steps."""
    result = run(tmp_path, FAULT.replace("2000", f"{rate:.0f}"), integrator=integrator)
    t, w = result.time, 10.0
    true = (rate**2 * np.sin(w * t) - rate * w * np.cos(w * t)) / (rate**2 + w**2)
    assert np.abs(result.array("state.a") - true)[100:].max() < 1e-4
    assert result.trust.verdict == "green", result.trust.items


def test_a_vibration_that_a_stiff_state_would_follow_is_missed(tmp_path):
    """sin(2π 3000 t) is zero at every step of 1 ms; a state with the rate 2000/s follows it by a tenth."""
    text = FAULT.replace("sin(10*time)", "sin(10*time) - sin(2*pi*3000*time)")
    result = run(tmp_path, text, integrator="hht", duration=0.2)
    assert [item.row for item in result.trust.items if item.name == "loads"] == ["a.rate"]
    assert result.trust.verdict == "red"


BUMP = """
format: 1
gravity: [0, 0, -9.81]
bodies:
  hub: {mass: 380, inertia: [20, 20, 20], position: [0, 0, 0.29], velocity: [10, 0, 0]}
  wheel: {mass: 20, inertia: [0.6, 1, 0.6], position: [0, 0, 0.29], velocity: [10, 0, 0], angular_velocity: [0, 33, 0]}
markers:
  axle: {body: wheel, axis: [0, 1, 0]}
  road: {body: ground, axis: [0, 0, 1], x_axis: [1, 0, 0]}
joints:
  level: {type: planar, bodies: [ground, hub], point: [0, 0, 0.29], axis: [0, 1, 0]}
  upright: {type: revolute, bodies: [hub, wheel], point: [0, 0, 0.29], axis: [0, 1, 0]}
forces:
  front: {type: tyre, wheel: axle, plane: road, radius: 315 mm, width: 195 mm, nominal_load: 4 kN,
    heights: {size: [60 m, 2 m], points: [601, 3], function: "0.01*exp(-(x - 3)^2)"}}
simulation: {duration: 0.6, integrator: radau, tolerance: 1e-8}
"""


def test_stretches_of_a_tyre_that_are_round_off_turn_no_light(tmp_path):
    """Straight on over a bump nothing stretches it across or about the normal."""
    result = run(tmp_path, BUMP)
    assert 0.0 <= np.abs(result.array("state.front.across")).max() < 1e-12
    assert not [item.text for item in result.trust.items if item.name == "states"]
    assert result.trust.verdict == "green", result.trust.items
