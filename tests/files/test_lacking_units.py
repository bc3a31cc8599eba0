"""Plain numbers among quantities: which of them lacks which unit is said at the first reading, with the line to write."""

import re

import pytest
import yaml

from nivel.errors import ModelError
from nivel.files import parse_machine

MACHINE = """\
format: 1
parameters: {v: 8 m/s, L: 2, h: 5 cm, k: 1000, w: 3, area: 0.3, air: 1.2 kg/m^3, x0: 20 cm, idle: 0}
gravity: [0, 0, -9.81]
functions:
  road(x): h*sin(pi*(x-5)/L)
  curve: {points: [0, 1], values: [0, 2]}
bodies:
  wheel: {mass: 40 kg, inertia: [1, 1, 1], position: [0, 0, 0.3]}
  bar: {mass: 1 kg, inertia: [1, 1, 1]}
joints:
  rail: {type: translational, bodies: [ground, wheel], point: [0, 0, 0], axis: [0, 0, 1]}
  hinge: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]}
forces:
  push: {type: force, body: wheel, vector: [0, 0, 0]}
  spring: {type: spring-damper, points: [[0, 0, 1], [0, 0, 0.3]], bodies: [ground, wheel], law: 0}
  drive: {type: motor, coordinate: rail, effort: 0}
  turn: {type: motor, coordinate: hinge, effort: 0}
drivers: {}
states: {s: {rate: 0}}
sensors: {seen: {value: 0}}
events: {}
simulation: {duration: 1 s}
"""

PUSH, LAW, EFFORT = "forces.push.vector.2", "forces.spring.law", "forces.drive.effort"
# where it stands, what stands there, what lacks a unit, and the line that is right
CASES = {
    "a stiffness": (LAW, "-2000*(length - x0)", "`2000` lacks the unit N/m", "-2000 N/m*(length - x0)"),
    "a parameter": (LAW, "-k*(length - x0)", "`k` lacks the unit N/m", "-(k*1 N/m)*(length - x0)"),
    "a spring and a damper": (
        LAW,
        "-400*(length - 20 cm) - 7*(rate - 1 m/s)",
        "`400` lacks the unit N/m and `7` the unit N s/m",
        "-400 N/m*(length - 20 cm) - 7 N s/m*(rate - 1 m/s)",
    ),
    "two numbers that are alike": (
        LAW,
        "-400*(length - 20 cm) - 400*(rate - 1 m/s)",
        "`400` lacks the unit N/m and `400` the unit N s/m",
        "-400 N/m*(length - 20 cm) - 400 N s/m*(rate - 1 m/s)",
    ),
    "a parameter that is zero": (
        LAW,
        "-idle*(length - x0)",
        "`idle` lacks the unit N/m",
        "-(idle*1 N/m)*(length - x0)",
    ),
    "an angle": (
        "forces.turn.effort",
        "-k*(hinge.angle - 20 deg)",
        "`k` lacks the unit N m/rad",
        "-(k*1 N m/rad)*(hinge.angle - 20 deg)",
    ),
    "a sine over a place": (
        PUSH,
        "5 N*sin(pi*(wheel.x-5 m)/L)",
        "`L` lacks the unit m",
        "5 N*sin(pi*(wheel.x-5 m)/(L*1 m))",
    ),
    "a wave number": (PUSH, "5 N*sin(w*(wheel.x - 1 m))", "`w` lacks the unit", "5 N*sin((w*1 m^-1)*(wheel.x - 1 m))"),
    "a choice": (
        EFFORT,
        "if(rail.displacement > x0, -500*(rail.displacement - x0), 0)",
        "`500` lacks the unit N/m",
        "if(rail.displacement > x0, -500 N/m*(rail.displacement - x0), 0)",
    ),
    "the larger of two": (
        EFFORT,
        "max(-70*(rail.displacement - x0), 5 N)",
        "`70` lacks the unit N/m",
        "max(-70 N/m*(rail.displacement - x0), 5 N)",
    ),
    "the size": (EFFORT, "70*abs(wheel.z - x0)", "`70` lacks the unit N/m", "70 N/m*abs(wheel.z - x0)"),
    "a product inside a product": (
        EFFORT,
        "-(5*(3*(wheel.z - x0)))*exp(-time)",
        "`5` lacks the unit N/m",
        "-(5 N/m*(3*(wheel.z - x0)))*exp(-time)",
    ),
    "a square": (PUSH, "0.5*air*area*wheel.vx^2", "`area` lacks the unit m^2", "0.5*air*(area*1 m^2)*wheel.vx^2"),
    "a root": (
        "states.s.rate",
        "1 m/s + sqrt(40*(wheel.z - x0))",
        "`40` lacks the unit m/s^2",
        "1 m/s + sqrt(40 m/s^2*(wheel.z - x0))",
    ),
    "a divisor": (PUSH, "5 N*exp(-v*time/30)", "`30` lacks the unit m", "5 N*exp(-v*time/(30 m))"),
    "a step": (PUSH, "30*step(time, 0, 0, 1, x0)", "`30` lacks the unit N/m", "30 N/m*step(time, 0, 0, 1 s, x0)"),
    "a number that is added": (
        PUSH,
        "200e3*(0.3 + h*sin(time) - wheel.z)",
        "`200e3` lacks the unit N/m",
        "200e3 N/m*(0.3 m + h*sin(time) - wheel.z)",
    ),
    "a quantity": ("bodies.wheel.mass", "7850*(2 m)", "`7850` lacks the unit kg/m", "7850 kg/m*(2 m)"),
    "a sensor": (
        "sensors.seen.value",
        "wheel.z*(1 m) - 12*(3 s)",
        "`12` lacks the unit",
        "wheel.z*(1 m) - 12 m^2/s*(3 s)",
    ),
}


