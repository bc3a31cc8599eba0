"""`nivel compare` as a user calls it: words, files, exit codes."""

import csv
import json
import signal
import subprocess
import sys
import time

import pytest
from click.testing import CliRunner

from nivel.cli import main
from nivel.results.comparison import Comparison
from patience import PATIENCE

PENDULUM = """\
format: 1
name: pendulum
gravity: [0, -9.81, 0]
bodies:
  bar: {mass: 1, inertia: [0.001, 0.0833, 0.0833], position: [0.5, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]}
simulation: {duration: 0.5, step: 5 ms}
"""
BURST = 'forces:\n  burst: {type: torque, body: bar, vector: [0, 0, "log(0.2 - time)"]}\n'
# `nivel` that writes a letter for every run it makes
TELLING = """
from nivel.analysis.compare import compare
from nivel.cli import main

run = compare.run_in_memory

def told(*given):
    done = run(*given)
    with open("runs", "a") as file:
        file.write("x")
    return done

compare.run_in_memory = told
main()
"""
IN_THE_FIRST_CELL = 40  # runs: far more than there are references


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def nivel(*arguments):
    return CliRunner().invoke(main, ["compare", "pendulum.yaml", *map(str, arguments)])


def test_tables_and_page_stand_beside_each_other(folder):
    done = nivel("--steps", "5ms,10 ms", "--stabilisations", "none, direct", "--repeat", 1)
    assert done.exit_code == 0, done.stderr
    comparison = Comparison.from_json((folder / "pendulum-compare.json").read_text(encoding="utf-8"))
    assert [(row.stabilisation, row.step) for row in comparison.rows] == [
        ("none", 0.005),
        ("none", 0.01),
        ("direct", 0.005),
        ("direct", 0.01),
    ]
    with (folder / "pendulum-compare.csv").open(encoding="utf-8") as file:
        assert len(list(csv.DictReader(file))) == 4
    assert "<html" in (folder / "pendulum-compare.html").read_text(encoding="utf-8")
    lines = done.stdout.splitlines()
    assert [line.split()[0] for line in lines[2:6]] == ["none", "none", "direct", "direct"]
    assert "spread: the 2 methods" in done.stdout
    assert "written: pendulum-compare.csv, pendulum-compare.json, pendulum-compare.html" in done.stderr


def test_existing_files_need_force_and_the_machine_is_never_written_over(folder):
    (folder / "pendulum-compare.csv").write_text("mine")
    assert nivel("--repeat", 1).exit_code == 2
    assert (folder / "pendulum-compare.csv").read_text() == "mine"
    assert not (folder / "pendulum-compare.json").exists()
    assert nivel("--repeat", 1, "--force", "--no-report").exit_code == 0
    assert (folder / "pendulum-compare.csv").read_text() != "mine"
    assert not (folder / "pendulum-compare.html").exists()
    refused = nivel("--force", "--report", "pendulum.yaml")
    assert refused.exit_code == 2
    assert (folder / "pendulum.yaml").read_text() == PENDULUM


def test_that_a_file_cannot_be_written_is_known_before_anything_is_run(folder, monkeypatch):
    monkeypatch.setattr("nivel.api.Machine.compare", lambda *_, **__: pytest.fail("the grid was run"))
    for arguments in (["--out", "missing/a.csv"], ["--report", "missing/a.html"], ["--out", "pendulum.yaml/a.json"]):
        assert nivel(*arguments).exit_code == 2
    (folder / "pendulum-compare.csv").write_text("mine")
    monkeypatch.setattr("os.access", lambda path, _mode: folder / path != folder / "pendulum-compare.csv")
    refused = nivel("--force")
    assert refused.exit_code == 2
    assert "pendulum-compare.csv cannot be written: permission denied" in refused.stderr


