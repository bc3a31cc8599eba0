"""The reference of the machine file and the README: every machine in them works, and nothing that can be written is missing."""

import re
from pathlib import Path
from typing import get_args

import pytest

from nivel.analysis.check import check
from nivel.cli.failures import fault_line
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.files.overrides import TOP_WORDS
from nivel.machine import Body, Joint, JointType, MachineRecord, Marker, PointForce, SimulationSettings, Torque
from nivel.machine.arithmetic import CONSTANTS, FUNCTIONS, ExpressionError, Number
from nivel.machine.dimension import KINDS
from nivel.machine.inertia import Inertia
from nivel.machine.orientation import SEQUENCES, Orientation
from nivel.machine.quantity import read_quantity
from nivel.machine.record import field_words
from nivel.machine.settings import Baumgarte
from nivel.machine.shape import Box, Cylinder, Sphere, Tube
from nivel.machine.unit import UNITS
from nivel.system.joints import JOINTS

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "machine-files.md").read_text(encoding="utf-8")
README = (ROOT / "README.md").read_text(encoding="utf-8")
START = "format: 1\n"


def blocks(text, language):
    """The fenced blocks of `language` in a page."""
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def section(title):
    """The text under a heading of the page, with its subsections."""
    level, rest = re.search(rf"^(#+) {re.escape(title)}\n(.*)", PAGE, re.MULTILINE | re.DOTALL).groups()
    return re.split(rf"^#{{1,{len(level)}}} ", rest, maxsplit=1, flags=re.MULTILINE)[0]


def rows(text):
    """Cells of all table rows in `text`."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line[:1] == "|"]


def code(text):
    """What stands between backticks, blocks left out."""
    return re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL))


def first_column(title):
    """The words between backticks in the first cells of a section's tables."""
    return {word for row in rows(section(title)) for word in code(row[0])}


def words(text):
    """All words of the code in `text`."""
    return {word for each in code(text) for word in re.findall(r"[\w-]+|°", each)}


MACHINES = [
    pytest.param(text, id=f"{name}-{number}")
    for name, page in (("machine-files", PAGE), ("readme", README))
    for number, text in enumerate(blocks(page, "yaml"))
    if text.startswith(START)
]


@pytest.mark.parametrize("text", MACHINES)
def test_machine_works(text):
    facts = check(parse_machine(text))
    assert facts.degrees_of_freedom > 0
    assert not facts.moved
    assert not facts.redundant_rows


def test_every_snippet_of_the_reference_is_a_whole_machine():
    snippets = blocks(PAGE, "yaml")
    assert len(snippets) >= 8
    assert all(text.startswith(START) for text in snippets)
    assert any(text.startswith(START) for text in blocks(README, "yaml"))


@pytest.mark.parametrize(
    ("title", "record"),
    [
        ("Bodies", Body),
        ("Markers", Marker),
        ("Joints", Joint),
        ("Forces", PointForce),
        ("Forces", Torque),
        ("Simulation", SimulationSettings),
    ],
    ids=lambda value: value if isinstance(value, str) else value.__name__,
)
def test_every_key_has_its_row(title, record):
    """`name` is the key of the element, and the type of a force stands in the heading of its table."""
    missing = set(field_words(record)) - first_column(title) - {"name"} - ({"type"} if title == "Forces" else set())
    assert not missing


@pytest.mark.parametrize(
    ("title", "record"),
    [
        ("Inertia", Inertia),
        ("Orientation", Orientation),
        ("Shapes", Box),
        ("Shapes", Cylinder),
        ("Shapes", Tube),
        ("Shapes", Sphere),
        ("Simulation", Baumgarte),
    ],
    ids=lambda value: value if isinstance(value, str) else value.__name__,
)
def test_every_key_of_a_part_is_mentioned(title, record):
    assert not set(field_words(record)) - words(section(title))


def test_every_section_is_described():
    assert set(TOP_WORDS) == first_column("Shape of a file")
    assert {"format", "parameters", *field_words(MachineRecord)} == set(TOP_WORDS)


def test_every_type_is_described():
    assert set(get_args(JointType)) == set(JOINTS) <= first_column("Joints")
    for record in (Box, Cylinder, Tube, Sphere):
        assert record.model_fields["type"].default in first_column("Shapes")
    for record in (PointForce, Torque):
        assert f"type: {record.model_fields['type'].default}" in first_column("Forces")


@pytest.mark.parametrize("kind", JOINTS)
def test_joint_table_is_that_of_the_program(kind):
    (row,) = [cells for cells in rows(section("Joints")) if cells[0] == f"`{kind}`"]
    _, _, free, constraints, coordinates = row
    assert int(free) == JOINTS[kind].free
    assert tuple(code(constraints)) == JOINTS[kind].rows
    assert code(coordinates) == [coordinate.name for coordinate in JOINTS[kind].coordinates]


def test_every_joint_coordinate_has_its_zero_and_direction():
    described = {row[0] for row in rows(section("First and second"))}
    assert {f"`{each.name}` [{each.units}]" for kind in JOINTS.values() for each in kind.coordinates} <= described


@pytest.mark.parametrize("key", SimulationSettings.model_fields)
def test_simulation_table_has_defaults_and_allowed_words(key):
    row = next(cells for cells in rows(section("Simulation")) if cells[0] == f"`{key}`")
    field = SimulationSettings.model_fields[key]
    if isinstance(field.default, float):
        assert float(row[2]) == field.default
    elif field.default is not None:
        assert code(row[2]) == [field.default]
        assert code(row[3]) == list(get_args(field.annotation))


def test_all_units_functions_and_sequences_are_mentioned():
    assert not {*UNITS, *FUNCTIONS, *CONSTANTS} - words(section("Numbers"))
    assert not set(SEQUENCES) - words(section("Orientation"))


REFUSED = [row for row in rows(section("What is refused")) if row[0] in KINDS]


@pytest.mark.parametrize(("kind", "refused", "_why", "instead"), REFUSED, ids=[row[1] for row in REFUSED])
def test_what_is_refused_is_refused_and_what_to_write_instead_is_taken(kind, refused, _why, instead):
    parameters = {"length": Number(0.6, KINDS["length"][2])}
    (text,) = code(refused)
    with pytest.raises(ExpressionError):
        read_quantity(text, kind, parameters)
    for each in code(instead):
        read_quantity(each, kind, parameters)


def test_faults_are_shown_as_they_are():
    text, shown = blocks(section("Faults"), "text")
    with pytest.raises(ModelError) as caught:
        parse_machine(text, "bad.yaml")
    assert [fault_line(fault).plain for fault in caught.value.faults] == shown.splitlines()


def test_lines_are_short():
    assert not [line for line in PAGE.splitlines() if len(line) > 130]
