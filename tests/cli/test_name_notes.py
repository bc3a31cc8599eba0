"""`nivel check` and `nivel run` say which parameters stand in place of units and constants."""

import json

import pytest
from click.testing import CliRunner

from nivel.cli import main

MACHINE = """\
format: 1
parameters: {m: 3 kg, e: 0.3}
bodies:
  rod: {mass: m, inertia: [1, 1, 1]}
joints:
  rail: {type: translational, bodies: [ground, rod], point: [0, 0, 0], axis: [0, 0, 1]}
forces:
  lift: {type: force, body: rod, vector: [0, 0, 1 N + e]}
simulation: {duration: 2 ms, step: 1 ms}
"""
UNIT = "note: in expressions `m` ({}) is the parameter, not the metre; directly after a number it is the unit: `2 m`"
CONSTANT = "note: in expressions `e` (0.3) is the parameter, not the constant 2.7183"


@pytest.fixture
def machine(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mass.yaml").write_text(MACHINE, encoding="utf-8")
    return tmp_path / "mass.yaml"


def nivel(*arguments):
    done = CliRunner().invoke(main, [str(argument) for argument in arguments], prog_name="nivel")
    assert done.exit_code == 0, done.output
    return done


def test_check_notes_names_that_are_also_units(machine):
    lines = nivel("check", machine).output.splitlines()
    assert lines[1:3] == [UNIT.format("3 kg"), CONSTANT]
    assert UNIT.format("4 kg") in nivel("check", machine, "--set", "parameters.m=4 kg").output
    notes = json.loads(nivel("check", machine, "--json").stdout)["name_notes"]
    assert [f"note: {note}" for note in notes] == [UNIT.format("3 kg"), CONSTANT]


def test_run_notes_them_too(machine):
    lines = nivel("run", machine, "--no-report", "--no-verify").output.splitlines()
    assert UNIT.format("3 kg") in lines
    assert CONSTANT in lines


def test_other_parameters_are_not_noted(machine):
    machine.write_text(
        MACHINE.replace("m: 3 kg, e:", "mass: 3 kg, ratio:").replace("mass: m", "mass: mass").replace("+ e", "+ ratio")
    )
    assert "note:" not in nivel("check", machine).output
