"""However a file is spoilt, what comes out is a machine or a ModelError."""

from pathlib import Path

import pytest
from base_machine import BASE
from hypothesis import given, settings
from hypothesis import strategies as st

from nivel.errors import ModelError
from nivel.files import parse_machine, read_machine
from nivel.machine import MachineRecord

SCRAPS = [
    *"[]{}:,#&*!|>'\"%@`-?~\t\n\\ ",
    *[
        "\n  ",
        "null",
        "true",
        "1e999",
        "-1",
        "0",
        ".nan",
        "1/0",
        "[]",
        "{}",
        "&a",
        "*a",
        "<<",
        "!!int",
        "---",
        "...",
        "time",
    ],
    *["pi", "10 furlong", "deg", "ground", "crank", "name", "type", "ä", "\x85", "\u2028", "\ufeff", "€", "9" * 400],
]
VALUES = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.text(max_size=6),
        st.sampled_from(["crank", "ground", "tip", "10 cm", "2*time", "revolute", "box", "zxz", "1/0"]),
    ),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.sampled_from(["type", "body", "times", "name", "from"]), inner, max_size=3)
    ),
    max_leaves=6,
)
PATHS = [
    "bodies",
    "bodies.crank",
    "bodies.crank.inertia",
    "bodies.crank.inertia.1",
    "bodies.crank.orientation",
    "bodies.crank.orientation.euler.0",
    "bodies.crank.name",
    "bodies.rod.shape",
    "bodies.rod.shape.from",
    "bodies.rod.density",
    "markers.tip",
    "markers.hub.axis",
    "joints",
    "joints.hinge",
    "joints.hinge.bodies",
    "joints.pin.markers",
    "joints.pin.markers.1",
    "joints.pin.markers.0",
    "joints.knee.axes",
    "forces.drive",
    "forces.drive.vector",
    "forces.push.vector.2",
    "forces.push.vector.2.times",
    "forces.push.type",
    "parameters",
    "parameters.radius",
    "gravity",
    "simulation",
    "simulation.step",
    "format",
    "name",
    "description",
]


def machine_or_faults(text, **options):
    try:
        machine = parse_machine(text, **options)
    except ModelError as error:
        faults = error.faults
    else:
        assert isinstance(machine, MachineRecord)
        return
    assert faults
    lines = sum(text.count(end) for end in ("\n", "\r", "\x85", "\u2028")) + 2
    assert all(fault.message and fault.line <= lines for fault in faults)


@settings(max_examples=500)
@given(
    st.lists(st.tuples(st.integers(0, len(BASE)), st.integers(0, 12), st.sampled_from(SCRAPS)), min_size=1, max_size=4)
)
def test_scraps_pasted_over_a_file(edits):
    text = BASE
    for at, length, scrap in edits:
        text = text[:at] + scrap + text[at + length :]
    machine_or_faults(text)


@settings(max_examples=300)
@given(st.lists(st.tuples(st.integers(0, BASE.count("\n")), st.integers(0, BASE.count("\n"))), min_size=1, max_size=5))
def test_lines_moved_about(moves):
    lines = BASE.splitlines()
    for origin, target in moves:
        lines.insert(target % len(lines), lines.pop(origin % len(lines)))
    machine_or_faults("\n".join(lines))


@settings(max_examples=600)
@given(st.dictionaries(st.sampled_from(PATHS), VALUES, min_size=1, max_size=3))
def test_anything_in_the_place_of_a_value(overrides):
    machine_or_faults(BASE, overrides=overrides)


@settings(max_examples=300)
@given(st.text(max_size=40))
def test_any_text(text):
    machine_or_faults(text)
    machine_or_faults(BASE, overrides={"bodies.crank.mass": text, text: "1"})


@settings(max_examples=300)
@given(st.text(alphabet="0123456789.eE+-*/^() ,pimsincosradkgN", max_size=25))
def test_any_expression(text):
    machine_or_faults(BASE, overrides={"forces.push.vector.1": text + "*time", "bodies.crank.mass": text})


@settings(max_examples=50)
@given(st.binary(max_size=60))
def test_any_bytes(tmp_path_factory, content):
    file: Path = tmp_path_factory.mktemp("bytes") / "machine.yaml"
    file.write_bytes(content)
    with pytest.raises(ModelError):
        read_machine(file)
