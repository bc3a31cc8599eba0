"""The reference of the machine file and the README: every machine in them works, and nothing that can be written is missing."""

import re
from pathlib import Path
from typing import get_args

import pytest

from checking import check
from nivel import (
    AssemblySettings,
    Belt,
    Body,
    Driver,
    Event,
    FunctionCoupling,
    Gear,
    Joint,
    LinearCoupling,
    MachineRecord,
    Marker,
    Rack,
    Sensor,
    SimulationSettings,
)
from nivel.cli.failures import fault_line
from nivel.elements.beams import sections
from nivel.elements.beams.beam import Beam
from nivel.elements.beams.sections import GeneralSection
from nivel.elements.contacts.contact import Material
from nivel.elements.contacts.height_field import HeightField
from nivel.elements.forces import FORCES
from nivel.elements.joints import JOINTS
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.files.include import KEY as MASS_PROPERTIES
from nivel.files.joint_parts import DESCRIBED as PARTS_OF_JOINTS
from nivel.files.outline import FILE_WORDS, SETS, TOP_WORDS
from nivel.files.writer import write_machine
from nivel.integrate.catalogue import INTEGRATORS
from nivel.machine.bodies.inertia import Inertia
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Ellipsoid, Extrusion, Mesh, Sphere, Tube
from nivel.machine.core.orientation import SEQUENCES, Orientation
from nivel.machine.core.record import field_words
from nivel.machine.laws.python_law import KEYS as LAW_KEYS
from nivel.machine.laws.symbols import POINT_QUANTITIES, SENSOR_QUANTITIES, TURN_QUANTITIES
from nivel.machine.settings.run import Baumgarte
from nivel.machine.signals.input import Gamepad, Input, Keys
from nivel.machine.signals.sensor import COORDINATE_QUANTITIES, MARKER_QUANTITIES
from nivel.machine.units.functions import FUNCTIONS
from nivel.machine.units.quantity import read_quantity
from nivel.machine.units.tree import CONSTANTS, LOOKUP, ExpressionError, Number
from nivel.machine.units.unit import KINDS, UNITS
from nivel.system.elimination.topology import carries

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"
PAGES = [DOCS / "machine-files.md", *sorted((DOCS / "machine-files").glob("*.md"))]
PAGE = "\n".join(page.read_text(encoding="utf-8") for page in PAGES)
README = (ROOT / "README.md").read_text(encoding="utf-8")
START = "format: 1\n"
BEAM_SECTIONS = (
    sections.Circle,
    sections.Tube,
    sections.Rectangle,
    sections.Box,
    sections.IBeam,
    sections.Values,
    GeneralSection,
)


def blocks(text, language):
    """The fenced blocks of `language` in a page."""
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def section(title):
    """The text under a heading of the page, with its subsections."""
    bare = re.sub(r"^```.*?^```$", lambda block: re.sub("#", " ", block[0]), PAGE, flags=re.MULTILINE | re.DOTALL)
    found = re.search(rf"^(#+) {re.escape(title)}\n", bare, re.MULTILINE)
    following = re.compile(rf"^#{{1,{len(found[1])}}} ", re.MULTILINE).search(bare, found.end())
    return PAGE[found.end() : following.start() if following else None]


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


def force_table(force):
    """Rows under the heading of a force's table."""
    (text,) = re.findall(rf"^\| `type: {force.model_fields['type'].default}` .*\n((?:\|.*\n)+)", PAGE, re.MULTILINE)
    return rows(text)