def spoilt(changes, text=MACHINE):
    data = yaml.safe_load(text)
    for path, value in changes.items():
        put(data, path.split("."), value)
    return yaml.safe_dump(data, sort_keys=False, width=1000)


def put(data, steps, value):
    for step in steps[:-1]:
        data = data[int(step) if isinstance(data, list) else step]
    data[int(steps[-1]) if isinstance(data, list) else steps[-1]] = value


def faults_of(text):
    with pytest.raises(ModelError) as caught:
        parse_machine(text, "machine.yaml")
    return caught.value.faults


def proposed(fault):
    found = re.search(r"; write `([^`]*)`", fault.message)
    assert found is not None, fault.message
    return found[1]


def copied_in(text, faults):
    """The file with every proposed line in it, each in its place."""
    data = yaml.safe_load(text)
    for fault in faults:
        line = proposed(fault)
        if fault.path.startswith("functions."):
            head, _, line = line.partition(": ")
            assert fault.path == f"functions.{head}"
            data["functions"][head] = line
        else:
            put(data, fault.path.split("."), line)
    return yaml.safe_dump(data, sort_keys=False, width=1000)


def test_the_machine_that_is_spoilt_here_is_right():
    assert parse_machine(spoilt({}), "machine.yaml").bodies


@pytest.mark.parametrize("name", CASES)
def test_a_factor_without_its_unit_is_named_with_the_line_to_write(name):
    path, written, lacks, right = CASES[name]
    text = spoilt({path: written})
    (fault,) = faults_of(text)
    assert fault.path == path
    assert text.splitlines()[fault.line - 1].count(written) == 1
    assert lacks in fault.message
    assert proposed(fault) == right
    assert parse_machine(copied_in(text, [fault]), "machine.yaml")


def test_the_road_under_a_wheel_is_right_after_one_reading():
    text = spoilt({PUSH: "max(0, 200e3*(0.3 + road(v*time) - wheel.z))", "bodies.bar.mass": "2 s"})
    of_function, of_mass, of_force = sorted(faults_of(text), key=lambda fault: fault.line)
    assert of_function.path == "functions.road(x)"
    assert "`L` lacks the unit m;" in of_function.message
    assert f"called by {PUSH}" in of_function.message
    assert proposed(of_function) == "road(x): h*sin(pi*(x-5 m)/(L*1 m))"
    assert of_mass.path == "bodies.bar.mass"
    assert "`200e3` lacks the unit N/m;" in of_force.message
    assert "a force (N) was expected" in of_force.message
    assert proposed(of_force) == "max(0, 200e3 N/m*(0.3 m + road(v*time) - wheel.z))"
    right = copied_in(text.replace("2 s", "2 kg"), [of_function, of_force])
    assert parse_machine(right, "machine.yaml")


