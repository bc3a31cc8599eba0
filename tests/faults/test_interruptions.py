"""Interruptions: of what is killed, stopped by Ctrl-C or meets a full disk, only the work in flight is computed again. Work is counted."""

import ast
import json
import os
import pickle
import resource
import signal
import subprocess
import sys
import time
import warnings
from functools import partial
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import xarray
from click.testing import CliRunner

import nivel
from lanes import tail
from nivel.analysis.progress.journal import Journal, count_finished
from nivel.cli import main
from nivel.errors import ModelError, SolveError
from nivel.files.target import write_file, written
from nivel.flexible.body.body_file import read_body
from nivel.studies import load_study
from patience import PATIENCE

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="processes that end anywhere")
MACHINE = """
format: 1
bodies: {block: {mass: 2 kg, inertia: [1, 1, 1]}}
joints:
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 10 cm}}
forces:
  spring: {type: joint-spring-damper, coordinate: rail, stiffness: 50 N/m, damping: 4 N s/m}
simulation: {duration: 0.2 s, step: 2 ms, output_interval: 20 ms, integrator: rk4}
"""
STUDY = """
format: 1
machine: machine.yaml
parameters:
  forces.spring.stiffness: {type: range, from: 20 N/m, to: 200 N/m, count: 8}
outputs: {speed: {type: rms, of: rail.displacement.rate}}
save: [rail.displacement]
judge: false
"""
SEARCH = STUDY.replace(", count: 8", "").replace("save: [rail.displacement]\njudge: false\n", "")
# command, and the function that does a unit of its work
COMMANDS = {
    "sweep": ("nivel.analysis.sweep.variant", "run_variant"),
    "optimise": ("nivel.analysis.optimise.evaluations", "Evaluations._run"),
    "identify": ("nivel.analysis.optimise.evaluations", "Evaluations._run"),
    "compare": ("nivel.analysis.compare.compare", "_Bench.add"),
}
WORDS = {
    "sweep": ["study.yaml", "--workers", "1", "--out", "found.nc"],
    "optimise": ["best.yaml", "--threads", "1", "--out", "found.nc"],
    "identify": ["bench.yaml", "--threads", "1", "--out", "found.nc"],
    "compare": [
        "machine.yaml",
        "--integrators",
        "euler,heun,rk4",
        "--steps",
        "2ms,4ms",
        "--repeat",
        "1",
        "--out",
        "found.json",
    ],
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "machine.yaml").write_text(MACHINE)
    (tmp_path / "study.yaml").write_text(STUDY)
    (tmp_path / "best.yaml").write_text(SEARCH + "optimise: {output: speed, method: Nelder-Mead, iterations: 8}\n")
    t = np.linspace(0.0, 0.2, 11)
    rows = "".join(f"{a!r},{b!r}\n" for a, b in zip(t.tolist(), (0.1 * np.cos(7.0 * t)).tolist(), strict=True))
    (tmp_path / "bench.csv").write_text("time [s],rail.displacement [m]\n" + rows)
    (tmp_path / "bench.yaml").write_text(SEARCH + "identify: {data: bench.csv, iterations: 6}\n")
    return tmp_path


