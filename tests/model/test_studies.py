"""Studies: outputs are what closed forms say, nothing that a variant does takes others with it, and interruptions leave no trace."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray

import nivel
from nivel.analysis.sweep import sweep as sweeping
from nivel.analysis.sweep.outputs import Task
from nivel.analysis.sweep.sweep import Engine
from nivel.analysis.sweep.variant import run_variant
from nivel.errors import ModelError
from nivel.machine.study.study_record import StudyRecord
from nivel.studies import load_study
from patience import PATIENCE

MACHINE = """
format: 1
parameters: {stiffness: 100 N/m}
bodies: {block: {mass: 1, inertia: [1, 1, 1]}}
joints:
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 10 cm}}
forces:
  spring: {type: joint-spring-damper, coordinate: rail.displacement, stiffness: stiffness}
events: {middle: {when: rail.displacement, direction: falling}}
simulation: {duration: 0.5, step: 1 ms, output_interval: 1 ms}
"""
DRIVEN = """
format: 1
parameters: {speed: 2 rad/s}
bodies: {arm: {mass: 3, inertia: [1, 1, 1], position: [0.5, 0, 0]}}
joints: {pin: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}}
drivers: {turn: {coordinate: pin.angle, value: speed*time}}
gravity: [0, -10, 0]
simulation: {duration: 1}
"""
CODE = '''
import json
import os
import signal
import time


def risky(result):
    """x(0.1 s), of variants that do not end their process, raise, or wait."""
    mass = json.loads(result.attributes["machine_record"])["bodies"][0]["mass"]
    if mass == 7:
        os.kill(os.getpid(), signal.SIGKILL)
    if mass == 11:
        raise ValueError("no luck")
    if mass == 50:
        time.sleep(600)
    return result.array("rail.displacement")[100]
'''


@pytest.fixture(scope="module")
def spring(tmp_path_factory):
    folder = tmp_path_factory.mktemp("study")
    (folder / "machine.yaml").write_text(MACHINE, encoding="utf-8")
    (folder / "code.py").write_text(CODE, encoding="utf-8")
    return folder


def outputs(**given):
    return StudyRecord(machine="a", outputs=given).outputs


def of_run(machine, **given):
    return {name: each.value for name, each in run_variant(Task(machine, outputs=outputs(**given)), {}).outputs.items()}


def test_reductions_of_a_history_are_their_closed_forms(spring):
    """x = 0.1 cos(10 t) for 0.5 s."""
    machine = nivel.load(spring / "machine.yaml")
    x = {"of": "rail.displacement"}
    found = of_run(
        machine,
        largest={"type": "max", **x},
        smallest={"type": "min", **x},
        peak={"type": "peak", **x, "from": "0.1 s", "to": "0.25 s"},
        rms={"type": "rms", **x},
        mean={"type": "mean", **x, "from": 0.10025, "to": 0.3},
        integral={"type": "integral", **x},
        final={"type": "final", **x},
        at={"type": "at-time", "time": "0.2 s", **x},
        speed={"type": "at-event", "event": "middle", "of": "rail.displacement.rate"},
        event={"type": "event-time", "event": "middle"},
        never={"type": "event-time", "event": "middl"},
    )
    integral = 0.01 * np.sin(5.0)
    assert found == pytest.approx(
        {
            "largest": 0.1,
            "smallest": 0.1 * np.cos(np.pi),
            "peak": 0.1 * abs(np.cos(2.5)),
            "rms": 0.1 * np.sqrt(0.5 + np.sin(10.0) / 20.0),
            "mean": 0.01 * (np.sin(3.0) - np.sin(1.0025)) / (0.3 - 0.10025),
            "integral": integral,
            "final": 0.1 * np.cos(5.0),
            "at": 0.1 * np.cos(2.0),
            "speed": -1.0,
            "event": np.pi / 20.0,
            "never": np.nan,
        },
        abs=5e-6,
        nan_ok=True,
    )


def test_every_analysis_gives_numbers(spring, tmp_path):
    """A mass on a spring, and one that is turned about a pin: F = k x, ω = √(k/m)/2π, m ω² r."""
    machine = nivel.load(spring / "machine.yaml").with_values({"forces.spring.free_value": "2 cm"})
    rest = Task(machine, "statics", {"duration": 0}, outputs(x={"type": "final", "of": "rail.displacement"}))
    assert run_variant(rest, {}).outputs["x"].value == pytest.approx(0.02, abs=1e-9)
    modes = outputs(
        f={"type": "value", "of": "mode.1.frequency"},
        stable={"type": "value", "of": "stable"},
        other={"type": "value", "of": "mode.2.frequency"},
    )
    found = run_variant(Task(machine, "linearise", {"about": "equilibrium"}, modes), {"block.mass": 4}).outputs
    assert found["f"][:2] == (pytest.approx(5.0 / (2 * np.pi), rel=1e-9), "Hz")
    assert found["stable"].value == 1.0
    assert np.isnan(found["other"].value)
    (tmp_path / "driven.yaml").write_text(DRIVEN, encoding="utf-8")
    driven = nivel.load(tmp_path / "driven.yaml")
    load = outputs(x={"type": "max", "of": "pin.force.x"})
    found = run_variant(Task(driven, "kinematics", {"positions": 11}, load), {"parameters.speed": "4 rad/s"}).outputs
    assert found["x"][:2] == (pytest.approx(3 * 16 * 0.5, rel=1e-9), "N")
    effort = outputs(t={"type": "max", "of": "pin.angle.effort"})
    found = run_variant(Task(driven, "inverse", {"positions": 11}, effort), {"arm.mass": 2}).outputs
    assert found["t"][:2] == (pytest.approx(2 * 10 * 0.5, rel=1e-9), "N m")


@pytest.mark.parametrize(
    ("output", "path", "message"),
    [
        ({"type": "max", "of": "rail.displacment"}, "outputs.a.of", "did you mean `rail.displacement`"),
        ({"type": "max", "of": "block.position"}, "outputs.a.of", "write one, as block.position.x"),
        ({"type": "max", "of": "rail.displacement", "at_most": "3 N"}, "outputs.a.at_most", "the number is in m"),
        ({"type": "value", "of": "mode.1.frequency"}, "outputs.a.of", "`type: value` is for linear models"),
        ({"type": "python", "source": "def f(r): return 1", "function": "g"}, "outputs.a.function", "`g` is not known"),
    ],
)
def test_outputs_that_do_not_fit_the_result_are_told(spring, output, path, message):
    with pytest.raises(ModelError) as error:
        of_run(nivel.load(spring / "machine.yaml"), a=output)
    assert error.value.faults[0].path == path
    assert message in error.value.faults[0].message


def test_a_history_that_is_none_is_told_at_its_line(spring):
    path = twelve(spring, "saved.json", outputs={}, save=["rail.displacment"])
    with pytest.raises(ModelError, match=r"saved\.json:\d+:\d+: save: .*did you mean `rail.displacement`"):
        nivel.load_study(path, {"judge": False})


def twelve(folder, name, **more):
    content = {
        "format": 1,
        "machine": "machine.yaml",
        "parameters": {"block.mass": {"type": "range", "from": 1, "to": 12, "count": 12}},
        "outputs": {"x": {"type": "python", "python": "code.py", "function": "risky", "units": "m"}},
        **more,
    }
    (folder / name).write_text(json.dumps(content), encoding="utf-8")
    return folder / name


def check_twelve(found):
    outcome = found["outcome"].values.tolist()
    assert outcome.count("done") == 10
    assert (outcome[6], outcome[10]) == ("killed", "failed")
    assert "SIGKILL" in str(found["reason"].values[6])
    assert str(found["reason"].values[10]) == "output x: ValueError: no luck"
    done = found.where(found["outcome"] == "done", drop=True)
    expected = 0.1 * np.cos(np.sqrt(100 / done["block.mass"]) * 0.1)
    np.testing.assert_allclose(done["x"], expected, atol=1e-9)


def test_a_function_that_raises_leaves_the_other_outputs_and_variants(spring):
    """x(0.5 s) = 0.1 cos(√(k/m) t)."""
    outputs = {
        "x": {"type": "python", "python": "code.py", "function": "risky", "units": "m"},
        "end": {"type": "final", "of": "rail.displacement"},
    }
    parameters = {"block.mass": {"values": [10, 11, 12]}}
    path = twelve(spring, "raising.yaml", outputs=outputs, parameters=parameters)
    found = load_study(path, allow_code=True).sweep(workers=1)
    assert found["outcome"].values.tolist() == ["done", "failed", "done"]
    assert str(found["reason"].values[1]) == "output x: ValueError: no luck"
    assert np.isfinite(found["x"]).values.tolist() == [True, False, True]
    np.testing.assert_allclose(found["end"], 0.1 * np.cos(5 / np.sqrt(found["block.mass"])), atol=1e-9)


def twelve_on_a_cluster(spring, threads):
    distributed = pytest.importorskip("distributed")
    study = load_study(twelve(spring, "twelve.yaml", time_limit="10 min"), allow_code=True)
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=threads, dashboard_address=None, processes=False
    ) as cluster:
        found = study.sweep(scheduler=cluster.scheduler_address, out=spring / f"there-{threads}.nc")
    check_twelve(found)
    return study


def test_one_variant_that_kills_its_process_and_one_that_raises_leave_ten_results_on_a_cluster(spring):
    twelve_on_a_cluster(spring, 1)


@pytest.mark.full
def test_they_leave_the_same_ten_results_here(spring):
    study = twelve_on_a_cluster(spring, 2)
    check_twelve(study.sweep(workers=2, out=spring / "here.nc"))
    here, there = (xarray.load_dataset(spring / name, engine="h5netcdf") for name in ("here.nc", "there-2.nc"))
    assert here.identical(there)


def test_what_takes_too_long_is_a_row(spring):
    found = load_study(twelve(spring, "slow.yaml", parameters={"block.mass": [50]}, time_limit="1 s"), allow_code=True)
    found = found.sweep(workers=1)
    assert found["outcome"].values.tolist() == ["timed out"]
    assert "time limit of 1 s" in str(found["reason"].values[0])


@pytest.mark.parametrize("kills", [1, pytest.param(10, marks=pytest.mark.full)])
def test_a_study_that_is_killed_goes_on_to_the_same_table_to_the_last_bit(spring, kills, tmp_path, monkeypatch):
    """As that of one process, which is this one. What workers had finished is read from the journal."""
    content = {
        "format": 1,
        "machine": str(spring / "machine.yaml"),
        "parameters": {
            "block.mass": {"type": "normal", "deviation": "0.1 kg"},
            "parameters.stiffness": {"type": "uniform", "from": 50, "to": "150 N/m"},
        },
        "design": "sobol",
        "samples": 32 if kills == 1 else 256,
        "outputs": {"x": {"type": "rms", "of": "rail.displacement"}},
        "save": ["rail.displacement"],
        "settings": {"output_interval": "0.1 s"},
    }
    whole, target, journal = (tmp_path / name for name in ("whole.nc", "part.nc", "part.nc.journal"))
    (tmp_path / "study.yaml").write_text(json.dumps(content), encoding="utf-8")
    monkeypatch.setattr(sweeping, "Engine", lambda *_, **__: Engine(1))
    study = load_study(tmp_path / "study.yaml")
    study.sweep(out=whole)
    random, before = np.random.default_rng(kills), 0
    command = [sys.executable, "-m", "nivel", "sweep", "study.yaml", "--out", "part.nc", "--no-report", "--quiet"]
    for _ in range(kills):
        process = subprocess.Popen([*command, "--resume", "--workers", f"{min(kills, 2)}"], cwd=tmp_path)
        wait_for(lambda least=before + 2000: journal.exists() and journal.stat().st_size > least, process)
        time.sleep(0.05 * random.random())
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        before = journal.stat().st_size if journal.exists() else 0
    with journal.open("ab") as stream:  # as if it had been killed within a line
        stream.write(b'{"number": 3, "outc')
    assert not target.exists()
    study.sweep(out=target, resume=True)
    assert not journal.exists()
    first, second = (xarray.load_dataset(name, engine="h5netcdf") for name in (whole, target))
    assert first.identical(second)


def wait_for(came, process):
    end = time.monotonic() + PATIENCE
    while not came() and process.poll() is None and time.monotonic() < end:
        time.sleep(0.01)


def test_a_journal_of_another_study_is_refused(spring, tmp_path):
    study = load_study(twelve(spring, "other.yaml"), allow_code=True)
    journal = tmp_path / "a.nc.journal"
    journal.write_text('{"format": 1, "nivel": "0", "study": "0"}\n', encoding="utf-8")
    with pytest.raises(ModelError, match="has 0 of 12 variants of an interrupted study: go on with --resume"):
        study.sweep(out=tmp_path / "a.nc")
    with pytest.raises(ModelError, match="journal of another study"):
        study.sweep(out=tmp_path / "a.nc", resume=True)


def test_a_cluster_that_does_not_answer_is_told(spring):
    pytest.importorskip("distributed")
    study = load_study(twelve(spring, "lost.yaml"), allow_code=True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("nivel.analysis.sweep.processes.PATIENCE", "200 ms")
        with pytest.raises(ModelError, match="start one with `dask scheduler`"):
            study.sweep(scheduler="tcp://127.0.0.1:9")
    assert Path(study.file.file).exists()


@pytest.mark.full
def test_a_worker_of_a_cluster_that_dies_takes_no_other_variants_with_it(spring):
    """One variant ends its process, and the worker of Dask that started it."""
    distributed = pytest.importorskip("distributed")
    code = CODE.replace("os.kill(os.getpid()", "os.kill(os.getppid()")
    (spring / "worse.py").write_text(code, encoding="utf-8")
    output = {"x": {"type": "python", "python": "worse.py", "function": "risky"}}
    study = load_study(twelve(spring, "worse.yaml", outputs=output), allow_code=True)
    with (
        distributed.dask.config.set({"distributed.scheduler.allowed-failures": 0}),
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
    ):
        found = study.sweep(scheduler=cluster.scheduler_address)
    outcome = found["outcome"].values.tolist()
    assert outcome.count("done") == 10
    assert (outcome[6], outcome[10]) == ("killed", "failed")
    assert "worker of Dask" in str(found["reason"].values[6])


def test_variants_without_trust_reports_have_the_same_numbers_in_any_process(spring, monkeypatch):
    """x(0.5 s) = 0.1 cos(√(k/m) t)."""
    content = {
        "format": 1,
        "machine": "machine.yaml",
        "parameters": {"block.mass": {"type": "range", "from": 1, "to": 2, "count": 24}},
        "outputs": {"x": {"type": "final", "of": "rail.displacement"}},
        "judge": False,
    }
    (spring / "plain.yaml").write_text(json.dumps(content), encoding="utf-8")
    study = load_study(spring / "plain.yaml")
    there = study.sweep(workers=1)
    monkeypatch.setattr(sweeping, "Engine", lambda *_, **__: Engine(1))
    here = study.sweep()
    np.testing.assert_allclose(here["x"], 0.1 * np.cos(5 / np.sqrt(here["block.mass"])), atol=1e-9)
    np.testing.assert_array_equal(here["x"], there["x"])
    assert here.attrs["verdict"] == "not verified"
    content["outputs"]["x"] = {"type": "event-time", "event": "middle"}
    (spring / "plain.yaml").write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(ModelError, match="which `event-time` needs"):
        load_study(spring / "plain.yaml")
