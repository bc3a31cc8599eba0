"""`nivel statics` as a user calls it."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from nivel.cli import main
from nivel.results import Result

EXAMPLE = Path(__file__).parents[2] / "examples" / "mechanisms" / "toggle.yaml"
PENDULUM = """\
format: 1
name: pendulum
gravity: [0, -9.81, 0]
bodies:
  bar: {mass: 1, inertia: [0.001, 0.0833, 0.0833], position: [0.5, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]}
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def nivel(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments], prog_name="nivel")


def test_toggle_writes_its_path_and_a_report_with_a_diagram(folder):
    done = nivel("statics", EXAMPLE, "--arc-length", "--modes", "1")
    assert done.exit_code == 0, done.stderr
    assert "limit point" in done.stderr
    assert "vibration 1:" in done.stderr
    result = Result.open(folder / "toggle-statics.nc")
    assert result.outcome == "done"
    assert result.time[-1] == 1.0
    page = (folder / "toggle-statics.html").read_text(encoding="utf-8")
    assert page.count('class="load-path"') >= 1
    assert 'class="unstable"' in page
    assert page.count('<circle class="critical"') >= 2
    assert "Vibrations about the last state" in page
    # what is played goes on as the path does, though time turns back
    assert all(later > earlier for earlier, later in zip(result.abscissa, result.abscissa[1:], strict=False))


def test_json_summary(folder):
    done = nivel("statics", "pendulum.yaml", "--json", "--quiet", "--no-report")
    assert done.exit_code == 0, done.stderr
    summary = json.loads(done.stdout)
    assert summary["trust"]["verdict"] == "green"
    assert summary["frames"] == 1
    assert summary["settings"]["analysis"] == "statics"
    assert done.stderr == ""


def test_a_limit_point_without_arc_length_ends_with_code_3_and_keeps_the_states(folder):
    done = nivel("statics", EXAMPLE)
    assert done.exit_code == 3
    assert "limit point at t = 0.4974958" in done.stderr
    assert "--arc-length" in done.stderr
    result = Result.open(folder / "toggle-statics.nc")
    assert result.outcome == "failed"
    assert len(result.time) > 10
    assert (folder / "toggle-statics.html").exists()


def test_a_mechanism_ends_with_code_3_and_is_named(folder):
    done = nivel("statics", "pendulum.yaml", "--set", "gravity=[0, 0, 0]")
    assert done.exit_code == 3
    assert "the joint hinge, coordinate hinge.angle" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "options",
    [
        ["--duration", "soon"],
        ["--step", "2 kg"],
        ["--tolerance", "0"],
        ["--modes", "few"],
        ["--modes", "2.5"],
        ["--buckling", "1", "--duration", "0"],
        ["--coordinates", "polar"],
        ["--most-iterations", "0"],
        ["--nonsense"],
        ["--set", "bodies.bar.mass=-1"],
    ],
)
def test_bad_options_end_with_code_2_and_without_a_traceback(folder, options):
    done = nivel("statics", "pendulum.yaml", *options)
    assert done.exit_code == 2, done.stderr
    assert "Traceback" not in done.output
    assert not list(folder.glob("*.nc"))


def test_existing_results_and_the_machine_itself_are_not_replaced(folder):
    assert nivel("statics", "pendulum.yaml", "--no-report").exit_code == 0
    assert nivel("statics", "pendulum.yaml", "--no-report").exit_code == 2
    assert nivel("statics", "pendulum.yaml", "--no-report", "--force").exit_code == 0
    assert nivel("statics", "pendulum.yaml", "--out", "pendulum.yaml", "--force").exit_code == 2
    assert (folder / "pendulum.yaml").read_text() == PENDULUM


def test_explain_export_and_stills_take_statics_results(folder):
    assert nivel("statics", "pendulum.yaml", "--modes", "1", "--no-report").exit_code == 0
    explained = nivel("explain", "pendulum-statics.nc")
    assert explained.exit_code == 0
    assert "Equilibrium" in explained.output
    assert nivel("export", "pendulum-statics.nc", "--csv").exit_code == 0
    assert nivel("view", "pendulum-statics.nc", "--export", "scene.html").exit_code == 0


def test_vibrations_can_be_played(folder):
    assert nivel("statics", "pendulum.yaml", "--modes", "2", "--no-report").exit_code == 0
    assert nivel("view", "pendulum-statics.nc", "--mode", "1", "--export", "mode.html").exit_code == 0
    motion = Result.open(folder / "pendulum-statics.nc").mode(1)
    position = motion.array("bar.position")
    # the bar hangs at (0, -0.5): it swings along x, and the hinge stays on its axis in the first order
    assert abs(position[:, 0]).max() == pytest.approx(
        0.08 * Result.open(folder / "pendulum-statics.nc").trust.size, rel=1e-6
    )
    assert abs(position[:, 1] + 0.5).max() < 1e-9
    for options, said in ((["--mode", "2"], "fewer degrees of freedom"), (["--mode", "7"], "no vibration 7")):
        done = nivel("view", "pendulum-statics.nc", *options, "--export", "other.html")
        assert done.exit_code == 2
        assert said in done.stderr
    assert nivel("view", "pendulum.yaml", "--mode", "1", "--export", "other.html").exit_code == 2


def test_a_run_may_start_from_equilibrium(folder):
    done = nivel("run", "pendulum.yaml", "--start", "equilibrium", "--duration", "0.1", "--step", "1 ms", "--no-report")
    assert done.exit_code == 0, done.stderr
    position = Result.open(folder / "pendulum.nc").array("bar.position")
    assert abs(position - [0, -0.5, 0]).max() < 1e-9
    assert nivel("run", "pendulum.yaml", "--start", "anywhere", "--out", "b.nc").exit_code == 2