def session(command, *words, end=("", 0)):
    """Run a command in a process; returns exit code, number of units of work begun, and what it said. end : what happens to it, as which
    unit begins."""
    Path("work").write_text("")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # threads of the tests are not needed there
        child = os.fork()
    if child:
        status = os.waitpid(child, 0)[1]
        return os.waitstatus_to_exitcode(status), len(Path("work").read_text()), Path("said").read_text()
    try:
        sys.dont_write_bytecode = True  # Python keeps byte code that the limit of files has cut off
        said = os.open("said", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(said, 1)
        os.dup2(said, 2)
        sys.stdout, sys.stderr = (os.fdopen(number, "w", closefd=False) for number in (1, 2))
        signal.signal(signal.SIGINT, signal.default_int_handler)
        count_work(*COMMANDS[command], end)
        main([command, *WORDS[command], "--no-report", *words])
    except SystemExit as done:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(int(done.code or 0))
    except BaseException:
        sys.excepthook(*sys.exc_info())
        sys.stderr.flush()
    os._exit(99)


def count_work(module, path, end):
    """Write a letter for each unit of work, and let one of them end the process, or fill the disk."""
    from nivel.analysis.sweep import sweep as sweeping

    if end[0] == "no room":
        resource.setrlimit(resource.RLIMIT_FSIZE, (end[1], resource.RLIM_INFINITY))
    engine, begun = sweeping.Engine, 0
    sweeping.Engine = lambda *_, **__: engine(1)  # in this process
    place, name = import_module(module), path.rpartition(".")
    owner = getattr(place, name[0]) if name[0] else place
    function, (how, last) = getattr(owner, name[2]), end

    def counted(*given):
        nonlocal begun
        begun += 1
        with open("work", "a") as file:
            file.write(".")
        if begun == last and how == "kill":
            os.kill(os.getpid(), signal.SIGKILL)
        if begun == last and how == "Ctrl-C":
            signal.raise_signal(signal.SIGINT)
        if begun == last and how == "full":
            size = max(each.stat().st_size for each in Path.cwd().glob("*.journal"))
            resource.setrlimit(resource.RLIMIT_FSIZE, (size + 20, resource.RLIM_INFINITY))
        return function(*given)

    setattr(owner, name[2], counted)


def load_what_all_need(command):
    """Modules and machine code, so that no process has to."""
    done = CliRunner().invoke(main, [command, *WORDS[command], "--no-report", "--quiet"])
    assert done.exit_code == 0, done.output
    Path(WORDS[command][-1]).unlink()


def same(command, first, second):
    if command != "compare":
        one, other = (xarray.load_dataset(name, engine="h5netcdf") for name in (first, second))
        for each in (one, other):
            each.attrs = {name: value for name, value in each.attrs.items() if name not in ("seconds", "trust")}
        return one.identical(other)
    times = ("loop_seconds", "seconds_per_step")
    one, other = (json.loads(Path(name).read_text()) for name in (first, second))
    for each in (*one["rows"], *other["rows"]):
        each.update(dict.fromkeys(times, 0))
    return one == other


@pytest.mark.parametrize(
    "command", ["sweep", *(pytest.param(each, marks=pytest.mark.full) for each in ("optimise", "identify", "compare"))]
)
def test_of_what_is_interrupted_only_the_work_in_flight_is_computed_again(command, folder):
    load_what_all_need(command)
    code, work, said = session(command)
    assert code == 0, said
    target = Path(WORDS[command][-1])
    target.rename(f"whole-{target.name}")
    total, journal = work, Path(f"{target.name}.journal")
    assert total > 5
    done = rows = 0
    ends = [(("kill", 3), -signal.SIGKILL), (("full", 1), 3), (("Ctrl-C", 2), 130), (("kill", 1), -signal.SIGKILL)]
    for number, (end, expected) in enumerate(ends):
        code, work, said = session(command, *(["--resume"] if number else []), end=end)
        assert code == expected, said
        done += work
        assert "Traceback" not in said
        assert journal.exists()
        assert count_finished(journal) >= rows
        rows = count_finished(journal)
        if expected == 3:
            assert said.count("cannot be written further: file too large") == 1
        if expected == 130:
            assert "go on with --resume" in said
    assert rows > 0
    refused = session(command)
    assert (refused[0], refused[1]) == (2, 0)
    assert ("exists already" if command == "compare" else "go on with --resume, or begin anew") in refused[2]
    code, work, said = session(command, "--resume")
    assert code == 0, said
    assert total <= done + work <= total + len(ends)
    assert not journal.exists()
    assert same(command, f"whole-{target.name}", target.name)
    again = session(command, "--resume")
    assert (again[0], again[1]) == (0, 0)
    assert "nothing is left to compute" in again[2]
    assert not list(folder.glob(".*.part"))


def test_a_data_file_for_which_there_is_no_room_costs_no_work(folder):
    """The journal is removed when the data file is on the disk, not before."""
    assert session("sweep")[1] == 8
    size = Path("found.nc").stat().st_size
    Path("found.nc").unlink()
    code, _, said = session("sweep", "--quiet", end=("no room", size - 1))
    assert code == 2
    assert said.strip() == "the data file found.nc cannot be written: file too large"
    assert count_finished(Path("found.nc.journal")) == 8
    assert not Path("found.nc").exists()
    assert session("sweep", "--resume")[:2] == (0, 0)
    assert Path("found.nc").exists()


@pytest.mark.parametrize("words", [("--fmu", "m.fmu"), pytest.param(("--c", "lib"), marks=pytest.mark.full)])
def test_an_export_that_is_cut_off_leaves_nothing(words, folder):
    """Where the disk is full, soon or later, in one sentence."""
    command, whole = [sys.executable, "-B", "-m", "nivel", "export", "machine.yaml", *words], Path(words[1])
    nivel.load("machine.yaml").simulate(verify=False)  # its machine code is on the disk
    for size in (100, 9_000):
        limits = (size, resource.RLIM_INFINITY)
        limited = partial(resource.setrlimit, resource.RLIMIT_FSIZE, limits)
        done = subprocess.run(command, preexec_fn=limited, capture_output=True, text=True, check=False)
        assert done.returncode == 2, done.stderr
        assert done.stderr.count("cannot be written: file too large") == 1
        assert "Traceback" not in done.stderr
        assert not whole.exists()
        assert not list(folder.glob(".*.part"))


def test_what_is_written_is_whole_or_as_it_was(tmp_path):
    target = tmp_path / "table.csv"
    write_file(target, "table", "first")
    target.chmod(0o640)

    def write(problem):
        with written(target, "table") as draft:
            draft.write_text("half")
            raise problem

    with pytest.raises(KeyboardInterrupt):
        write(KeyboardInterrupt())
    with pytest.raises(ModelError, match=r"the table .* cannot be written: no space left on device"):
        write(OSError(28, "x"))
    assert target.read_text() == "first"
    link = tmp_path / "link.csv"
    link.symlink_to(target)
    write_file(link, "table", "second")
    assert link.is_symlink()
    assert target.read_text() == "second"
    assert target.stat().st_mode & 0o777 == 0o640
    assert {each.name for each in tmp_path.iterdir()} == {"table.csv", "link.csv"}


# where files are written into folders that are new, or journals, whose end may be cut
WRITERS = {
    "native/store.py", "files/target.py", "analysis/progress/journal.py", "analysis/sweep/processes.py", "live/recording.py",
    "fmu/writer.py", "files/fmu_file.py", "files/convex_parts.py", "system/signals/c_instance.py", "view/capture.py",
    "view/typescript.py", "exchange/freecad.py",
}  # fmt: skip


def test_every_file_is_written_by_one_writer():
    """Nothing opens a file for writing, or lets a library do so, outside a block of `written` or `whole`."""
    source = Path(nivel.__file__).parent
    found = set()
    for path in source.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        if any(word in text for word in ("open(", "write_text(", "write_bytes(", "to_netcdf(", "savefig(")):
            calls = [each for each in ast.walk(ast.parse(text)) if isinstance(each, ast.Call)]
            found |= {path.relative_to(source).as_posix() for call in calls if is_writing(call)}
    assert found <= WRITERS, found - WRITERS


def is_writing(call):
    function = call.func
    name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
    holder = function.value if isinstance(function, ast.Attribute) else None
    if holder is None and name != "open":
        return False
    if name in ("write_text", "write_bytes", "to_netcdf", "savefig"):
        return not (isinstance(holder, ast.Name) and holder.id in ("draft", "figure")) and bool(call.args)
    modes = [each.value for each in call.args if isinstance(each, ast.Constant) and isinstance(each.value, str)]
    in_draft = isinstance(holder, ast.Name) and holder.id in ("draft", "archive")
    return name == "open" and any(set(mode) & set("wax") and len(mode) < 4 for mode in modes) and not in_draft


def test_a_journal_has_one_writer_and_says_when_it_is_of_another_study(tmp_path):
    journal = Journal(tmp_path / "a.nc", "1")
    journal.add({"x": 1.0})
    with pytest.raises(ModelError, match="another process goes on with"):
        Journal(tmp_path / "a.nc", "1")
    journal.close()
    with journal.path.open("ab") as file:
        file.write(b'{"number": 1, "x"')
    again = Journal(tmp_path / "a.nc", "1")
    assert again.rows == {0: {"x": 1.0}}
    again.add({"x": 2.0})
    again.close()
    assert count_finished(journal.path) == 2
    with pytest.raises(ModelError, match="journal of another study"):
        Journal(tmp_path / "a.nc", "2")
    journal.path.write_text("")  # killed at once
    last = Journal(tmp_path / "a.nc", "2")
    assert last.rows == {}
    last.close()


@pytest.mark.full
@pytest.mark.parametrize("command", COMMANDS)
def test_after_thirty_kills_at_random_places_the_table_is_that_of_one_run(command, folder):
    words = [sys.executable, "-m", "nivel", command, *WORDS[command], "--no-report", "--quiet"]
    begin = time.monotonic()
    subprocess.run(words, check=True, capture_output=True)
    took, target = time.monotonic() - begin, Path(WORDS[command][-1])
    target.rename(f"whole-{target.name}")
    random, journal = np.random.default_rng(0), Path(f"{target.name}.journal")
    for _ in range(30):
        process = subprocess.Popen([*words, "--resume"], stderr=subprocess.PIPE, text=True)
        time.sleep(took * random.random())
        process.kill()
        assert "Traceback" not in process.communicate()[1]
        if target.exists() and not journal.exists():
            break
    done = subprocess.run([*words, "--resume"], check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert same(command, f"whole-{target.name}", target.name)


TOYS = """
import sys
sys.path.insert(0, {folder!r})
import toy_entries as toys
from nivel.analysis.plan import compilation
from nivel.cli import main
compilation.all_entries = lambda: [toys.squares, toys.sine, toys.twice, toys.scale, toys.fill, toys.made]
main(["warmup"])
"""


@pytest.mark.parametrize("finished", tail(range(6), [2]))
def test_after_a_kill_warmup_compiles_what_was_not_finished(finished, tmp_path):
    """The process and its workers end as so many of six entries are there."""
    code = TOYS.format(folder=str(Path(__file__).parents[1] / "native"))
    words = [sys.executable, "-c", code]
    surroundings = os.environ | {"NIVEL_CACHE_DIR": str(tmp_path)}
    process = subprocess.Popen(words, env=surroundings, stderr=subprocess.PIPE, text=True, start_new_session=True)
    until = time.monotonic() + PATIENCE
    while len(list(tmp_path.glob("objects/*.o"))) < finished and process.poll() is None and time.monotonic() < until:
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGKILL)
    assert "Traceback" not in process.communicate()[1]
    kept = {path: path.read_bytes() for path in tmp_path.glob("objects/*.o")}
    again = subprocess.run(words, env=surroundings, capture_output=True, text=True, check=True)
    assert f"{6 - len(kept)} of 6 entries compiled" in again.stderr
    assert "damaged" not in again.stderr
    assert all(path.read_bytes() == content for path, content in kept.items())


@pytest.mark.parametrize("number", tail(range(30), [0]))
def test_a_reduction_that_is_killed_leaves_a_whole_body_or_none(number, tmp_path):
    """At random places; what is there after that is the body of one run."""

    def content(name):
        return pickle.dumps(read_body(tmp_path / name))

    model = Path(__file__).parents[2] / "examples" / "flexible" / "pendulum-bar.yaml"
    words = [sys.executable, "-m", "nivel", "reduce", str(model), "--no-report", "--quiet", "--force", "-o"]
    begin = time.monotonic()
    subprocess.run([*words, tmp_path / "whole.nc"], check=True)
    took = time.monotonic() - begin
    process = subprocess.Popen([*words, tmp_path / "bar.nc"], stderr=subprocess.PIPE, text=True)
    time.sleep(took * np.random.default_rng(number).uniform(0.5, 1.1))
    process.kill()
    assert "Traceback" not in process.communicate()[1]
    found = sorted(path.name for path in tmp_path.iterdir() if not path.name.startswith("."))
    assert all(content(name) == content("whole.nc") for name in found)
    subprocess.run([*words, tmp_path / "bar.nc"], check=True)
    assert content("bar.nc") == content("whole.nc")


def test_a_search_that_goes_on_in_python_computes_nothing_twice(folder, monkeypatch):
    from nivel.analysis.optimise.evaluations import Evaluations

    count, run = [], Evaluations._run

    def stopped(self, z):
        count.append(z)
        if len(count) == 4:
            raise SolveError("power failed", time=0.0)
        return run(self, z)

    monkeypatch.setattr(Evaluations, "_run", stopped)
    study = load_study("best.yaml")
    with pytest.raises(SolveError):
        study.optimise(out="a.nc", threads=1)
    found = study.optimise(out="a.nc", threads=1, resume=True)
    assert len(count) == found.evaluations + 1
    assert float(xarray.load_dataset("a.nc", engine="h5netcdf").attrs["objective"]) == found.objective
    assert found.dataset["speed"].attrs["units"] == "m/s"


def test_workers_end_with_the_process_that_started_them(tmp_path):
    """Also where they compute for ever: the pipe is closed when both have ended."""
    (tmp_path / "endless.py").write_text("def main():\n    while True:\n        pass\n")
    text = (
        f"import sys, subprocess, time; sys.path.append({str(tmp_path)!r}); from nivel.native.workers import python\n"
        "subprocess.Popen(python('endless')); print('begun', flush=True); time.sleep(600)"
    )
    parent = subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True)
    assert parent.stdout.readline() == "begun\n"
    parent.kill()
    assert parent.communicate(timeout=60)[0] == ""
