"""Machine files that are right, and how values are read."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from base_machine import BASE

from nivel import Expression, Table
from nivel.errors import ModelError
from nivel.files import locate, nodes, parse_machine, read_machine
from nivel.files.tree import read_tree, read_value
from nivel.machine.core.placement import placement

MACHINE = parse_machine(BASE)
BODIES = {body.name: body for body in MACHINE.bodies}


def test_the_order_of_the_file_is_kept():
    assert list(BODIES) == ["crank", "rod", "wheel"]
    assert [joint.name for joint in MACHINE.joints] == ["hinge", "pin", "knee"]


def test_units_parameters_and_arithmetic():
    crank = BODIES["crank"]
    assert crank.mass == 21
    assert crank.position == (0, 0, -0.125)
    assert crank.centre_of_mass == (0.01, 0, 0)
    assert crank.orientation.euler == pytest.approx((np.pi / 2, np.pi / 2, -np.pi / 2))
    assert crank.angular_velocity[0] == pytest.approx(np.pi)
    assert np.allclose(placement(BODIES["rod"])[0], (0.5, 0, 0))


def test_forces():
    push = MACHINE.forces[1]
    assert push.vector[0] == 0
    assert isinstance(push.vector[1], Expression)
    assert push.vector[2] == Table((0.0, 1.0, 2.0), (0.0, 5.0, 0.0))


def test_the_name_defaults_to_that_of_the_file():
    assert parse_machine(BASE.replace("name: base\n", ""), "somewhere/slider-crank.yaml").name == "slider-crank"


def test_parameters_are_folded_into_expressions():
    text = BASE.replace("10 + 3*sin(2*pi*time)", "radius*4 N * cos(2*pi*time/(2 s))")
    component = parse_machine(text).forces[1].vector[1]
    assert component(0) == pytest.approx(1)
    assert component(1) == pytest.approx(-1)
    assert "radius" not in component.text


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e3", 1000.0),
        ("1e-3", 0.001),
        ("-1.5E+2", -150.0),
        (".5", 0.5),
        ("5.", 5.0),
        ("+3", 3),
        ("0x1F", 31),
        ("0o17", 15),
        ("017", 17),
        ("12:30", "12:30"),
        ("1_000", "1_000"),
        ("no", "no"),
        ("on", "on"),
        ("yes", "yes"),
        ("true", True),
        ("False", False),
        ("~", None),
        ("null", None),
        ("", None),
        ("'5'", "5"),
        ('"true"', "true"),
        ("2001-01-01", "2001-01-01"),
        ("=", "="),
        ("1e", "1e"),
        (".", "."),
        ("22 kg", "22 kg"),
        ("[1, a, ~]", [1, "a", None]),
        ("{a: 1, 2: b}", {"a": 1, "2": "b"}),
    ],
)
def test_values_follow_yaml_1_2(text, value):
    read = read_value(text)
    assert read == value
    assert type(read) is type(value)


@pytest.mark.parametrize(
    "text", [BASE, "format: 1\nbodies: {a: &x {mass: 1}, b: *x}", "a: 'b", "", "\0", "a: *b", "[" * 99, "--- 1\n--- 2"]
)
def test_without_libyaml_nothing_changes(text, monkeypatch):
    def tree():
        try:
            read = read_tree(text, "file")
        except ModelError as error:
            return [(fault.line, fault.path) for fault in error.faults]
        return read.data, read.places, read.keys

    with_libyaml = tree()
    monkeypatch.setattr(nodes, "_Loader", yaml.SafeLoader)
    assert tree() == with_libyaml


def test_numbers_that_yaml_1_1_takes_for_texts():
    settings = parse_machine(
        BASE.replace("step: 1 ms", "step: 1e-3").replace("duration: 8", "duration: 1e1")
    ).simulation
    assert (settings.duration, settings.step) == (10.0, 0.001)


def test_the_stabilisation_called_none_is_a_word():
    assert parse_machine(BASE.replace("direct", "none")).simulation.stabilisation == "none"


def test_aliases():
    text = BASE.replace("position: [radius, 0, 0]", "position: &arm [radius, 0, 0]").replace("[-0.9, 0, 0]", "*arm")
    assert parse_machine(text).joints[1].markers[1].position == (0.25, 0, 0)


def test_empty_sections_are_no_fault():
    assert parse_machine(
        "format: 1\nbodies: {a: {mass: 1, shape: {type: sphere, radius: 1}}}\njoints:\nsimulation:\nparameters:"
    )


def test_places_in_a_file():
    lines = BASE.splitlines()
    line, column = locate(BASE, "joints.hinge.axis")
    assert lines[line - 1][column - 1 :].startswith("[1, 0, 0]}")
    line, column = locate(BASE, "forces.push.vector.1")
    assert lines[line - 1][column - 1 :].startswith("10 + 3*sin")
    assert locate(BASE, "bodies.rod") == (BASE[: BASE.index("  rod:")].count("\n") + 1, 3)
    assert locate(BASE, "bodies.rod.no.such") == locate(BASE, "bodies.rod")
    assert locate(BASE, "") == (1, 1)


def test_every_value_has_a_place():
    tree = read_tree(BASE, "")
    assert tree.places.keys() >= {("bodies", "crank", "inertia", 2), ("joints", "pin", "markers", 1, "position", 0)}


def test_files(tmp_path: Path):
    file = tmp_path / "crank.yaml"
    file.write_text(BASE, encoding="utf-8")
    assert read_machine(file) == read_machine(str(file)) == MACHINE
    file.write_bytes(b"\xef\xbb\xbf" + BASE.replace("\n", "\r\n").encode())
    assert read_machine(file) == MACHINE


@pytest.mark.parametrize(
    ("content", "place", "part"),
    [
        (None, (0, 0), "there is no such file"),
        (b"", (1, 1), "the file is empty"),
        ("format: 1\nname: caf\xe9\n".encode("latin-1"), (2, 10), "not UTF-8 text: the byte 0xe9"),
    ],
)
def test_files_that_cannot_be_read(tmp_path, content, place, part):
    file = tmp_path / "crank.yaml"
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(ModelError) as caught:
        read_machine(file)
    (fault,) = caught.value.faults
    assert (fault.file, fault.line, fault.column) == (str(file), *place)
    assert part in fault.message


def test_directories_and_impossible_names(tmp_path):
    for path, part in (
        (tmp_path, "this is a directory"),
        ("a\0b", "cannot be read"),
        (tmp_path / ("a" * 300), "cannot be read"),
    ):
        with pytest.raises(ModelError, match=part):
            read_machine(path)
