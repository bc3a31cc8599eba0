"""Shapes of markers touch as those of bodies do, and `damping` of a contact loses what its closed form says."""

import numpy as np
import pytest
from scipy.optimize import brentq

import nivel
from nivel.files.reader import parse_machine

WALL = """
format: 1
name: shapes
gravity: [0.3, 0.2, -9.81]
bodies:
  crate: {{mass: 2, inertia: [0.02, 0.03, 0.04], position: [0, 0, 0.14], angular_velocity: [0.1, 0.2, 0.4]{of_body}}}
  ball: {{mass: 1, inertia: [0.01, 0.01, 0.01], position: [0.02, 0, 0.35], shape: {{type: sphere, radius: 5 cm}}}}
  block: {{density: 400, position: [0.2, 0, 0.12], shape: {{type: box, size: [0.1, 0.1, 0.1]}}, velocity: [-0.5, 0, 0]}}
markers:
  floor: {{body: ground, axis: [0, 0, 1]}}
{of_marker}
forces:
  floor: {{type: contact, body: {name}, plane: floor, stiffness: 2e4, exponent: 1, damping: 1, friction: 0.4}}
  ball: {{type: contact, bodies: [ball, {name}], stiffness: 2e4, exponent: 1, restitution: 0.5, friction: 0.4}}
  block: {{type: contact, bodies: [block, {name}], foundation_modulus: 1e7, damping: 1, friction: 0.4}}
  below: {{type: contact, body: block, plane: floor, stiffness: 2e4, exponent: 1, damping: 1, friction: 0.1}}
simulation: {{duration: 0.3, step: 0.5 ms, integrator: rk4}}
"""
BOX = "shape: {type: box, size: [0.2, 0.15, 0.25]}"


def machine_of(text):
    return nivel.Machine.from_record(parse_machine(text, "machine.yaml"))


def test_a_solid_moves_alike_whether_its_shape_is_its_own_or_that_of_a_turned_marker():
    """The marker is turned by 90° about x, where the box has y for z."""
    turned = "{type: box, size: [0.2, 0.25, 0.15], centre: [0, 0.02, 0.01]}"
    marker = f"  foot: {{body: crate, position: [0, 0.01, -0.02], orientation: {{axis: [1, 0, 0], angle: 90 deg}}, shape: {turned}}}"
    own = machine_of(WALL.format(of_body=f", {BOX}", of_marker="", name="crate")).simulate()
    its = machine_of(WALL.format(of_body="", of_marker=marker, name="foot")).simulate()
    assert own["force.floor.normal_force"].max() > 10.0
    assert own["force.block.normal_force"].max() > 0.1
    for variable in ("position", "orientation"):
        np.testing.assert_allclose(its.array(variable), own.array(variable), rtol=0.0, atol=1e-9)


IMPACT = """
format: 1
name: impact
bodies:
  ball: {{mass: 1, inertia: [1, 1, 1], position: [0, 0, 0.1], shape: {{type: sphere, radius: 0.1}}, velocity: [0, 0, -{speed}]}}
markers:
  floor: {{body: ground, axis: [0, 0, 1]}}
forces:
  floor: {{type: contact, body: ball, plane: floor, stiffness: {stiffness}, exponent: {exponent}, damping: {damping}}}
simulation: {{duration: 0.2, step: 0.1 ms, integrator: rk4}}
"""


@pytest.mark.parametrize(("speed", "damping", "exponent"), [(0.5, 0.4, 1), (2.0, 1.0, 1), (1.0, 0.7, 1.5)])
def test_an_impact_with_damping_leaves_with_the_speed_of_its_closed_form(speed, damping, exponent):
    """m v dv = -K δⁿ (1 + a v) dδ: ln((1 + x)/(1 - e x)) = x (1 + e) with x = a v, whatever K, n and m are."""
    x = damping * speed
    e = brentq(lambda e: np.log1p(x) - np.log1p(-e * x) - x * (1.0 + e), 1e-9, min(1.0, 1.0 / x) - 1e-9)
    text = IMPACT.format(speed=speed, damping=damping, exponent=exponent, stiffness=1e4)
    assert machine_of(text).simulate().array("velocity")[-1, 0, 2] == pytest.approx(e * speed, rel=1e-5)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("body: foot, plane", "body: floor, plane"), "the marker `floor` has no `shape`"),
        (("bodies: [ball, foot]", "bodies: [crate, foot]"), "the body `crate` has no shape"),
        (("damping: 1, friction: 0.1", "damping: 1, restitution: 0.1, friction: 0.1"), "in place of `restitution`"),
    ],
)
def test_what_has_no_shape_is_named(change, said):
    marker = f"  foot: {{body: crate, {BOX}}}"
    text = WALL.format(of_body="", of_marker=marker, name="foot")
    with pytest.raises(nivel.ModelError, match=said):
        machine_of(text.replace(*change))
