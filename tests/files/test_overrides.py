"""Values set from outside the file."""

import numpy as np
import pytest
from base_machine import BASE

import nivel
from nivel.errors import ModelError
from nivel.files import parse_machine


def changed(**overrides):
    return parse_machine(BASE, overrides={path.replace("__", "."): value for path, value in overrides.items()})


def body(machine, name):
    return next(body for body in machine.bodies if body.name == name)


def test_values_as_texts_of_the_file_and_as_python_values():
    assert body(changed(bodies__crank__mass="22 kg"), "crank").mass == 22
    assert body(changed(bodies__crank__mass=22.5), "crank").mass == 22.5
    assert changed(gravity="[0, 0, -1.62]").gravity == changed(gravity=[0, 0, -1.62]).gravity == (0, 0, -1.62)
    assert changed(simulation__step="2e-3").simulation.step == 0.002
    assert changed(name="other").name == "other"


def test_parameters_reach_everything():
    machine = changed(parameters__radius="1 m")
    assert body(machine, "crank").position == (0, 0, -0.5)
    assert machine.markers[0].position == (1, 0, 0)


def test_entries_of_lists():
    assert changed(gravity__1="-1.62").gravity == (0, -1.62, 0)
    assert changed(joints__pin__markers__1__position__0="2 cm").joints[1].markers[1].position[0] == 0.02


def test_what_the_file_leaves_out_can_be_set():
    assert changed(simulation__output_interval="10 ms").simulation.output_interval == 0.01
    assert changed(
        simulation__stabilisation="baumgarte", simulation__baumgarte__alpha=5, simulation__baumgarte__beta=6
    ).simulation.baumgarte
    bare = "format: 1\nbodies: {a: {mass: 1, shape: {type: sphere, radius: 1}}}"
    assert parse_machine(bare, overrides={"simulation.step": "2 ms"}).simulation.step == 0.002


def test_the_name_of_an_element_stands_for_its_path():
    assert parse_machine(BASE, overrides={"crank.mass": "3 kg"}) == parse_machine(
        BASE, overrides={"bodies.crank.mass": "3 kg"}
    )


def test_a_later_override_sees_an_earlier_one():
    assert changed(gravity="[0, 0, 0]", gravity__2="-5").gravity == (0, 0, -5)


@pytest.mark.parametrize(
    ("path", "value", "element", "part"),
    [
        ("bodies.crnk.mass", "1", "bodies.crnk.mass", "did you mean `crank`"),
        ("parameters.radios", "1", "parameters.radios", "did you mean `radius`"),
        ("bodies.crank.mas", "1", "bodies.crank.mas", "did you mean `mass`"),
        ("bodies.crank.mass", "3 m", "bodies.crank.mass", "`3 m` is a length"),
        ("bodies.crank.mass.x", "3", "bodies.crank.mass.x", "is a single value"),
        ("body.crank.mass", "3", "body.crank.mass", "the section `body` is not known"),
        ("crnk.mass", "1", "crnk.mass", "the element `crnk` is not known; did you mean `crank`"),
        ("gravity.3", "3", "gravity.3", "is a list of 3"),
        ("gravity.x", "3", "gravity.x", "is a list of 3"),
        ("gravity.-1", "3", "gravity.-1", "is a list of 3"),
        ("gravity", "[0, 0", "gravity", "this is not YAML"),
        ("gravity", "{a: 1, a: 2}", "gravity", "second time"),
        ("simulation.step", "20", "simulation", "longer than `duration`"),
        ("bodies.", "3", "bodies.", "is not a path"),
        ("", "3", "", "is not a path"),
        ("format", "2", "format", "format 1"),
    ],
)
def test_faults_say_that_they_come_from_outside(path, value, element, part):
    with pytest.raises(ModelError) as caught:
        parse_machine(BASE, overrides={path: value})
    fault = next(fault for fault in caught.value.faults if part in fault.message)
    assert fault.path == element
    if element != "simulation":
        assert fault.line == 0
        assert "set from outside the file" in fault.message


TURNED = """
format: 1
parameters: {speed: 6 rad/s, rise: 2 s, double: 2*speed}
bodies: {arm: {mass: 1, inertia: [1, 1, 1], position: [1, 0, 0]}}
joints: {root: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}}
drivers: {turn: {coordinate: root.angle, value: "double/rise*time^2"}}
simulation: {duration: 1 s}
"""


def test_a_number_for_a_parameter_has_the_unit_of_the_file(tmp_path):
    """Numbers are in SI units: of a speed in rad/s."""
    path = tmp_path / "machine.yaml"
    path.write_text(TURNED, encoding="utf-8")
    machine = nivel.load(path)
    assert (
        machine.with_values({"parameters.speed": 7.0}).record
        == machine.with_values({"parameters.speed": "7 rad/s"}).record
    )
    assert machine.with_values({"parameters.speed": np.float64(7.0)}).parameters["double"] == 14.0
    with pytest.raises(ModelError, match="speed"):
        machine.with_values({"parameters.speed": float("nan")})
    with pytest.raises(ModelError, match="radius"):
        machine.with_values({"parameters.radius": 1.0})


def test_entries_of_lists_that_are_not_written():
    moving = parse_machine(
        "format: 1\nbodies: {a: {mass: 1, inertia: [1, 1, 1]}}", overrides={"bodies.a.velocity.1": 2}
    )
    assert body(moving, "a").velocity == (0, 2, 0)
    turning = parse_machine(
        "format: 1\nbodies: {a: {mass: 1, inertia: [1, 1, 1]}}",
        overrides={"a.angular_velocity.2": "30 rpm", "gravity.1": -1.62},
    )
    assert body(turning, "a").angular_velocity == pytest.approx((0, 0, np.pi))
    assert turning.gravity == (0, -1.62, 0)
    # where zero is not what stands there unless it is written, the line to write is said
    with pytest.raises(ModelError, match=r"`bodies.a.position` is not written.*write `position: \[0, 0, 0\]`"):
        parse_machine("format: 1\nbodies: {a: {mass: 1, inertia: [1, 1, 1]}}", overrides={"bodies.a.position.0": 1})


def test_moments_of_inertia_by_place_and_by_axis(tmp_path):
    path = tmp_path / "a.yaml"
    path.write_text("format: 1\nbodies: {a: {mass: 1, inertia: [1, 1.5, 2]}}", encoding="utf-8")
    machine = nivel.load(path)
    assert machine["bodies.a.inertia.2"] == machine["bodies.a.inertia.zz"] == 2
    for word in ("2", "zz"):
        assert machine.with_values({f"bodies.a.inertia.{word}": 2.2})["bodies.a.inertia.zz"] == 2.2
    with pytest.raises(ModelError, match=r"`angular_velocity` is not written.*write `angular_velocity: \[0, 0, 0\]`"):
        machine["bodies.a.angular_velocity.1"]
