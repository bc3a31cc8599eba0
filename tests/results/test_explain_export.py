"""`nivel explain` and `nivel export` on the command line."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner

import synthetic_run as pendulum
from nivel.cli import main
from nivel.errors import ModelError
from nivel.results import Result, Store
from patience import PATIENCE

TIME = np.linspace(0.0, 1.0, 11)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A working directory with a result in it."""
    monkeypatch.chdir(tmp_path)
    sink = Store(tmp_path / "run.nc")
    sink.begin(pendulum.header(machine="swing [/bold]"))  # what looks like markup is a name
    sink.take(pendulum.frames(TIME))
    sink.close({"outcome": "done", "trust": pendulum.judged(sink.result()).to_json()})
    return tmp_path


def nivel(*arguments):
    return CliRunner().invoke(main, [str(each) for each in arguments])


def test_explain_says_every_number_and_every_reason(folder):
    done = nivel("explain", "run.nc")
    text = " ".join(done.stdout.split())
    assert done.exit_code == 0
    assert "swing [/bold]: 0 to 1 s, 11 frames" in text
    assert "trust: not verified" in text
    kinetic = pendulum.histories(TIME)["kinetic_energy"].max()
    assert f"of the largest kinetic energy {kinetic:.3g} J (green below 1e-4, amber below 1e-2)" in text
    assert "a micrometre" in text


def test_explain_as_json(folder):
    data = json.loads(nivel("explain", "run.nc", "--json").stdout)
    assert data["verdict"] == "green"
    assert data["degrees_of_freedom"] == 1


def test_export_writes_beside_nothing_but_here(folder):
    done = nivel("export", "run.nc", "--csv")
    assert done.exit_code == 0
    assert (folder / "run.csv").read_text(encoding="utf-8").startswith("time [s],arm.position.x [m]")
    assert nivel("export", "run.nc", "--csv").exit_code == 2
    assert nivel("export", "run.nc", "--csv", "--force").exit_code == 0


def test_export_of_a_choice_to_a_file_and_to_standard_output(folder):
    assert nivel("export", "run.nc", "--csv", "out.csv", "--select", "hinge.angle, *.rate").exit_code == 0
    header = (folder / "out.csv").read_text(encoding="utf-8").splitlines()[0]
    assert header == "time [s],hinge.angle [rad],hinge.angle.rate [rad/s]"
    shown = nivel("export", "run.nc", "--csv", "-", "--select", "kinetic_energy").stdout.splitlines()
    assert shown[0] == "time [s],kinetic_energy [J]"
    assert len(shown) == 1 + len(TIME)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["explain", "nothing.nc"], "there is no result file nothing.nc"),
        (["export", "run.nc"], "say in which form"),
        (["export", "run.nc", "--csv", "--select", "hinge.angel"], "did you mean `hinge.angle`"),
        (["export", "run.nc", "--csv", "nowhere/out.csv"], "there is no folder nowhere"),
    ],
)
def test_faults_are_the_users_and_said(folder, arguments, said):
    done = nivel(*arguments)
    assert done.exit_code == 2
    assert said in done.stderr


def test_a_result_is_never_written_over_by_what_is_made_from_it(folder):
    before = (folder / "run.nc").read_bytes()
    (folder / "link.csv").symlink_to("run.nc")
    os.link(folder / "run.nc", folder / "same.csv")
    for name in ("run.nc", "link.csv", "same.csv"):
        refused = nivel("export", "run.nc", "--csv", name, "--force")
        assert refused.exit_code == 2
        assert "would be written over run.nc" in refused.stderr
        with pytest.raises(ModelError, match="would be written over"):
            Result.open("run.nc").export_csv(name)
        with pytest.raises(ModelError, match="would be written over"):
            Result.open("run.nc").report(name)
    assert (folder / "run.nc").read_bytes() == before


def test_a_table_replaces_files_only(folder):
    (folder / "out.csv").mkdir()
    refused = nivel("export", "run.nc", "--csv", "out.csv", "--force")
    assert refused.exit_code == 2
    assert "is a folder" in refused.stderr


@pytest.mark.skipif(os.name == "nt", reason="POSIX pipes")
def test_a_reader_that_has_enough_is_no_failure(folder):
    sink = Store(folder / "long.nc")
    sink.begin(pendulum.header())
    sink.take(pendulum.frames(np.linspace(0.0, 1.0, 5001)))  # more than a pipe holds
    sink.close({"outcome": "done"})
    command = [sys.executable, "-m", "nivel", "export", "long.nc", "--csv", "-"]
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout.readline().startswith(b"time [s]")
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait(timeout=PATIENCE) == 0
