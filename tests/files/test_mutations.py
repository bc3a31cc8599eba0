"""However a file is spoilt, what comes out is a machine or a ModelError; and no value is passed over in silence."""

import json
from copy import deepcopy
from pathlib import Path

import pytest
from base_machine import BASE, FULL, LEG, write_files
from hypothesis import given, settings
from hypothesis import strategies as st

from lanes import FULL as ALL_EXAMPLES
from lanes import parts
from nivel import MachineRecord
from nivel.errors import ModelError
from nivel.files import parse_machine, read_machine
from nivel.files.outline import NAMED
from nivel.files.tree import read_tree

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
TREE = read_tree(FULL, "")
PATHS = [".".join(map(str, path)) for path in TREE.places if path]
PARTS = 12  # of all keys and values: one of them by default
FREE = ("name", "sensors.sum.units")  # texts in which anything may stand


def examples(count):
    """So many examples, or of the default tests a tenth."""
    return settings(max_examples=count if ALL_EXAMPLES else count // 10)


@pytest.fixture(scope="module")
def full(tmp_path_factory):
    """Reads the full machine with other text, or with values from outside; its files stand in a folder."""
    file = str(write_files(tmp_path_factory.mktemp("full")))

    def read(text=FULL, **options):
        return parse_machine(text, file, allow_code=True, **options)

    return read


def machine_or_faults(text, read=parse_machine, **options):
    try:
        machine = read(text, **options)
    except ModelError as error:
        faults = error.faults
    else:
        assert isinstance(machine, MachineRecord)
        return
    assert faults
    assert all(fault.message for fault in faults)
    if isinstance(text, str):
        lines = max(sum(each.count(end) for end in ("\n", "\r", "\x85", "\u2028")) for each in (text, LEG)) + 2
        assert all(fault.line <= lines for fault in faults)


def edits(text):
    """A few scraps to be pasted over `text`: (place, how many characters go, scrap)."""
    place = st.tuples(st.integers(0, len(text)), st.integers(0, 12), st.sampled_from(SCRAPS))
    return st.lists(place, min_size=1, max_size=4)


def pasted(text, edits):
    for at, length, scrap in edits:
        text = text[:at] + scrap + text[at + length :]
    return text


@examples(200)
@given(edits(BASE))
def test_scraps_pasted_over_a_file(edits):
    machine_or_faults(pasted(BASE, edits))


@examples(300)
@given(edits(FULL))
def test_scraps_pasted_over_the_full_machine(full, edits):
    machine_or_faults(pasted(FULL, edits), full)


@examples(150)
@given(edits(LEG))
def test_scraps_pasted_over_a_part(tmp_path_factory, edits):
    file = write_files(tmp_path_factory.mktemp("part"), leg=pasted(LEG, edits))
    machine_or_faults(file, lambda path: read_machine(path, allow_code=True))


@examples(200)
@given(st.lists(st.tuples(st.integers(0, FULL.count("\n")), st.integers(0, FULL.count("\n"))), min_size=1, max_size=5))
def test_lines_moved_about(full, moves):
    lines = FULL.splitlines()
    for origin, target in moves:
        lines.insert(target % len(lines), lines.pop(origin % len(lines)))
    machine_or_faults("\n".join(lines), full)


@examples(500)
@given(st.dictionaries(st.sampled_from(PATHS), VALUES, min_size=1, max_size=3))
def test_anything_in_the_place_of_a_value(full, overrides):
    machine_or_faults(FULL, full, overrides=overrides)


@examples(300)
@given(st.text(max_size=40))
def test_any_text(text):
    machine_or_faults(text)
    machine_or_faults(BASE, overrides={"bodies.crank.mass": text, text: "1"})


@examples(200)
@given(st.text(alphabet="0123456789.eE+-*/^() ,pimsincosradkgN", max_size=25))
def test_any_expression(full, text):
    machine_or_faults(
        FULL, full, overrides={"forces.drag.vector.1": text + "*rail.displacement", "bodies.shaft.mass": text}
    )


@examples(50)
@given(st.binary(max_size=60))
def test_any_bytes(tmp_path_factory, content):
    file: Path = tmp_path_factory.mktemp("bytes") / "machine.yaml"
    file.write_bytes(content)
    with pytest.raises(ModelError):
        read_machine(file)


def leaves(value, path=()):
    """Every path to a single value."""
    if isinstance(value, dict | list):
        for step, entry in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(entry, (*path, step))
    else:
        yield path, value


def spoilt(path, change):
    """The data of the full machine, in which `change` has been made to what contains the last step of `path`."""
    data = deepcopy(TREE.data)
    container = data
    for step in path[:-1]:
        container = container[step]
    change(container, path[-1])
    return json.dumps(data)


def refused(full, text, **options):
    try:
        full(text, **options)
    except ModelError:
        return True
    return False


LEAVES = [(".".join(map(str, path)), path, value) for path, value in leaves(TREE.data)]
LEAVES_OF_PART = [
    (".".join([path[0], f"left_{path[1]}", *map(str, path[2:])]), path, value)
    for path, value in leaves(read_tree(LEG, "").data)
    if path[0] in NAMED[:-2]
]
VARIED = [*LEAVES, *LEAVES_OF_PART]


@parts(PARTS)
def test_no_misspelt_key_is_passed_over(full, part):
    def misspell(container, key):
        container[f"{key}x"] = container.pop(key)

    keys = [path for path in TREE.keys if not (len(path) == 2 and path[0] in NAMED)]
    assert len(keys) > 200
    assert not [path for path in keys[part::PARTS] if not refused(full, spoilt(path, misspell))]


ANY_QUANTITY = (
    "forces.brake.effort.arguments.0",
    "forces.brake.effort.arguments.1",
    "forces.brake.effort.arguments.2",
    "sensors.sum.value",
)


@parts(PARTS)
@pytest.mark.parametrize(("value", "right"), [("3 kg^5", (*FREE, *ANY_QUANTITY)), ({"zzz": 1}, ())])
def test_no_impossible_value_is_passed_over(full, value, right, part):
    names = [name for name, _, _ in VARIED][part::PARTS]
    taken = [name for name in names if not refused(full, FULL, overrides={name: value})]
    assert sorted(taken) == sorted(set(right) & set(names))


def changed(value):
    """Another value of the same kind."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value + 1  # which leaves [0, 0, 1] the same direction
    return f"{value}x" if isinstance(value, str) else 1


@parts(PARTS)
def test_no_value_is_without_effect(full, part):
    machine = full()
    assert len(VARIED) > 300
    idle = []
    for name, _, value in VARIED[part::PARTS]:
        try:
            if full(overrides={name: changed(value)}) == machine:
                idle.append(name)
        except ModelError:
            pass
    same_direction = {"assemblies.right.orientation.axis.2"}
    assert set(idle) == same_direction & {name for name, _, _ in VARIED[part::PARTS]}
