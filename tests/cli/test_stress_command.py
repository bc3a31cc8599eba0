"""`nivel stress`: tables, pictures, faults and their exit codes."""

import json
import shutil

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
from models import bar, reduced
from needing import needs
from nivel.cli import main
from nivel.flexible.body.body_file import write_body

MACHINE = """
format: 1
gravity: [0, -9.81, 0]
bodies:
  bar: {flexible: bar.nc}
joints:
  hinge: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]}
simulation: {integrator: generalised-alpha, duration: 0.2 s, step: 0.5 ms, output_interval: 5 ms}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stressed")
    write_body(reduced(bar(reduction="modes: 4"))[0], folder / "bar.nc")
    (folder / "machine.yaml").write_text(MACHINE)
    nivel.load(folder / "machine.yaml").simulate(out=folder / "run.nc")
    return folder


@pytest.fixture
def run(tmp_path, monkeypatch, folder):
    shutil.copy(folder / "run.nc", tmp_path)
    shutil.copy(folder / "bar.nc", tmp_path)
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        return CliRunner().invoke(main, ["stress", *map(str, arguments)], catch_exceptions=False)

    return call


def test_hot_spots_are_shown(run):
    done = run("run.nc", "--count", "2")
    assert done.exit_code == 0
    found = nivel.Result.open("run.nc").recover()
    spots = found.hot_spots(2)
    assert f"bar: largest stress at {found.worst_time:.6g} s" in done.stdout
    for spot in spots:
        assert f"{spot.value / 1e6:.5g}" in done.stdout
        assert str(spot.node_id) in done.stdout


def test_facts_as_json_alone(run):
    done = run("run.nc", "--json", "--quiet", "--node", "tip, 9", "--at", "0.1 s, 50 ms")
    assert done.stderr == ""
    facts = json.loads(done.stdout)
    found = nivel.Result.open("run.nc").recover()
    assert [each["node"] for each in facts["nodes"]] == [found.node("tip"), 9]
    assert facts["nodes"][1]["von_mises"] == found.von_mises(9).max()
    assert [each["time"] for each in facts["states"]] == [found.time[20], found.time[10]]
    # one state is summed in another order than all of them
    assert facts["states"][0]["von_mises"] == pytest.approx(found.von_mises()[20].max(), rel=1e-12)
    assert facts["hot_spots"][0]["von_mises"] == found.envelope.value.max()


def test_files_are_written(run, tmp_path):
    needs("matplotlib")
    done = run("run.nc", "--node", "root", "--csv", "h.csv", "--rainflow", "c.csv", "--plot", "p.png", "--vtk", "m.pvd")
    assert done.exit_code == 0
    assert (tmp_path / "p.png").read_bytes().startswith(b"\x89PNG")
    assert len(list(tmp_path.glob("m-*.vtu"))) == len(nivel.Result.open("run.nc").time)
    assert np.loadtxt(tmp_path / "h.csv", delimiter=",", skiprows=1, usecols=0)[-1] == pytest.approx(0.2)
    assert (tmp_path / "c.csv").read_text().startswith("node,station,range [Pa]")
    again = run("run.nc", "--csv", "h.csv")
    assert again.exit_code == 2
    assert "h.csv exists already" in again.stderr
    assert run("run.nc", "--csv", "h.csv", "--force").exit_code == 0
    assert (tmp_path / "h.csv").read_text().startswith("node,station")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--plot", "p.png"], "--plot needs --node"),
        (["--node", "1", "--strain"], "--strain needs --csv"),
        (["--node", "99, head"], "no node 99"),
        (["--node", "99, head"], "no interface `head`"),
        (["--node", ""], "no interface ``"),
        (["--at", "3 kg"], "a time (s) was expected"),
        (["--at", "1 min"], "60 s is outside of the run"),
        (["--body", "rod"], "there is no body `rod`"),
        (["--body-file", "run.nc"], "no body file of nivel"),
        (["--body-file", "none.nc"], "there is no body file none.nc"),
        (["--csv", "run.nc", "--force"], "made from"),
        (["--csv", "nowhere/h.csv"], "no folder nowhere"),
        (["--vtk", "m.vtu"], "ends with .pvd"),
        (["--node", "1", "--plot", "p.txt"], "ends with .png"),
        (["--count", "0"], "0 is not in the range"),
    ],
)
def test_faults_are_told(run, arguments, said):
    done = run("run.nc", *arguments)
    assert done.exit_code == 2
    assert said in done.stderr


def test_body_file_is_never_written_over(run):
    before = nivel.Result.open("run.nc").recover().body.name
    assert run("run.nc", "--csv", "bar.nc", "--body-file", "bar.nc", "--force").exit_code == 2
    assert nivel.Result.open("run.nc").recover().body.name == before
