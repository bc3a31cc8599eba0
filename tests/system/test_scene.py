"""The scene says where joints and forces hold, in the frames of the bodies."""

import json

import numpy as np
import pytest

from nivel.files import parse_machine
from nivel.machine.core.orientation import matrix_from_euler_parameters
from nivel.machine.core.placement import placement
from nivel.system.build import build
from nivel.system.scene import scene
from nivel.system.system import Equations

MACHINE = """
format: 1
bodies:
  a:
    position: [1, 2, 3]
    orientation: {axis: [1, 2, 2], angle: 40 deg}
    shape: {type: box, size: [0.2, 0.1, 0.1]}
    density: 1000
  b: {position: [2, 2, 3], shape: {type: sphere, radius: 10 cm, centre: [0, 0, 5 cm]}, density: 1000}
  c: {position: [3, 2, 3], shape: {type: sphere, radius: 10 cm}, density: 1000}
markers:
  hook: {body: a, position: [0.1, 0, 0], axis: [0, 1, 0]}
  eye: {body: b, position: [0, 0, 0.1]}
  wall: {body: ground, position: [0, 0, 1], axis: [0, 2, 0]}
joints:
  pin: {type: revolute-translational, bodies: [ground, a], point: [1, 2, 3.1], axes: [[0, 1, 0], [3, 0, 0]]}
forces:
  strut: {type: spring-damper, bodies: [ground, a], points: [[0, 0, 0], [1, 2, 3.5]], stiffness: 1, free_length: 1}
  pull: {type: pair-force, markers: [hook, eye], magnitude: 1}
  coil: {type: torsional-spring-damper, markers: [hook, eye], stiffness: 1}
  mount: {type: bushing, markers: [hook, {body: b, position: [0, 1, 0]}], stiffness: [1, 1, 1, 1, 1, 1]}
  click: {type: contact, bodies: [b, c], stiffness: 1e5, restitution: 1}
  lean: {type: contact, body: b, plane: wall, stiffness: 1e5, restitution: 1}
  push: {type: force, body: a, vector: [1, 0, 0]}
  twist: {type: torque, body: a, vector: [1, 0, 0]}
  rest: {type: stop, coordinate: pin.angle, lower: 0, stiffness: 1, restitution: 1}
  drive: {type: motor, coordinate: pin.angle, effort: 1}
  slack: {type: joint-spring-damper, coordinate: pin.angle, stiffness: 1}
  rub: {type: friction, coordinate: pin.displacement, model: coulomb, coefficient: 0.1, transition_speed: 1 cm/s, normal_load: 3}
"""


@pytest.fixture(scope="module")
def machine():
    return parse_machine(MACHINE, "machine.yaml")


@pytest.fixture(scope="module")
def made(machine):
    return scene(machine, build(machine, Equations(6, normalisation=False)))


def in_space(machine, body, point):
    """A point of a body as the file places it."""
    if body == "ground":
        return np.array(point)
    position, theta = placement(next(each for each in machine.bodies if each.name == body))
    return position + matrix_from_euler_parameters(theta) @ point


def force(made, name):
    return next(each for each in made["forces"] if each["name"] == name)


def test_forces_with_two_ends_are_in_the_scene_and_no_others(made):
    kinds = {each["name"]: each["type"] for each in made["forces"]}
    assert kinds == {
        "strut": "spring-damper",
        "pull": "pair-force",
        "coil": "torsional-spring-damper",
        "mount": "bushing",
        "click": "contact",
        "lean": "contact",
    }
    assert all(len(each["bodies"]) == len(each["points"]) == 2 for each in made["forces"])


def test_a_global_point_of_a_force_is_given_in_its_bodys_frame(machine, made):
    strut = force(made, "strut")
    assert strut["bodies"] == ["ground", "a"]
    np.testing.assert_allclose(strut["points"][0], [0, 0, 0], atol=1e-15)
    assert not np.allclose(strut["points"][1], [1, 2, 3.5])
    np.testing.assert_allclose(in_space(machine, "a", strut["points"][1]), [1, 2, 3.5], atol=1e-12)


def test_markers_of_a_force_are_where_they_are_on_their_bodies(made):
    assert force(made, "pull")["points"] == [[0.1, 0, 0], [0, 0, 0.1]]
    assert force(made, "mount")["points"] == [[0.1, 0, 0], [0, 1, 0]]
    np.testing.assert_allclose(force(made, "coil")["axis"], [0, 1, 0], atol=1e-15)


def test_contacts_are_between_centres_of_shapes_or_with_a_plane(made):
    assert force(made, "click")["points"] == [[0, 0, 0.05], [0, 0, 0]]
    assert "axis" not in force(made, "click")
    lean = force(made, "lean")
    assert (lean["bodies"], lean["points"]) == (["b", "ground"], [[0, 0, 0.05], [0, 0, 1]])
    np.testing.assert_allclose(lean["axis"], [0, 1, 0], atol=1e-15)


def test_a_slot_is_a_direction_in_the_second_body(machine, made):
    (joint,) = made["joints"]
    _, theta = placement(machine.bodies[0])
    np.testing.assert_allclose(matrix_from_euler_parameters(theta) @ joint["slot"], [1, 0, 0], atol=1e-12)


def test_forces_do_not_change_the_size_of_the_machine(made):
    """Results are judged by where joints hold; forces stand beside that."""
    assert len(made["bodies"][0]["points"]) == len(made["ground_points"]) == 1


def test_the_scene_is_plain_json(made):
    assert json.loads(json.dumps(made)) == made
