"""What a strict type checker says of users' scripts: it accepts what the program accepts, and reads numbers as numbers."""

import importlib
import json
import pkgutil
import re
import subprocess
import sys
from functools import cache
from pathlib import Path
from types import NoneType
from typing import Annotated, get_args, get_origin

import pytest

import nivel
import nivel.elements
import nivel.machine
from nivel.machine.core.record import Record
from nivel.machine.units.quantity import Quantity
from patience import PATIENCE

SCRIPTS = Path(__file__).parent / "typed"


def kinds_of_records():
    """All classes of records that one meets in a machine."""
    for room in (nivel.machine, nivel.elements):
        for module in pkgutil.walk_packages(room.__path__, f"{room.__name__}."):
            importlib.import_module(module.name)

    def below(record):
        yield from (each for one in record.__subclasses__() for each in (one, *below(one)))

    found = [each for each in below(Record) if each.__module__.startswith(("nivel.machine.", "nivel.elements."))]
    # not those that are made while a file is read, in which some fields are missing
    made = {each for each in found if getattr(sys.modules[each.__module__], each.__name__, None) is each}
    public = {each for each in made if not each.__name__.startswith("_")}
    return sorted(public, key=lambda each: (each.__module__, each.__name__))


def quantities(record):
    """The fields of a record that hold one quantity each, and whether it may be absent."""
    for name, field in record.model_fields.items():
        alternatives = get_args(field.annotation) if field.metadata == [] else (field.annotation,)
        metadata = [*field.metadata]
        for each in alternatives:
            if get_origin(each) is Annotated:
                metadata += each.__metadata__
        if any(isinstance(each, Quantity) for each in metadata) and get_origin(field.annotation) not in (tuple, dict):
            yield name, NoneType in get_args(field.annotation)


@cache
def said(folder):
    """What the type checker says of all scripts at once: (severity, line, message) by the name of the script."""
    records = [each for each in kinds_of_records() if any(quantities(each))]
    lines = ["# pyright: strict"]
    for k, record in enumerate(records):
        lines += [f"from {record.__module__} import {record.__name__} as R{k}", f"reveal_type(R{k}.__init__)"]
        lines += [f"def read{k}(it: R{k}) -> None:"]
        lines += [f"    reveal_type(it.{name})" for name, _ in quantities(record)]
    every = Path(folder) / "every_field.py"
    every.write_text("\n".join(lines) + "\n", encoding="utf-8")
    (Path(folder) / "nivel").symlink_to(Path(nivel.__file__).parent)  # these sources, whatever is installed
    files = [SCRIPTS / "accepted.py", SCRIPTS / "refused.py", every]
    command = [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable, *map(str, files)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=PATIENCE, check=False)
    found = {file.name: [] for file in files}
    for each in json.loads(done.stdout)["generalDiagnostics"]:
        found[Path(each["file"]).name].append((each["severity"], each["range"]["start"]["line"] + 1, each["message"]))
    return found, records


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return str(tmp_path_factory.mktemp("typed"))


def test_a_script_of_a_user_is_accepted(folder):
    found, _ = said(folder)
    assert found["accepted.py"] == []


def test_wrong_lines_are_refused_and_no_others(folder):
    found, _ = said(folder)
    lines = (SCRIPTS / "refused.py").read_text(encoding="utf-8").splitlines()
    wrong = {number for number, line in enumerate(lines, start=1) if line.endswith("# refused")}
    assert {line for severity, line, _ in found["refused.py"] if severity == "error"} == wrong


def test_every_quantity_is_given_as_number_or_text_and_read_as_a_number(folder):
    found, records = said(folder)
    assert not [each for each in found["every_field.py"] if each[0] == "error"]
    revealed = iter([message for severity, _, message in found["every_field.py"] if severity == "information"])
    count = 0
    for record in records:
        made = next(revealed)
        for name, absent in quantities(record):
            given = "float | str | None" if absent else "float | str"
            assert re.search(rf"\b{name}: {re.escape(given)}( =|,|\))", made), (record, name, made)
            kind = "float | None" if absent else "float"
            assert next(revealed) == f'Type of "it.{name}" is "{kind}"', (record, name)
            count += 1
    assert count > 150
