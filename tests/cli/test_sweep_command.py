"""`nivel sweep`: what it prints and writes, its exit codes, and what it refuses."""

import json

import pytest
from click.testing import CliRunner

from nivel.analysis.sweep import sweep as sweeping
from nivel.analysis.sweep.sweep import Engine
from nivel.cli import main

MACHINE = """
format: 1
bodies: {block: {mass: 1, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}
forces: {push: {type: motor, coordinate: rail, effort: 2 N}}
simulation: {duration: 0.1, step: 1 ms}
"""
STUDY = """
format: 1
name: pushes
machine: machine.yaml
parameters: {block.mass: {type: range, from: 1 kg, to: 4 kg, count: 4}}
outputs: {way: {type: final, of: rail.displacement, at_least: 3 mm}}
"""


@pytest.fixture
def run(tmp_path, monkeypatch):
    """In this process, where no worker has to start."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sweeping, "Engine", lambda *_, **__: Engine(1))
    (tmp_path / "machine.yaml").write_text(MACHINE, encoding="utf-8")
    (tmp_path / "study.yaml").write_text(STUDY, encoding="utf-8")
    return lambda *words: CliRunner().invoke(main, ["sweep", "study.yaml", *words], prog_name="nivel")


def test_a_study_is_told_written_and_reported(run, tmp_path):
    """x = F t²/2m: 10 mm, 5 mm, 3.33 mm and 2.5 mm."""
    done = run("--json")
    assert done.exit_code == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["outcomes"] == {"done": 4}
    assert found["yield"] == 0.75
    assert found["outputs"]["way"]["max"] == pytest.approx(0.01, rel=1e-9)
    assert "yield: 3 of 4 variants are within all limits, 75 %" in done.stderr
    assert {"pushes.nc", "pushes.html"} <= {path.name for path in tmp_path.iterdir()}
    assert not (tmp_path / "pushes.nc.journal").exists()
    assert "exists" in run().stderr
    again = run("--resume")
    assert (again.exit_code, again.stderr.strip()) == (0, "pushes.nc is complete: nothing is left to compute")


def test_variants_that_are_refused_are_named_and_all_of_them_are_a_fault(run):
    some = run("--no-report", "--set", "parameters={block.mass: [1, -1]}")
    assert some.exit_code == 0
    assert "variant 1: refused" in some.stderr
    none = run("--force", "--no-report", "--set", "parameters={block.mass: [1, 2]}", "--set", "settings={cut: [no]}")
    assert none.exit_code == 2


def test_failures_of_all_variants_are_exit_code_3(run, tmp_path):
    (tmp_path / "out.py").write_text("def f(result):\n    return 1 / 0\n", encoding="utf-8")
    failed = run("--allow-code", "--no-report", "--set", "outputs={x: {type: python, python: out.py, function: f}}")
    assert failed.exit_code == 3
    assert "output x: ZeroDivisionError" in failed.stderr
    refused = run("--force", "--set", "outputs={x: {type: python, python: out.py, function: f}}")
    assert refused.exit_code == 2
    assert "--allow-code" in refused.stderr


def test_a_fault_of_an_output_is_told_at_its_line(run, tmp_path):
    (tmp_path / "study.yaml").write_text(STUDY.replace("rail.displacement", "rail.displacment"), encoding="utf-8")
    done = run()
    assert done.exit_code == 2
    assert "study.yaml:6:" in done.stderr
    assert "did you mean `rail.displacement`" in done.stderr


def test_a_study_is_no_machine(run):
    done = CliRunner().invoke(main, ["run", "study.yaml"], prog_name="nivel")
    assert done.exit_code == 2
    assert "this is a study, not a machine: `nivel sweep study.yaml`" in done.stderr
