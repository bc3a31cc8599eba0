"""Errors on the scale of each body: an angle counts as far as the body reaches, not as far as the machine."""

import numpy as np
import pytest

import nivel

# a rotor on a torsional spring, φ = sin t, and a body a hundred metres away
MACHINE = """\
format: 1
bodies:
  far: {mass: 1, inertia: [1, 1, 1], position: [100, 0, 0]}
  rotor: {mass: 1, inertia: [0.01, 0.01, 0.01], position: [0, 0, 0], angular_velocity: [0, 0, 1]}
joints:
  pin: {type: revolute, bodies: [ground, rotor], point: [0, 0, 0], axis: [0, 0, 1]}
  rail: {type: translational, bodies: [ground, far], point: [100, 0, 0], axis: [1, 0, 0]}
forces:
  spring: {type: joint-spring-damper, coordinate: pin.angle, stiffness: 0.01 N*m/rad, damping: 0}
simulation: {duration: 10, integrator: rk4}
"""
DIAMETER = 0.2  # [m] of gyration: 2 √(I/m)


@pytest.mark.parametrize(("step", "verdict"), [(0.3, "green"), (0.7, "amber")])
def test_the_angle_of_a_small_rotor_is_no_error_of_the_whole_machine(tmp_path, step, verdict):
    path = tmp_path / "rotor.yaml"
    path.write_text(MACHINE, encoding="utf-8")
    result = nivel.load(path).simulate(step=step, verify=True)
    angle = float(np.abs(result.array("pin.angle") - np.sin(result.time)).max())
    stated = result.trust.accuracy_estimate
    assert angle * DIAMETER / 3.0 < stated < 3.0 * angle * DIAMETER
    # of its own motion it is told all the same: a hundredth of a radian is visible in its curve
    assert next((item.verdict for item in result.trust.items if item.name == "parts"), "green") == verdict
    assert (angle < 0.01) == (verdict == "green")


def test_numbers_of_beams_are_told_by_the_steps_alone(tmp_path):
    """What the elements make wrong is in the estimate of each number, and not in the lines on quantities: they say so."""
    path = tmp_path / "bar.yaml"
    path.write_text(
        """\
format: 1
gravity: [0, 0, -9.81]
beams:
  bar:
    {from: [0, 0, 0], to: [1, 0, 0], elements: 2, order: 1, section: {type: rectangle, width: 2 cm, height: 2 cm},
    material: {youngs_modulus: 70 GPa, poisson_ratio: 0.3, density: 2700}, damping: 0.001}
joints:
  clamp: {type: fixed, bodies: [ground, bar.start], point: [0, 0, 0]}
simulation: {duration: 0.02, step: 1 ms}
""",
        encoding="utf-8",
    )
    result = nivel.load(path).simulate(verify=True)
    lines = [item.text for item in result.trust.items if item.name == "quantities"]
    assert lines
    assert all("by the steps alone" in line for line in lines)


def test_round_off_of_a_sensor_in_degrees_is_no_error(tmp_path):
    """A rotor that vibrates by 1e-13 rad, with steps that follow it by a tenth, in degrees: a radian is the scale, in whatever unit."""
    text = MACHINE.replace("[0, 0, 1]}", "[0, 0, 1e-13]}").replace("duration: 10", "duration: 10, step: 1.2 s")
    sensor = 'sensors:\n  shown: {value: "180/pi*pin.angle", units: deg}\nsimulation'
    path = tmp_path / "shown.yaml"
    path.write_text(text.replace("simulation", sensor), encoding="utf-8")
    result = nivel.load(path).simulate(verify=True)
    assert not [item.text for item in result.trust.items if item.name == "quantities" and item.verdict != "green"]