def test_all_that_calls_a_function_is_right_once_the_function_is():
    """The second call fits today, and no more when the length of the wave has a unit."""
    text = spoilt(
        {
            "functions.road(x)": "h*sin(pi*x/L)",
            PUSH: "200e3*(road(v*time) - wheel.z)",
            "sensors.seen.value": "road(80*time)",
        }
    )
    faults = faults_of(text)
    assert {fault.path for fault in faults} == {"functions.road(x)", PUSH, "sensors.seen.value"}
    assert any(proposed(fault) == "road(80 m/s*time)" for fault in faults)
    assert parse_machine(copied_in(text, faults), "machine.yaml")


def test_a_function_that_several_call_is_one_fault():
    text = spoilt({PUSH: "1 kN/m*road(v*time)", "sensors.seen.value": "road(2*v*time)"})
    (fault,) = faults_of(text)
    assert fault.path == "functions.road(x)"
    assert parse_machine(copied_in(text, [fault]), "machine.yaml")


def test_units_are_found_through_functions_that_call_functions():
    text = spoilt({PUSH: "1 kN/m*twice(v*time)"})
    text = text.replace("functions:\n", "functions:\n  twice(x): 2*road(x)\n")
    (fault,) = faults_of(text)
    assert fault.path == "functions.road(x)"
    assert parse_machine(copied_in(text, [fault]), "machine.yaml")


def test_functions_that_are_written_alike_are_told_apart():
    text = spoilt({PUSH: "1 kN/m*road(v*time)", "sensors.seen.value": "other(9*time)"})
    text = text.replace("functions:\n", "functions:\n  other(x): h*sin(pi*(x-5)/L)\n")
    (fault,) = faults_of(text)
    assert fault.path == "functions.road(x)"
    assert parse_machine(copied_in(text, [fault]), "machine.yaml")


@pytest.mark.parametrize("exponent", ["1e300", "400", "-1e9", "0.1"])
def test_odd_powers_are_refused_without_trouble(exponent):
    assert faults_of(spoilt({PUSH: f"37*(wheel.z - 1 m)^{exponent}"}))


@pytest.mark.parametrize(
    ("path", "legal"),
    [
        (LAW, "-2000*(length - 0.2) - 7*rate"),
        (PUSH, "200e3*(0.3 - wheel.z)"),
        (PUSH, "5 + 3*sin(w*time)"),
        (PUSH, "5 N*sin(w*time) + 2"),
        (PUSH, "curve(v*time)*5 N"),
        ("bodies.wheel.position", ["x0 + 1", "x0/2", "0.5*L"]),
    ],
)
def test_plain_numbers_in_si_stay_legal(path, legal):
    assert parse_machine(spoilt({path: legal}), "machine.yaml")


@pytest.mark.parametrize(
    ("path", "wrong"),
    [
        (PUSH, "3 m*hinge.angle"),
        (PUSH, "1 N + 1 kg*wheel.vx"),
        ("bodies.wheel.mass", "x0"),
        ("bodies.wheel.mass", "x0/2"),
    ],
)
def test_where_no_plain_number_is_at_fault_no_unit_is_proposed(path, wrong):
    (fault,) = faults_of(spoilt({path: wrong}))
    assert "lacks the unit" not in fault.message


def test_a_parameter_that_is_computed_is_answered_too():
    text = spoilt({"parameters.F": "12*(3 kg) - 5 N"})
    (fault,) = faults_of(text)
    assert fault.path == "parameters.F"
    assert "`12` lacks the unit m/s^2" in fault.message
    assert parse_machine(copied_in(text, [fault]), "machine.yaml")


def test_an_entry_of_a_table_is_answered_too():
    text = spoilt({EFFORT: {"of": "rail.displacement", "points": [0, 1], "values": ["5 N", "1200*x0"]}})
    (fault,) = faults_of(text)
    assert fault.path == "forces.drive.effort.values.1"
    assert proposed(fault) == "1200 N/m*x0"
    assert parse_machine(copied_in(text, [fault]), "machine.yaml")


def test_a_driver_is_answered_too():
    text = spoilt({"drivers": {"lift": {"coordinate": "rail", "value": "50*sin(time)*(1 s)"}}})
    (fault,) = faults_of(text)
    assert "`50` lacks the unit m/s" in fault.message
    assert parse_machine(copied_in(text, [fault]), "machine.yaml")
