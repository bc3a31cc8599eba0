"""Euler angles of markers as sensors, and drivers about every axis, against SciPy's rotations."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import nivel
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.machine.core.orientation import SEQUENCES

TUMBLING = """\
format: 1
bodies:
  a: {mass: 2, inertia: [0.3, 0.4, 0.5], angular_velocity: [3, 1, 2], orientation: {axis: [1, 2, 3], angle: 0.4}}
markers:
  m: {body: a, axis: [1, 1, 0]}
  centre: {body: a}
  post: {body: ground, axis: [0, 1, 1]}
sensors:
"""


def simulated(text, tmp_path, **settings):
    file = tmp_path / "machine.yaml"
    file.write_text(text, encoding="utf-8")
    return nivel.load(file).simulate(**settings)


def angles(result, name):
    return np.stack([result.array(f"sensor.{name}.{turn}") for turn in ("first", "second", "third")], axis=1)


def test_euler_angles_of_all_sequences_are_those_of_scipy(tmp_path):
    lines = [f"  {each}: {{marker: centre, quantity: euler_angles, sequence: {each}}}\n" for each in SEQUENCES]
    result = simulated(TUMBLING + "".join(lines), tmp_path)
    turned = Rotation.from_quat(result.array("a.orientation"), scalar_first=True)
    for sequence in SEQUENCES:
        np.testing.assert_allclose(angles(result, sequence), turned.as_euler(sequence.upper()), atol=1e-12)


def test_euler_angles_are_seen_from_another_marker(tmp_path):
    lines = "  seen: {marker: m, quantity: euler_angles, sequence: zyx, relative_to: post}\n"
    lines += "  own: {marker: m, quantity: euler_angles, sequence: zyx}\n  base: {marker: post, quantity: euler_angles, sequence: zyx}\n"
    result = simulated(TUMBLING + lines, tmp_path)
    own, base = (Rotation.from_euler("ZYX", angles(result, name)) for name in ("own", "base"))
    between = Rotation.from_euler("ZYX", angles(result, "seen"))
    assert (between.inv() * base.inv() * own).magnitude().max() < 1e-12


@pytest.mark.parametrize(
    ("spoilt", "answer"),
    [
        ("{marker: m, quantity: euler_angles}", "`sequence` is missing"),
        ("{marker: m, quantity: velocity, sequence: zyx}", "`sequence` belongs to the quantity `euler_angles`"),
        ("{marker: m, quantity: euler_angles, sequence: XYZ}", "capital letters"),
    ],
)
def test_a_sequence_belongs_to_euler_angles(spoilt, answer):
    with pytest.raises(ModelError, match=answer):
        parse_machine(f"{TUMBLING}  s: {spoilt}\n")


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_a_driver_turns_a_marker_about_any_axis(axis, tmp_path):
    direction = [int(each == axis) for each in "xyz"]
    result = simulated(
        f"""\
format: 1
bodies:
  a: {{mass: 2, inertia: [0.3, 0.4, 0.5]}}
joints:
  j: {{type: revolute, bodies: [ground, a], point: [0, 0, 0], axis: {direction}}}
markers:
  m: {{body: a}}
drivers:
  turn: {{marker: m, about: {axis}, value: "1.2*sin(2*time)"}}
""",
        tmp_path,
    )
    turned = Rotation.from_quat(result.array("a.orientation"), scalar_first=True).as_rotvec()
    expected = np.outer(1.2 * np.sin(2 * result.time), direction)
    np.testing.assert_allclose(turned, expected, atol=1e-7)
