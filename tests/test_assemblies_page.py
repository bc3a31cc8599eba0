"""The page about machines of several files: what it shows works."""

import re
from pathlib import Path

import pytest

from checking import check
from nivel.errors import ModelError
from nivel.files import read_machine
from nivel.files.assembly import Assembly
from nivel.files.outline import WHOLE

PAGE = (Path(__file__).parent.parent / "docs" / "assemblies.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
NAMED = {text.splitlines()[0].removeprefix("# "): text for kind, text in BLOCKS if kind in ("yaml", "python")}
MACHINES = [name for name in NAMED if name.endswith(".yaml") and name != "steel.yaml"]


@pytest.fixture
def folder(tmp_path):
    """All files of the page."""
    for name, text in NAMED.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "wheel-mass.json").write_text(next(text for kind, text in BLOCKS if kind == "json"), encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("name", MACHINES)
def test_machine_works(folder, name):
    facts = check(read_machine(folder / name, allow_code=True))
    assert facts.degrees_of_freedom > 0
    assert not facts.moved


def test_every_yaml_block_is_a_file():
    assert len([kind for kind, _ in BLOCKS if kind == "yaml"]) == len(MACHINES) + 1
    assert all(re.fullmatch(r"[\w-]+\.(yaml|py)", name) for name in NAMED)


def test_parameters_alone_are_no_machine(folder):
    with pytest.raises(ModelError, match="at least one body"):
        read_machine(folder / "steel.yaml")


def test_python_needs_permission(folder):
    with pytest.raises(ModelError, match="--allow-code"):
        read_machine(folder / "braked.yaml")


def test_every_key_of_an_assembly_has_its_row():
    rows = re.findall(r"^\| `(\w+)` \|", PAGE, re.MULTILINE)
    assert set(Assembly.model_fields) <= set(rows)
    assert all(f"`{word}`" in PAGE for word in WHOLE)


def test_values_from_the_command_line(folder):
    values = re.findall(r'--set (\S+?)=("[^"]*"|\S+)', PAGE)
    assert len(values) >= 4
    overrides = {path: value.strip('"') for path, value in values}
    machine = read_machine(folder / "walker.yaml", overrides=overrides)
    bodies = {body.name: body for body in machine.bodies}
    assert bodies["left_thigh"].density == 1000
    assert bodies["right_thigh"].density == 2700


def test_lines_are_short():
    assert not [line for line in PAGE.splitlines() if len(line) > 135]
