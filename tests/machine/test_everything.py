"""A machine with one of each: it comes back from JSON, pickle and files, and nothing in it can be spoilt into a crash."""

import pickle
from copy import deepcopy

import pytest
from everything import EVERYTHING

from lanes import parts
from nivel import MachineRecord
from nivel.elements.circuits import COMPONENTS
from nivel.elements.control import BLOCKS
from nivel.elements.control.units import CBlock, FmuBlock
from nivel.elements.forces import FORCES
from nivel.elements.joints import JOINTS
from nivel.errors import ModelError
from nivel.files import parse_machine, write_machine
from nivel.machine.core.index import SECTIONS

MACHINE = MachineRecord(**EVERYTHING)
PARTS, PARTS_MISSING = 96, 48
GARBAGE = (
    None,
    True,
    0,
    -1,
    float("nan"),
    10**400,
    "",
    "x",
    "tip",
    "1 furlong",
    "hinge.angle",
    [],
    [1],
    {},
    {"a": [1]},
    [[[]]],
)


def test_every_kind_is_in_it():
    assert {type(force) for force in MACHINE.forces} == set(FORCES.records)
    # FMUs and C functions need a file, and have tests of their own
    assert {type(block) for block in MACHINE.control} == set(BLOCKS.records) - {FmuBlock, CBlock}
    assert {type(component) for component in MACHINE.hydraulics} == {
        each for each in COMPONENTS.records if each.liquids
    }
    assert {coupling.type for coupling in MACHINE.couplings} == {"gear", "belt", "rack", "linear", "function"}
    assert all(getattr(MACHINE, section) for section in SECTIONS)
    assert {joint.type for joint in MACHINE.joints} <= set(JOINTS)


def test_it_comes_back_from_json_and_pickle():
    assert MachineRecord.model_validate_json(MACHINE.model_dump_json()) == MACHINE
    assert MachineRecord.model_validate_json(MACHINE.model_dump_json(exclude_none=True, by_alias=True)) == MACHINE
    assert pickle.loads(pickle.dumps(MACHINE)) == MACHINE
    assert MACHINE.replace(name="other").replace(name="everything") == MACHINE


def test_it_comes_back_from_a_file():
    text = write_machine(MACHINE)
    assert parse_machine(text, allow_code=True) == MACHINE
    assert write_machine(parse_machine(text, allow_code=True)) == text


def test_python_stands_in_a_file_as_people_write_it():
    text = write_machine(MACHINE)
    assert "      source: |\n        def turn(t):\n            return t, 1.0, 0.0\n" in text
    assert "gear: {type: gear, joints: [hinge, turn.angle], teeth: [20, 40], internal: true}" in text
    assert "slide: {type: translational, markers: [base, eye], start: {displacement: 0.01}}" in text


def places(data, path=()):
    """Paths of everything in `data`."""
    yield path
    pairs = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in pairs:
        yield from places(value, (*path, key))


def spoilt(path, garbage):
    data = deepcopy(EVERYTHING)
    container = data
    for step in path[:-1]:
        container = container[step]
    container[path[-1]] = garbage
    return data


@parts(PARTS)
@pytest.mark.parametrize("section", [key for key in EVERYTHING if key != "name"])
def test_garbage_anywhere_gives_a_machine_or_faults(section, part):
    for at, path in list(enumerate(places(EVERYTHING[section], (section,))))[part::PARTS]:
        for garbage in GARBAGE[at % 7 :: 7]:
            try:
                MachineRecord(**spoilt(path, garbage))
            except ModelError as error:
                assert error.faults, (path, garbage)  # noqa: PT017


@parts(PARTS_MISSING)
@pytest.mark.parametrize("section", SECTIONS)
def test_what_is_missing_gives_a_machine_or_faults(section, part):
    for path in list(places(EVERYTHING[section], (section,)))[part::PARTS_MISSING]:
        data = deepcopy(EVERYTHING)
        container = data
        for step in path[:-1]:
            container = container[step]
        if isinstance(container, dict):
            del container[path[-1]]
            try:
                MachineRecord(**data)
            except ModelError as error:
                assert error.faults, path  # noqa: PT017
