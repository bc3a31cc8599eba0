"""A machine with other values keeps the elements that are written alike: it is, to the last bit, what reading its file with them gives."""

from pathlib import Path

import pytest

import nivel
from nivel.errors import ModelError
from nivel.files.reader import read_machine

SUSPENSION = Path(__file__).parents[2] / "examples" / "vehicles" / "suspension.yaml"
MACHINE = """
format: 1
parameters: {length: 20 cm, offset: 0, half: length/2}
functions: {wave(t): "1 N*(half/length)*sin(t)"}
bodies:
  block: {mass: 1, inertia: [1, 1, 1]}
  bob: {mass: 0.5, point_mass: true, position: [offset, 0, -half]}
joints:
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}
  string: {type: distance, bodies: [block, bob], points: [[0, 0, 0], [offset, 0, -half]]}
forces:
  spring: {type: joint-spring-damper, coordinate: rail, stiffness: 100 N/m}
  pull: {type: force, body: block, vector: ["wave(2*time)", 0, 0]}
simulation: {duration: 0.1}
"""


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("machines") / "machine.yaml"
    path.write_text(MACHINE, encoding="utf-8")
    return path


def told(make):
    """The record as JSON, or the faults."""
    try:
        return make().model_dump_json()
    except ModelError as error:
        return str(error)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("bodies.block.mass", 2.5),
        ("bodies.block.mass", True),  # 1 == True, and yet no mass
        ("bodies.block.inertia", [1.0, 1.0, 1]),
        ("parameters.length", "35 cm"),
        ("parameters.offset", -0.0),
        ("parameters.offset", "1 kg"),
        ("functions.wave(t)", "3 N*cos(t)"),
        ("joints.rail.start", {"displacement": 0.1}),
        ("joints.rail.type", "revolute"),  # what is moved by the coordinate `rail` is another one then
        ("joints.rail.type", "cylindrical"),
        ("joints.string.points.1.0", "half"),
        ("forces.pull.vector.0", "wave(3*time)"),
        ("forces.pull.body", "bob"),
        ("forces.spring.coordinate", "rail.angle"),
        ("forces.spring.stiffness", "-"),
        ("gravity", [0, 0, -1]),
        ("simulation.duration", 0.2),
        ("bodies.blok.mass", 1),
    ],
)
def test_other_values_are_read_as_if_they_stood_in_the_file(path, value, file):
    machine = nivel.load(file)
    assert told(lambda: machine.with_values({path: value}).record) == told(
        lambda: read_machine(file, overrides={path: value})
    )


def test_only_what_a_value_concerns_is_made_anew():
    machine = nivel.load(SUSPENSION)
    other = machine.with_values({"parameters.stiffness": "30 kN/m", "bodies.chassis.mass": 310})
    changed = [
        each.name
        for section in ("bodies", "joints", "forces")
        for each, its in zip(getattr(machine.record, section), getattr(other.record, section), strict=True)
        if each is not its
    ]
    assert changed == ["chassis", "coil"]
