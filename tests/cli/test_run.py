"""`nivel run` as a user calls it: files, exit codes, interruption, kill."""

import json
import os
import re
import resource
import signal
import subprocess
import sys
import time
from contextlib import chdir
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner

from nivel.cli import main
from nivel.methods import known_words
from nivel.results import Result
from patience import PATIENCE

PENDULUM = """\
format: 1
name: pendulum
gravity: [0, -9.81, 0]
bodies:
  bar: {mass: 1, inertia: [0.001, 0.0833, 0.0833], position: [0.5, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]}
simulation: {duration: 1, step: 1 ms, output_interval: 10 ms}
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    return tmp_path


def nivel(folder, *arguments):
    """What the command says and leaves behind; in this process, where a defect is an error of the test."""
    with chdir(folder):
        done = CliRunner().invoke(main, [*map(str, arguments)], prog_name="nivel", catch_exceptions=False)
    return SimpleNamespace(returncode=done.exit_code, stdout=done.stdout, stderr=done.stderr)


def process(folder, *arguments, **options):
    """The same by a process of its own."""
    command = [sys.executable, "-m", "nivel", *map(str, arguments)]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=PATIENCE, **options)


@pytest.fixture(scope="module")
def logged(tmp_path_factory):
    """A folder with a run by a process of its own, and what that said."""
    folder = tmp_path_factory.mktemp("logged")
    (folder / "pendulum.yaml").write_text(PENDULUM)
    return folder, process(folder, "run", "pendulum.yaml")


def test_a_run_into_a_log_says_what_it_does_in_plain_lines(logged):
    folder, done = logged
    lines = done.stderr.splitlines()
    stages = ("preparing", "running", "verifying with", "writing the report", "ended after", "pendulum: completed")
    places = [next(k for k, line in enumerate(lines) if line.startswith(stage)) for stage in stages]
    assert places == sorted(places)
    assert all(line.isprintable() for line in lines)
    silent = process(folder, "run", "pendulum.yaml", "--force", "--quiet")
    assert (silent.returncode, silent.stdout, silent.stderr) == (0, "", "")


def test_sentences_of_a_log_are_whole_lines(folder):
    """A terminal of 80 columns folds them; a file does not, so that they can be searched for."""
    done = process(folder, "run", "pendulum.yaml", "--no-report", "--integrator", "euler", "--step", "10 ms")
    sentences = [line for line in done.stderr.splitlines() if line.startswith("  ●")]
    assert sentences
    assert all(line.endswith(")") for line in sentences), done.stderr
    assert max(map(len, sentences)) > 80


@pytest.mark.parametrize("call", ["in this process", "in its own"])
def test_result_and_report_stand_beside_each_other(folder, logged, call):
    folder, done = logged if call == "in its own" else (folder, nivel(folder, "run", "pendulum.yaml"))
    assert done.returncode == 0, done.stderr
    assert done.stdout == ""
    assert (folder / "pendulum.nc").exists()
    assert "<html" in (folder / "pendulum.html").read_text(encoding="utf-8")
    result = Result.open(folder / "pendulum.nc")
    assert result.outcome == "done"
    assert result.trust.verdict == "green"
    assert len(result.time) == 101
    assert "trust: green, within " in done.stderr
    said = " ".join(done.stderr.split())  # lines end where the window does
    assert re.search(
        r"pendulum: completed \(t = [\d.]+ s\), \d+ steps computed in [\d.]+ [mµ]?s \([\d.]+ [mµn]s per step\)", said
    )
    assert f"All {len(result.trust.items) - 1} numerical checks passed" in done.stderr
    assert 0 < np.nanmax(result.estimated_error("hinge.angle")) < 1e-6


def test_a_run_without_verification_is_never_a_plain_yes(folder):
    done = nivel(folder, "run", "pendulum.yaml", "--no-verify")
    assert "trust: not verified" in done.stderr
    assert "green," not in done.stderr
    result = Result.open(folder / "pendulum.nc")
    assert result.trust.headline == "not verified: no second run was made"
    assert np.isnan(result.estimated_error("hinge.angle")).all()
    page = (folder / "pendulum.html").read_text(encoding="utf-8")
    assert "Not verified" in page
    assert "Yes, everything is in the green" not in page


def test_json_summary_is_all_that_stands_on_standard_output(folder):
    done = nivel(folder, "run", "pendulum.yaml", "--json", "--quiet", "--no-report")
    summary = json.loads(done.stdout)
    assert summary["outcome"] == "done"
    assert summary["trust"]["degrees_of_freedom"] == 1
    assert 0 < summary["trust"]["accuracy_estimate"] < 1e-6
    assert summary["headline"].startswith("within ")
    assert done.stderr == ""
    assert not (folder / "pendulum.html").exists()


def test_options_go_before_the_file_and_are_recorded(folder):
    options = ["--duration", "0.5 s", "--step", "2 ms", "--output-interval", "20 ms", "--formulation", "lagrange"]
    options += ["--stabilisation", "baumgarte", "--set", "bodies.bar.mass=2 kg", "--out", "other.nc", "--no-report"]
    done = nivel(folder, "run", "pendulum.yaml", *options)
    assert done.returncode == 0, done.stderr
    result = Result.open(folder / "other.nc")
    assert result.settings["step"] == 2e-3
    assert result.settings["formulation"] == "lagrange"
    assert result.settings["stabilisation"] == "baumgarte"
    assert len(result.time) == 26
    assert json.loads(result.attributes["machine_record"])["bodies"][0]["mass"] == 2.0


def test_existing_result_needs_force(folder):
    assert nivel(folder, "run", "pendulum.yaml", "--no-report").returncode == 0
    before = (folder / "pendulum.nc").read_bytes()
    refused = nivel(folder, "run", "pendulum.yaml", "--no-report")
    assert refused.returncode == 2
    assert "--force" in refused.stderr
    assert (folder / "pendulum.nc").read_bytes() == before
    assert nivel(folder, "run", "pendulum.yaml", "--no-report", "--force").returncode == 0


@pytest.mark.skipif(os.name == "nt", reason="POSIX special files")
def test_force_never_destroys_the_machine_nor_what_is_no_file(folder):
    (folder / "link.html").symlink_to("pendulum.yaml")
    os.mkfifo(folder / "pipe.nc")
    os.mkfifo(folder / "other.html")
    cases = {
        "pendulum.yaml": "would be written over pendulum.yaml",
        "link.nc": "would be written over pendulum.yaml",
        "pipe.nc": "is a pipe",
        "other.nc": "is a pipe",
        f"{'x' * 300}.nc": "file name too long",
        f"{'x' * 252}.nc": "file name too long",  # of the report
        "": "the name of a result file was expected",
    }
    for name, said in cases.items():
        refused = CliRunner().invoke(
            main, ["run", str(folder / "pendulum.yaml"), "--force", "--out", str(folder / name) if name else ""]
        )
        assert refused.exit_code == 2, refused.output
        assert said.replace("over pendulum", f"over {folder}/pendulum") in refused.stderr
    assert (folder / "pendulum.yaml").read_text() == PENDULUM
    assert (folder / "pipe.nc").is_fifo()
    assert (folder / "other.html").is_fifo()


@pytest.mark.skipif(os.name == "nt", reason="POSIX limits")
def test_a_disk_that_is_full_ends_with_code_three_and_a_readable_result(folder):
    def small_disk():
        resource.setrlimit(resource.RLIMIT_FSIZE, (3_000_000, 3_000_000))
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

    nivel(folder, "run", "pendulum.yaml", "--no-report", "--out", "first.nc")  # compiled before the disk is full
    arguments = ("run", "pendulum.yaml", "--duration", "20", "--output-interval", "1 ms")
    done = process(folder, *arguments, preexec_fn=small_disk)
    assert done.returncode == 3, done.stderr
    result = Result.open(folder / "pendulum.nc")
    assert result.outcome == "failed"
    assert len(result.time) > 0
    assert f"cannot be written further: file too large; it is readable up to t = {result.time[-1]:.6g} s" in done.stderr
    assert "Traceback" not in done.stderr


def test_forces_beyond_all_bounds_give_no_warnings(folder):
    text = PENDULUM.replace("[0.001, 0.0833, 0.0833]", "[1, 1, 1]").replace("[0.5, 0, 0]", "[1, 0, 0]")
    burst = 'burst: {type: force, body: bar, position: [0.3, 0, 0.2], vector: [0, "exp(1000*time)", 0]}'
    text += f"forces:\n  {burst}\n"
    (folder / "burst.yaml").write_text(text)
    done = process(folder, "run", "burst.yaml", "--output-interval", "1 ms")
    assert "Warning" not in done.stderr
    assert "trust: red" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--step", "3 kg"], ["step", "time"]),
        (["--step", "-1"], ["step"]),
        (["--step", "nan", "--duration", "-inf"], ["step  a finite", "is needed, got `nan`", "duration", "got `inf`"]),
        (["--integrator", "dop853", "--tolerance", "nan"], ["tolerance  a finite number is needed, got `nan`"]),
        (["--integrator", "dop853", "--tolerance", "inf"], ["tolerance  a finite number is needed, got `inf`"]),
        (["--integrator", "rk5"], ["rk5", "rk4"]),
        (["--integrator", "nonsense"], ["rk4", "dopri5", "gear"]),
        (["--formulation", "lagrang"], ["lagrang", "lagrange"]),
        (["--rotations", "euler"], ["euler-angles", "rotation-vector"]),
        (["--rotations", "euler-angles"], ["rotations", "formulation: lagrange"]),
        (["--tolerance", "small"], ["tolerance", "a number was expected, got `small`"]),
        (["--tolerance", "2"], ["tolerance", "less than 1 was expected, got `2`"]),
        (["--integrator", "rk4", "--tolerance", "1e-8"], ["`tolerance` has no effect", "`integrator: rk4` is fixed"]),
        (
            ["--integrator", "rk4", "--largest-step", "1 ms"],
            ["`largest_step` has no effect", "`integrator: rk4` is fixed"],
        ),
        (["--cut", "hinge", "--coordinates", "absolute"], ["`cut` has no effect", "coordinates: relative"]),
        (["--set", "simulation.penalty.omega=10"], ["`penalty` has no effect", "augmented-lagrangian"]),
        (["--set", "simulation.corrector.iteration=newton"], ["`corrector` has no effect", "rk4"]),
        (["--set", "simulation.hht.alpha=0.1"], ["`hht` has no effect", "integrator: hht", "integrator: rk4"]),
        (
            ["--integrator", "hht", "--set", "simulation.newmark.gamma=0.6"],
            ["`newmark` has no effect", "integrator: newmark", "integrator: hht"],
        ),
        (
            ["--set", "simulation.generalised_alpha.spectral_radius=0.5"],
            ["`generalised_alpha` has no effect", "integrator: generalised-alpha"],
        ),
        (
            ["--integrator", "rk4", "--output-interval", "1e-5"],
            ["--output-interval  ", "pendulum.yaml:", "`output_interval` 1e-05 s is shorter than `step`"],
        ),
        (["--integrator", "rk4", "--output-interval", "1.5 ms"], ["--output-interval  ", "multiple of the step"]),
        (["--set", "bodies.bra.mass=2"], ["bra", "bar"]),
        (["--set", "nonsense"], ["PATH=VALUE"]),
        (["--out", "missing/folder/x.nc"], ["missing"]),
        (["--wrong"], ["--wrong"]),
    ],
)
def test_wrong_options_end_with_code_two_and_say_what_would_be_right(folder, arguments, words):
    done = nivel(folder, "run", "pendulum.yaml", *arguments)
    assert done.returncode == 2, done.stderr
    assert "Traceback" not in done.stderr
    for word in words:
        assert word in done.stderr
    assert not (folder / "pendulum.nc").exists()


def test_everything_that_does_not_go_together_is_said_at_once_and_before_anything_is_compiled(folder):
    driven = PENDULUM + "drivers: {turn: {coordinate: hinge, value: 2*time}}\n"
    (folder / "pendulum.yaml").write_text(driven)
    options = (
        "--stabilisation geometric --formulation penalty --coordinates independent --integrator rk4 --tolerance 1e-8"
    )
    done = nivel(folder, "run", "pendulum.yaml", *options.split(), "--set", "simulation.rotations=euler-angles")
    assert done.returncode == 2
    for part in (
        "'penalty' does not go with `coordinates: independent`",
        "'euler-angles' are rotation coordinates of `formulation: lagrange`",
        "'geometric' scales velocities to conserve energy, and turn prescribes",
        "`tolerance` has no effect here",
        "4 faults",
    ):
        assert part in done.stderr
    assert "compiling" not in done.stderr


def test_settings_of_other_methods_may_rest_in_the_file(folder):
    text = PENDULUM.replace(
        "step: 1 ms",
        "step: 1 ms, integrator: rk4, tolerance: 1e-9, largest_step: 1 ms, penalty: {omega: 10}, cut: [hinge]",
    )
    (folder / "pendulum.yaml").write_text(text)
    done = nivel(folder, "run", "pendulum.yaml", "--no-report", "--coordinates", "absolute")
    assert done.returncode == 0, done.stderr
    assert "tolerance" not in Result.open(folder / "pendulum.nc").settings


def test_another_formulation_leaves_the_rotation_coordinates_of_lagrange_behind(folder):
    text = PENDULUM.replace("step: 1 ms", "step: 1 ms, formulation: lagrange, rotations: euler-angles")
    (folder / "pendulum.yaml").write_text(text)
    done = nivel(folder, "run", "pendulum.yaml", "--no-report", "--formulation", "newton-euler")
    assert done.returncode == 0, done.stderr


def test_help_lists_every_word_of_every_method(folder):
    shown = " ".join(process(folder, "run", "--help").stdout.split())
    for setting in ("integrator", "formulation", "coordinates", "rotations", "stabilisation"):
        for word in known_words(setting):
            assert re.search(rf"[ :]{word}[,.]", shown), word


def test_faults_of_the_assembly_have_their_line(folder):
    by_point = "bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]"
    far = "  far: {type: spherical, markers: [{body: ground, position: [5, 0, 0]}, {body: bar}]}\n"
    text = PENDULUM.replace(by_point, "markers: [{body: ground}, {body: bar}]").replace("joints:\n", f"joints:\n{far}")
    (folder / "open.yaml").write_text(text)
    done = nivel(folder, "check", "open.yaml")
    assert done.returncode == 2
    assert "open.yaml:7:" in done.stderr
    assert "joints.far" in done.stderr
    assert "far.s.x is open by 4.5 m" in done.stderr


def test_failed_computation_ends_with_code_three_and_a_readable_result(folder):
    text = PENDULUM + 'forces:\n  burst: {type: torque, body: bar, vector: [0, 0, "log(0.5 - time)"]}\n'
    (folder / "burst.yaml").write_text(text)
    done = nivel(folder, "run", "burst.yaml", "--no-report")
    assert done.returncode == 3, done.stderr
    assert "the force burst is not a number at t = 0.5" in done.stderr
    result = Result.open(folder / "pendulum.nc")
    assert result.outcome == "failed"
    assert 0.45 < result.time[-1] < 0.5
    assert result.trust.verdict == "red"


def start_long_run(folder):
    command = [sys.executable, "-m", "nivel", "run", "pendulum.yaml", "--duration", "20000", "--output-interval", "0.1"]
    running = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    path = folder / "pendulum.nc"
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        time.sleep(0.2)
        assert running.poll() is None, running.communicate()
        if path.exists():
            try:
                if len(Result.open(path).time) > 100:
                    return running, path
            except Exception:
                continue
    running.kill()
    raise AssertionError("the run did not start")


@pytest.mark.skipif(os.name == "nt", reason="POSIX signals")
def test_interruption_keeps_what_was_computed(folder):
    running, path = start_long_run(folder)
    running.send_signal(signal.SIGINT)
    _, errors = running.communicate(timeout=PATIENCE)
    assert running.returncode == 130, errors
    result = Result.open(path)
    assert result.outcome == "interrupted"
    assert len(result.time) > 100
    assert "Traceback" not in errors


@pytest.mark.skipif(os.name == "nt", reason="POSIX signals")
def test_killed_run_leaves_a_readable_result(folder):
    running, path = start_long_run(folder)
    running.kill()
    running.communicate(timeout=PATIENCE)
    result = Result.open(path)
    assert result.outcome == "running"
    assert len(result.time) > 100
    assert result.array("bar.position").shape == (len(result.time), 3)
    explained = nivel(folder, "explain", path)
    assert "Traceback" not in explained.stderr


def test_result_holds_the_machine_it_came_from(folder):
    nivel(folder, "run", "pendulum.yaml", "--no-report")
    result = Result.open(folder / "pendulum.nc")
    assert result.attributes["machine_source"] == PENDULUM
    assert {body["name"] for body in result.scene["bodies"]} == {"bar"}
    assert result.scene["joints"][0]["points"] == [[0.0, 0.0, 0.0], [-0.5, 0.0, 0.0]]


def test_a_tiny_machine_is_not_green_because_it_is_tiny(folder):
    tiny = """\