def test_names_of_files_and_json_on_standard_output(folder):
    done = nivel("--repeat", 1, "--out", "table.csv", "--report", "page.html", "--json", "--quiet")
    assert done.exit_code == 0
    assert {path.name for path in folder.iterdir()} == {"pendulum.yaml", "table.csv", "page.html"}
    assert json.loads(done.stdout)["machine"] == "pendulum"
    assert done.stderr == ""


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--integrators", "rk4,rk5"], ["rk5", "did you mean `rk4`"]),
        (["--stabilisations", "nothing"], ["nothing", "baumgarte"]),
        (["--steps", "1ms,3 kg"], ["3 kg", "a time"]),
        (["--tolerances", "1e-6"], ["`tolerances` would have no effect", "rk4"]),
        (["--cut", "hinge", "--coordinates", "absolute"], ["`cut` would have no effect"]),
        (["--steps", ""], ["steps", "a value is missing", "leave it out"]),
        (["--steps", ","], ["steps", "a value is missing at the places 1, 2 of 2"]),
        (["--steps", "1ms,"], ["steps", "a value is missing at place 2 of 2", "take a comma away"]),
        (
            ["--integrators", "rk4,,heun", "--tolerances", " "],
            ["integrators", "place 2 of 3", "tolerances", "2 faults"],
        ),
        (["--no-report", "--report", "z.html"], ["--no-report and --report z.html contradict each other"]),
        (["--steps", "1ms,nan,inf"], ["--steps  a finite number is needed, got `nan`", "got `inf`"]),
        (["--integrators", "dop853", "--tolerances", "nan"], ["--tolerances  a finite number is needed, got `nan`"]),
        (["--repeat", "0"], ["--repeat"]),
        (["--out", "table.txt"], [".csv or .json"]),
        (["--out", "a.csv", "--report", "a.csv"], ["written over the table"]),
        (["--out", "missing/folder/a.csv"], ["there is no folder missing/folder for the table a.csv"]),
        (["--report", "missing/a.html"], ["there is no folder missing for the report a.html"]),
        (["--out", "pendulum.yaml/a.csv"], ["pendulum.yaml is not a folder"]),
    ],
)
def test_wrong_words_end_with_code_two_and_say_what_would_be_right(folder, arguments, words):
    done = nivel(*arguments)
    assert done.exit_code == 2, done.output
    for word in words:
        assert word in done.stderr


def test_a_failed_cell_is_told_and_the_grid_goes_on(folder):
    done = nivel("--formulations", "penalty,newton-euler", "--stabilisations", "baumgarte", "--repeat", 1)
    assert done.exit_code == 0
    assert "refused: 'baumgarte' does not go with" in done.stdout


def test_code_three_where_every_cell_failed(folder):
    (folder / "pendulum.yaml").write_text(PENDULUM + BURST)
    done = nivel("--steps", "5ms,10ms", "--repeat", 1)
    assert done.exit_code == 3
    assert "failed: stopped at t = 0.19" in done.stdout
    assert "the force burst is not a number at t = 0.2 s" in done.stdout
    assert (folder / "pendulum-compare.html").exists()


def test_code_two_where_every_cell_is_refused(folder):
    done = nivel("--formulations", "penalty", "--stabilisations", "baumgarte", "--repeat", 1)
    assert done.exit_code == 2
    assert "does not go with" in done.stdout


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
def test_an_interrupt_ends_with_code_130_and_writes_what_there_is(folder):
    command = [sys.executable, "-c", TELLING, "compare", "pendulum.yaml", "--steps", "5ms,10ms", "--force", "--repeat"]
    subprocess.run([*command, "1"], cwd=folder, check=True, capture_output=True)  # compiles
    (folder / "runs").unlink()
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    # a shell that runs the tests in the background has SIGINT ignored, and children inherit that
    heard = {"preexec_fn": lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)}
    with subprocess.Popen([*command, "1000000"], cwd=folder, **pipes, **heard) as process:
        end = time.monotonic() + PATIENCE
        while not (folder / "runs").exists() or (folder / "runs").stat().st_size < IN_THE_FIRST_CELL:
            assert process.poll() is None, process.communicate()
            assert time.monotonic() < end, "the comparison did not start"
            time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        out, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130, errors
    assert "cells are missing" in out
    assert Comparison.from_json((folder / "pendulum-compare.json").read_text(encoding="utf-8")).outcome == "interrupted"
