"""`nivel reduce`: body, report and VTK files, the table, faults and their exit codes."""

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from nivel.cli import main
from nivel.flexible.body.body_file import read_body

EXAMPLES = Path(__file__).parents[2] / "examples" / "flexible"
BAR = str(EXAMPLES / "pendulum-bar.yaml")


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        return CliRunner().invoke(main, ["reduce", *map(str, arguments)], catch_exceptions=False)

    return call


def test_body_and_report_are_written_beside_each_other(run, tmp_path):
    done = run(BAR)
    assert done.exit_code == 0
    assert {path.name for path in tmp_path.iterdir()} == {"pendulum-bar.nc", "pendulum-bar.html"}
    assert "390 degrees of freedom, 65 nodes → 20 modes" in done.stderr
    assert "6 rigid-body modes were found" in done.stderr
    assert done.stdout == ""
    assert read_body("pendulum-bar.nc").mass == pytest.approx(7801 * 2 * 1e-4)


def test_summary_as_json_alone(run):
    done = run(BAR, "-o", "b.nc", "--no-report", "--quiet", "--json", "--set", "reduction.modes=4")
    assert done.stderr == ""
    findings = json.loads(done.stdout)
    assert len(findings["normal"]) == 4
    assert findings["mass"] == pytest.approx(1.5602)


def test_existing_files_need_force(run, tmp_path):
    (tmp_path / "b.html").write_text("mine")
    done = run(BAR, "-o", "b.nc")
    assert done.exit_code == 2
    assert "b.html exists already" in done.stderr
    assert not (tmp_path / "b.nc").exists()
    assert run(BAR, "-o", "b.nc", "--force", "--quiet").exit_code == 0
    assert (tmp_path / "b.html").read_text() != "mine"


def test_model_is_never_written_over(run, tmp_path):
    model = tmp_path / "model.yaml"
    model.write_text(Path(BAR).read_text())
    done = run(model, "-o", model, "--force")
    assert done.exit_code == 2
    assert model.read_text() == Path(BAR).read_text()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--no-report", "--report", "a.html"], "contradict"),
        (["-o", "b.html", "--report", "b.html"], "use a name ending in .nc"),
        (["-o", "nowhere/b.nc"], "there is no folder"),
        (["--set", "reduction.modez=3"], "did you mean `modes`?"),
        (["--vtk", "modes.vtk"], ".pvd"),
    ],
)
def test_wrong_options(run, arguments, words):
    done = run(BAR, *arguments)
    assert done.exit_code == 2
    assert words in done.stderr


def test_faults_of_the_model_have_their_place(run, tmp_path):
    (tmp_path / "bad.yaml").write_text(Path(BAR).read_text().replace("{node: tip}", "{node: tpi}"))
    done = run("bad.yaml")
    assert done.exit_code == 2
    assert re.search(r"bad\.yaml:\d+:\d+  interfaces\.tip\.node  there is no node `tpi`", done.stderr)


def test_modes_for_paraview(run, tmp_path):
    assert run(BAR, "--vtk", "modes.pvd", "--set", "reduction.modes=2", "--quiet", "--no-report").exit_code == 0
    assert len(list(tmp_path.glob("modes-*.vtu"))) == 8
