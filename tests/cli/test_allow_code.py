"""`--allow-code`: laws in Python run only where someone says that they may."""

import json

import pytest
from click.testing import CliRunner

import nivel
from nivel.cli import main
from nivel.errors import ModelError

MACHINE = """\
format: 1
bodies: {wheel: {mass: 1, inertia: [1, 1, 1], angular_velocity: [0, 0, 1]}}
joints: {axle: {type: revolute, bodies: [ground, wheel], point: [0, 0, 0], axis: [0, 0, 1]}}
forces:
  brake: {type: motor, coordinate: axle.angle, effort: {python: laws.py, function: brake, arguments: [axle.angle_rate]}}
simulation: {duration: 0.1, step: 1 ms}
"""


@pytest.fixture(autouse=True)
def _here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "machine.yaml").write_text(MACHINE, encoding="utf-8")
    (tmp_path / "laws.py").write_text("def brake(rate):\n    return -2.0 * rate\n", encoding="utf-8")


@pytest.mark.parametrize("command", ["run", "check"])
def test_refused_without(command):
    refused = CliRunner().invoke(main, [command, "machine.yaml"])
    assert refused.exit_code == 2
    assert "machine.yaml:5:" in refused.stderr
    assert "this law runs Python code from laws.py; say --allow-code if you trust it" in refused.stderr


@pytest.mark.parametrize("command", ["run", "check"])
def test_taken_with(command):
    taken = CliRunner().invoke(main, [command, "machine.yaml", "--allow-code", "--json"])
    assert taken.exit_code == 0, taken.stderr
    assert json.loads(taken.stdout)


def test_in_python():
    with pytest.raises(ModelError, match="--allow-code"):
        nivel.load("machine.yaml")
    assert nivel.load("machine.yaml", allow_code=True).name == "machine"