MACHINES = [
    pytest.param(text, id=f"{name}-{number}")
    for name, page in (("machine-files", PAGE), ("readme", README))
    for number, text in enumerate(blocks(page, "yaml"))
    if text.startswith(START)
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the files of the page: those that begin with their name."""
    folder = tmp_path_factory.mktemp("page")
    for text in (*blocks(PAGE, "yaml"), *blocks(PAGE, "python")):
        name = re.match(rf"(?:{START})?# (\S+\.(?:yaml|py))\n", text)
        if name:
            (folder / name[1]).write_text(text, encoding="utf-8")
    return folder


@pytest.mark.parametrize("text", MACHINES)
def test_machine_works(text, folder):
    machine = parse_machine(text, str(folder / "machine.yaml"), allow_code=True)
    facts = check(machine)
    assert facts.degrees_of_freedom > 0
    assert not facts.redundant_rows
    assert not facts.moved or machine.drivers or any(joint.start for joint in machine.joints)
    assert parse_machine(write_machine(machine), str(folder / "machine.yaml"), allow_code=True) == machine


def test_every_snippet_of_the_reference_is_a_whole_machine():
    snippets = blocks(PAGE, "yaml")
    assert len(snippets) >= 8
    assert all(text.startswith(START) for text in snippets)
    assert any(text.startswith(START) for text in blocks(README, "yaml"))


@pytest.mark.parametrize(
    ("title", "record"),
    [
        ("Bodies", Body),
        ("Beams", Beam),
        ("Markers", Marker),
        ("Joints", Joint),
        ("Drivers", Driver),
        ("Sensors", Sensor),
        ("Inputs", Input),
        ("Events", Event),
        ("Assembly", AssemblySettings),
        ("Simulation", SimulationSettings),
    ],
    ids=lambda value: value if isinstance(value, str) else value.__name__,
)
def test_every_key_has_its_row(title, record):
    """`name` is the key of the element."""
    assert not set(field_words(record)) - first_column(title) - {"name"}


@pytest.mark.parametrize("force", FORCES.records, ids=lambda force: force.__name__)
def test_every_key_of_a_force_has_its_row_with_its_default(force):
    """The type stands in the heading of the table."""
    cells = {word: row for row in force_table(force) for word in code(row[0])}
    assert set(cells) == set(field_words(force)) - {"name", "type"}
    for key, field in force.model_fields.items():
        if isinstance(field.default, float):
            assert float(cells[key][2]) == field.default
        elif field.is_required() and key not in ("name", "type"):
            assert cells[key][2].startswith("must be given")
    titles = (
        "Forces",
        "Motors, servos and electric drives",
        "Drive trains",
        "Stops, friction and contact",
        "Tyres",
        "Soil",
        "Tracks",
    )
    assert set(force.outputs) <= {word for title in titles for word in words(section(title))}


@pytest.mark.parametrize(
    ("title", "record"),
    [
        ("Inertia", Inertia),
        ("Orientation", Orientation),
        ("Shapes", Box),
        ("Shapes", Cylinder),
        ("Shapes", Tube),
        ("Shapes", Sphere),
        ("Shapes", Capsule),
        ("Shapes", Extrusion),
        ("Shapes", Mesh),
        ("Shapes", Ellipsoid),
        ("Contact", Material),
        ("Ground with heights", HeightField),
        *(("Sections of beams", record) for record in BEAM_SECTIONS),
        ("Beams", sections.Material),
        ("Inputs", Keys),
        ("Inputs", Gamepad),
        ("Simulation", Baumgarte),
    ],
    ids=lambda value: value if isinstance(value, str) else value.__name__,
)
def test_every_key_of_a_part_is_mentioned(title, record):
    assert not set(field_words(record)) - words(section(title))


def test_every_section_is_described():
    assert {*TOP_WORDS, *FILE_WORDS} == first_column("Shape of a file")
    assert MASS_PROPERTIES in first_column("Bodies")
    assert {*PARTS_OF_JOINTS} <= first_column("Joints")
    assert {*FILE_WORDS, MASS_PROPERTIES, "python"} == first_column("Several files")
    assert {"format", "parameters", "functions", *SETS, *field_words(MachineRecord)} == set(TOP_WORDS)


def test_every_type_is_described():
    assert set(JOINTS) <= first_column("Joints")
    for record in (Box, Cylinder, Capsule, Tube, Sphere, Extrusion, Mesh):
        assert record.model_fields["type"].default in first_column("Shapes")
    for coupling in (Gear, Belt, Rack, LinearCoupling, FunctionCoupling):
        (row,) = [
            cells for cells in rows(section("Couplings")) if cells[0] == f"`{coupling.model_fields['type'].default}`"
        ]
        keys = set(field_words(coupling)) - {"name", "type"}
        assert keys <= words(row[1])


def test_everything_that_can_be_measured_is_described():
    measured = rows(section("Sensors"))
    for form, quantities in (("marker", MARKER_QUANTITIES), ("coordinate", COORDINATE_QUANTITIES)):
        assert [f"`{form}`", ", ".join(f"`{word}`" for word in quantities)] in [row[:2] for row in measured]
    symbols = words(section("Symbols"))
    assert {
        *POINT_QUANTITIES,
        *TURN_QUANTITIES,
        *(word for its in SENSOR_QUANTITIES.values() for word in its),
    } <= symbols


def test_keys_of_python_functions_are_described():
    assert {"python", *LAW_KEYS} == first_column("Python functions")


@pytest.mark.parametrize("kind", JOINTS)
def test_joint_table_is_that_of_the_program(kind):
    (row,) = [cells for cells in rows(section("Joints")) if cells[0] == f"`{kind}`" and len(cells) == 5]
    _, _, free, constraints, coordinates = row
    assert int(free) == JOINTS[kind].composition.free
    assert tuple(code(constraints)) == JOINTS[kind].composition.rows
    assert code(coordinates) == [coordinate.name for coordinate in JOINTS[kind].composition.coordinates]


def test_every_kind_of_row_is_described():
    described = first_column("Joints")
    kinds = {re.sub(r"[xyz]+$", "", row) for kind in JOINTS.values() for row in kind.composition.rows if "." in row}
    assert kinds <= {re.sub(r"[xyz]+$", "", word) for word in described}
    assert {row for kind in JOINTS.values() for row in kind.composition.rows if "." not in row} <= described


def test_every_joint_coordinate_has_its_zero_and_direction():
    described = {row[0] for row in rows(section("Joint coordinates"))}
    assert {
        f"`{each.name}` [{each.units}]" for kind in JOINTS.values() for each in kind.composition.coordinates
    } <= described


@pytest.mark.parametrize("key", SimulationSettings.model_fields)
def test_simulation_table_has_defaults_and_allowed_words(key):
    row = next(cells for cells in rows(section("Simulation")) if cells[0] == f"`{key}`")
    field = SimulationSettings.model_fields[key]
    if isinstance(field.default, float):
        assert float(row[2]) == field.default
    elif isinstance(field.default, str):
        its = field.json_schema_extra
        assert code(row[2]) == [field.default] or row[2] == its.absent
        # long lists of words stand in a table of their own
        allowed = code(row[3]) or sorted(first_column("Simulation"))
        assert set(get_args(field.annotation)) <= set(allowed)
        assert row[3] == "see below" or allowed == list(get_args(field.annotation))


def test_all_units_functions_and_sequences_are_mentioned():
    assert not {*UNITS, *FUNCTIONS, *CONSTANTS} - words(section("Numbers"))
    assert not set(SEQUENCES) - words(section("Orientation"))


def test_the_table_of_functions_is_that_of_the_package():
    described = [row for row in rows(section("Functions")) if len(row) == 2][2:]
    calls = [f"`{name}({', '.join([*kind.names, *['…'] * kind.more])})`" for name, kind in FUNCTIONS.items()]
    meanings = [kind.meaning for kind in FUNCTIONS.values()]
    assert described[: len(calls)] == [list(row) for row in zip(calls, meanings, strict=True)]
    assert {*FUNCTIONS, LOOKUP} <= words(section("Numbers").partition("## ")[0])


REFUSED = [row for row in rows(section("What is refused")) if row[0] in KINDS]


@pytest.mark.parametrize(("kind", "refused", "_why", "instead"), REFUSED, ids=[row[1] for row in REFUSED])
def test_what_is_refused_is_refused_and_what_to_write_instead_is_taken(kind, refused, _why, instead):
    parameters = {"length": Number(0.6, KINDS["length"][2])}
    (text,) = code(refused)
    with pytest.raises(ExpressionError):
        read_quantity(text, kind, parameters)
    for each in code(instead):
        read_quantity(each, kind, parameters)


NAMED_AS_UNITS = rows(section("Parameters"))[1:]
SHARED = {
    "m": Number(3.0, KINDS["mass"][2]),
    "g": Number(9.81, KINDS["acceleration"][2]),
    "h": Number(0.5, KINDS["length"][2]),
    "e": Number(0.3),
}
# what the texts of the table are, by their kinds, and their values
MEANT = {
    "2 m": ("length", 2.0),
    "5 g": ("mass", 0.005),
    "(1/2) h": ("time", 1800.0),
    "10 N/m": ("stiffness", 10.0),
    "9.81 m/s^2": ("acceleration", 9.81),
    "2 kg/(m*s)": ((), 2.0),
    "10 N*m": ("torque", 10.0),
    "1 kg*m^2": ("inertia", 1.0),
    "2*m": ("mass", 6.0),
    "m*g": ("force", 29.43),
    "h/2": ("length", 0.25),
    "(12 N)/m": ("acceleration", 4.0),
    "9.81 m/s^2*m": ("force", 29.43),
    "2*e": ("number", 0.6),
}


def test_names_that_are_also_units_are_what_the_table_says():
    shown = [text for row in NAMED_AS_UNITS for text in code(row[0]) if row[1] != "refused"]
    assert shown == list(MEANT)
    for text, (kind, value) in MEANT.items():
        assert read_quantity(text, kind, SHARED) == pytest.approx(value)
    ((refused, _, ways),) = [row for row in NAMED_AS_UNITS if row[1] == "refused"]
    with pytest.raises(ExpressionError, match="may be the unit or the parameter"):
        read_quantity(*code(refused), (), SHARED)
    unit, parameter = code(ways)
    assert (read_quantity(unit, (), SHARED), read_quantity(parameter, (), SHARED)) == (13.0, 33.0)


def test_a_factor_without_a_unit_is_answered_as_shown():
    (shown,) = blocks(section("Factors without a unit"), "text")
    text = "format: 1\nparameters: {gap: 30 cm}\nbodies: {rod: {mass: 1, inertia: [1, 1, 1]}}\nforces:\n"
    force = "  f: {type: force, body: rod, vector: [%s, 0, 0]}\n"
    assert parse_machine(text + force % "2e5*(0.3 - rod.z)", "m.yaml")
    with pytest.raises(ModelError) as caught:
        parse_machine(text + force % "2e5*(gap - rod.z)", "m.yaml")
    assert [fault.message for fault in caught.value.faults] == [shown.strip()]
    assert parse_machine(text + force % code(shown)[-1], "m.yaml")


def test_faults_are_shown_as_they_are():
    text, shown = blocks(section("Faults"), "text")
    with pytest.raises(ModelError) as caught:
        parse_machine(text, "bad.yaml")
    assert [fault_line(fault).plain for fault in caught.value.faults] == shown.splitlines()


def test_lines_are_short():
    """Addresses of links are not counted."""
    assert not [line for line in PAGE.splitlines() if len(re.sub(r"\]\([^)]*\)", "]", line)) > 130]


METHODS = (ROOT / "docs" / "methods.md").read_text(encoding="utf-8")
STEPS = {"fixed": (False, False), "chosen": (True, False), "fixed or chosen": (False, True)}
IN_SETTINGS = {"fixed": "fixed", "variable": "chosen", "fixed; variable with `step_control: error`": "fixed or chosen"}


def integrators_of(text):
    """(word, other cells) of the rows of a table that name integrators; "`ab1` … `ab5`" are all between."""
    for cells in rows(text):
        for part in cells[0].split(", "):
            found = code(part)
            if "…" in part:
                stem = found[0][:-1]
                found = [f"{stem}{k}" for k in range(int(found[0][-1]), int(found[1][-1]) + 1)]
            yield from ((word, cells) for word in found if word in INTEGRATORS)


def test_the_table_of_integrators_has_their_orders_and_steps():
    listed = list(integrators_of(METHODS[METHODS.index("\n## Integrators") : METHODS.index("\n## Limits")]))
    assert sorted(word for word, _ in listed) == sorted(INTEGRATORS)
    for word, (names, steps, order, _) in listed:
        facts = INTEGRATORS[word]
        assert STEPS[steps] == (facts.chooses_steps, facts.optional_control), word
        if "…" in order:
            assert order == "1 … 4" if word.startswith("gear") else "1 … 5"
            assert facts.order == int(word[-1])
        elif order != "variable":
            orders = order.split(", ")
            own = orders[code(names).index(word)] if len(orders) > 1 else orders[0]
            assert facts.order == int(own), word
        else:
            assert facts.chooses_steps


def test_the_table_of_settings_has_every_integrator_with_its_steps():
    text = section("Integrators")
    listed = [(word, cells) for word, cells in integrators_of(text) if cells[1] in IN_SETTINGS]
    assert sorted(word for word, _ in listed) == sorted(INTEGRATORS)
    for word, cells in listed:
        facts = INTEGRATORS[word]
        assert STEPS[IN_SETTINGS[cells[1]]] == (facts.chooses_steps, facts.optional_control), word


def test_joints_that_can_be_part_of_the_tree_are_named():
    (said,) = re.findall(r"These joints can be part of the tree: ([^.]*)\.", METHODS)
    assert sorted(said.replace("\n", " ").split(", ")) == [kind for kind in JOINTS if carries(kind)]