format: 1
gravity: [0, -9.81, 0]
bodies:
  a: {mass: 1e-15, inertia: [1e-28, 1e-28, 1e-28], position: [1 um, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, a], point: [0, 0, 0], axis: [0, 0, 1]}
simulation: {duration: 100 ms, step: 0.5 ms, output_interval: 1 ms, integrator: rk4}
"""
    (folder / "tiny.yaml").write_text(tiny)
    done = nivel(folder, "run", "tiny.yaml", "--no-report")
    assert done.returncode == 0, done.stderr
    trust = Result.open(folder / "tiny.nc").trust
    assert trust.verdict == "red"
    assert trust.size == pytest.approx(1e-6)


def test_many_moved_bodies_are_one_line_with_the_reason(folder):
    rods = "".join(f"  bar_{k}: {{mass: 1, inertia: [0.001, 0.08, 0.08], position: [0.5, {k}, 0]}}\n" for k in range(5))
    hinge = (
        "{type: revolute, bodies: [ground, bar_%d], point: [0, %d, 0], axis: [0, 0, 1], "
        "start: {angle: %d deg}, start_rates: {angle: 1}}"
    )
    joints = "".join(f"  hinge_{k}: {hinge % (k, k, 10 * k + 10)}\n" for k in range(5))
    text = f"format: 1\nbodies:\n{rods}joints:\n{joints}simulation: {{duration: 0.01, step: 1 ms}}\n"
    (folder / "bars.yaml").write_text(text, encoding="utf-8")
    said = " ".join(nivel(folder, "run", "bars.yaml", "--no-verify", "--no-report").stderr.split())
    # a bar of 1 m whose middle goes by the chord 2 · 0.5 m · sin 25°
    assert (
        "assembly: 5 bodies were moved to reach the start values of joints; the largest change is that of bar_4, 0.423 m and 50 deg"
        in said
    )
    assert "velocities that are not given follow from the joints and the masses (least kinetic energy): bar_0" in said
