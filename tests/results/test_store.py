"""A result file is complete up to its last block at every moment of its life."""

import json
import os
import re
import resource
import signal
import subprocess
import sys
import textwrap
from contextlib import suppress
from pathlib import Path

import h5py
import numpy as np
import pytest

import synthetic_run as pendulum
from nivel.errors import ModelError, SolveError
from nivel.results import Memory, Result, Store
from nivel.results.store import rewrite

pytestmark = pytest.mark.covering

TIME = np.linspace(0.0, 8.0, 801)
WRITER = """
    import sys
    sys.path.insert(0, {tests!r})
    import numpy as np
    import synthetic_run as pendulum
    from nivel.results import Store

    frames = pendulum.frames(np.linspace(0.0, 8.0, 801))
    store = Store({path!r})
    store.begin(pendulum.header())
    for k in range(0, 801, 10):
        store.take(frames[k : k + 10])
        print(k, flush=True)
        sys.stdin.readline()
"""


@pytest.fixture
def writer(tmp_path):
    """A process that writes ten frames for each line it is given, and the file it writes."""
    path = tmp_path / "run.nc"
    code = textwrap.dedent(WRITER).format(path=str(path), tests=str(Path(__file__).parents[1]))
    process = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    with process:
        yield process, path
        process.kill()


def advance(process, blocks):
    for _ in range(blocks):
        assert process.stdout.readline()
        process.stdin.write("\n")
        process.stdin.flush()
    assert process.stdout.readline()  # one block more is on the disk, and the writer waits


def stored(path, take=100, count=801, **attributes):
    store = Store(path)
    store.begin(pendulum.header())
    frames = pendulum.frames(TIME)[:count]
    for start in range(0, len(frames), take):
        store.take(frames[start : start + take])
    return store.close({"outcome": "done", **attributes})


def assert_same_numbers(result, count=801):
    assert len(result.time) == count
    np.testing.assert_array_equal(result.time, TIME[:count])
    for name, values in pendulum.histories(TIME).items():
        np.testing.assert_array_equal(result.array(name), values[:count], err_msg=name)


def test_a_run_can_be_read_by_another_process_while_it_goes_on(writer):
    process, path = writer
    advance(process, 4)
    assert_same_numbers(Result.open(path), 50)
    process.stdin.write("\n" * 3)
    process.stdin.flush()
    for _ in range(3):
        process.stdout.readline()
    assert_same_numbers(Result.open(path), 80)
    assert Result.open(path).outcome == "running"


def test_a_killed_run_keeps_everything_up_to_its_last_block(writer):
    process, path = writer
    advance(process, 20)
    process.send_signal(signal.SIGKILL)
    process.wait()
    result = Result.open(path)
    assert_same_numbers(result, 210)
    assert result.outcome == "running"
    assert "killed" in repr(result)
    outcome = result.trust.items[0]
    assert (outcome.verdict, result.trust.verdict) == ("amber", "amber")
    assert "killed" in outcome.text
    assert result.dataset.sizes["time"] == 210


def test_a_run_killed_at_any_moment_has_whole_frames(tmp_path):
    code = textwrap.dedent(WRITER).replace("sys.stdin.readline()", "pass")
    for attempt in range(4):
        path = tmp_path / f"{attempt}.nc"
        source = code.format(path=str(path), tests=str(Path(__file__).parents[1]))
        with subprocess.Popen([sys.executable, "-c", source], stdout=subprocess.PIPE, text=True) as process:
            for _ in range(1 + 17 * attempt):
                process.stdout.readline()
            process.kill()
        result = Result.open(path)
        assert_same_numbers(result, len(result.time))
        assert len(result.time) >= 10 * (1 + 17 * attempt)


def test_memory_and_file_give_the_same_numbers_names_and_attributes(tmp_path):
    memory = Memory()
    memory.begin(pendulum.header())
    frames = pendulum.frames(TIME)
    for k in range(len(frames)):
        memory.take(frames[k : k + 1])
    from_memory = memory.close({"outcome": "done"})
    from_file = stored(tmp_path / "run.nc")
    for result in (from_memory, from_file):
        assert_same_numbers(result)
    assert from_memory.names == from_file.names
    assert from_memory.coordinates == from_file.coordinates
    assert dict(from_memory.attributes) == {k: v for k, v in from_file.attributes.items() if k != "Conventions"}


def test_memory_keeps_no_view_of_the_frames_it_was_given():
    memory = Memory()
    memory.begin(pendulum.header())
    frames = pendulum.frames(TIME)
    memory.take(frames)
    frames[:] = np.nan  # the run reuses its buffer
    assert_same_numbers(memory.close({}))


@pytest.mark.parametrize(("take", "count"), [(1, 60), (7, 300), (801, 801)])
def test_the_size_of_the_blocks_does_not_matter(tmp_path, take, count):
    assert_same_numbers(stored(tmp_path / "run.nc", take, count), count)


def test_closing_compresses_in_chunks_along_time(tmp_path):
    path = stored(tmp_path / "run.nc").path
    with h5py.File(path, "r") as file:
        position = file["position"]
        assert position.compression == "gzip"
        assert position.chunks == (801, 1, 3)
        assert position.attrs["units"] == "m"
        assert [dim[0].name for dim in position.dims] == ["/time", "/body", "/xyz"]
        assert json.loads(file.attrs["constraint_units"]) == pendulum.ROWS


def test_scales_and_variables_refer_to_each_other_as_the_standard_of_dimensions_says(tmp_path):
    """HDF5 itself calls a scale attached where both say so, DIMENSION_LIST of the variable and REFERENCE_LIST of the scale."""
    stored(tmp_path / "run.nc")
    with h5py.File(tmp_path / "run.nc", "r") as file:
        variables = [each for each in file.values() if not h5py.h5ds.is_scale(each.id)]
        assert len(variables) > 5
        for variable in variables:
            for axis, dim in enumerate(variable.dims):
                assert h5py.h5ds.get_num_scales(variable.id, axis) == 1
                assert h5py.h5ds.is_attached(variable.id, dim[0].id, axis)
        listed = sum(len(each.attrs.get("REFERENCE_LIST", ())) for each in file.values())
        assert listed == sum(each.ndim for each in variables)


def test_closing_leaves_one_file_and_replaces_it_in_one_step(tmp_path):
    path = tmp_path / "run.nc"
    store = Store(path)
    store.begin(pendulum.header())
    store.take(pendulum.frames(TIME))
    before = path.stat().st_ino
    reader = h5py.File(path, "r", swmr=True)  # somebody looks at it meanwhile
    store.close({"outcome": "done"})
    assert [each.name for each in tmp_path.iterdir()] == ["run.nc"]
    assert path.stat().st_ino != before
    assert reader["time"].shape == (801,)
    reader.close()


def test_a_rewrite_that_fails_leaves_the_file_readable(tmp_path, monkeypatch):
    store = Store(tmp_path / "run.nc")
    store.begin(pendulum.header())
    store.take(pendulum.frames(TIME))

    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(SolveError, match="could not be compressed: no space left on device") as caught:
        store.close({"outcome": "done"})
    assert caught.value.time == TIME[-1]
    assert len(caught.value.result.time) == len(TIME)
    assert [each.name for each in tmp_path.iterdir()] == ["run.nc"]
    result = Result.open(tmp_path / "run.nc")
    assert_same_numbers(result)
    assert result.outcome == "done"


def test_a_full_disk_is_said_and_what_was_written_stays(tmp_path):
    path = tmp_path / "run.nc"
    limit = 900_000  # bytes: the run needs more
    code = textwrap.dedent(WRITER).replace("sys.stdin.readline()", "pass")
    source = code.format(path=str(path), tests=str(Path(__file__).parents[1]))

    def small_disk():
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

    run = subprocess.run(
        [sys.executable, "-c", source], capture_output=True, text=True, preexec_fn=small_disk, check=False
    )
    assert run.returncode == 1
    result = Result.open(path)
    assert len(result.time) > 0
    said = f"cannot be written further: file too large; it is readable up to t = {result.time[-1]:.6g} s"
    assert f"SolveError: the result file {path} {said}" in run.stderr
    assert "--output-interval" in result.advice
    assert_same_numbers(result, len(result.time))
    assert result.outcome == "failed"
    assert "file too large" in result.failure


def test_a_frame_whose_time_is_missing_does_not_exist(tmp_path):
    path = tmp_path / "run.nc"
    store = Store(path)
    store.begin(pendulum.header())
    store.take(pendulum.frames(TIME[:100]))
    store._file.close()
    with h5py.File(path, "r+") as file:
        file["time"].resize(120, axis=0)  # as if the process had died between two writes
        file["position"].resize(130, axis=0)
    assert_same_numbers(Result.open(path), 100)
    rewrite(path, {})
    assert_same_numbers(Result.open(path), 100)


def test_nothing_is_computed_for_a_path_that_cannot_work(tmp_path):
    (tmp_path / "there.nc").touch()
    with pytest.raises(ModelError, match=r"there is no folder .*nowhere for the result file run.nc"):
        Store(tmp_path / "nowhere" / "run.nc")
    with pytest.raises(ModelError, match=r"there.nc is not a folder"):
        Store(tmp_path / "there.nc" / "run.nc")
    with pytest.raises(ModelError, match="is a folder; the name of a result file was expected"):
        Store(tmp_path)
    with pytest.raises(ModelError, match="exists already; use --force to overwrite it"):
        Store(tmp_path / "there.nc")
    assert (tmp_path / "there.nc").stat().st_size == 0
    with pytest.raises(ModelError, match="cannot be written: file name too long"):
        Store(tmp_path / f"{'x' * 300}.nc")
    with pytest.raises(ModelError, match="cannot be written: file name too long"):
        Store(tmp_path / ("x" * 300) / "run.nc")


@pytest.mark.skipif(os.name == "nt", reason="POSIX special files")
def test_force_replaces_files_only(tmp_path):
    os.mkfifo(tmp_path / "pipe.nc")
    (tmp_path / "link.nc").symlink_to("/dev/null")
    (tmp_path / "folder.nc").mkdir()
    for name, said in (("pipe", "is a pipe"), ("link", "is a device"), ("folder", "is a folder")):
        with pytest.raises(ModelError, match=said):
            Store(tmp_path / f"{name}.nc", force=True)
    assert {each.name for each in tmp_path.iterdir()} == {"pipe.nc", "link.nc", "folder.nc"}


def test_what_took_the_place_of_the_file_meanwhile_is_kept(tmp_path):
    path = tmp_path / "run.nc"
    store = Store(path, force=True)
    os.mkfifo(path)
    with pytest.raises(ModelError, match="is a pipe"):
        store.begin(pendulum.header())
    assert path.is_fifo()


def test_a_file_name_of_any_length_that_the_system_takes(tmp_path):
    assert_same_numbers(stored(tmp_path / f"{'x' * 252}.nc"))


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_one_may_not_write_into_is_said(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(ModelError, match="permission denied"):
        Store(tmp_path / "run.nc")


def test_force_replaces_an_existing_result_and_its_readers_keep_theirs(tmp_path):
    path = tmp_path / "run.nc"
    stored(path)
    with h5py.File(path, "r") as reader:
        store = Store(path, force=True)
        store.begin(pendulum.header(machine="another"))
        store.take(pendulum.frames(TIME[:5]))
        result = store.close({"outcome": "done"})
        assert reader.attrs["machine"] == "pendulum"
    assert (result.name, len(result.time)) == ("another", 5)


@pytest.mark.parametrize("how", ["take", "close"])
def test_of_two_runs_into_one_file_the_first_ends_and_leaves_it_alone(tmp_path, how):
    path = tmp_path / "run.nc"
    first = Store(path)
    first.begin(pendulum.header())
    first.take(pendulum.frames(TIME[:50]))
    second = Store(path, force=True)
    second.begin(pendulum.header(machine="second"))
    second.take(pendulum.frames(TIME[:5]))
    with pytest.raises(SolveError, match="was removed or replaced while the run went on"):
        first.take(pendulum.frames(TIME[50:])) if how == "take" else first.close({"outcome": "done"})
    result = second.close({"outcome": "done"})
    assert (result.name, len(result.time)) == ("second", 5)
    assert not list(tmp_path.glob(".*.part"))


def test_a_run_without_any_frame_gives_an_empty_result(tmp_path):
    store = Store(tmp_path / "run.nc")
    store.begin(pendulum.header())
    assert len(store.result().time) == 0
    result = store.close({"outcome": "failed", "failure": "stopped at t = 0 s"})
    assert result.array("position").shape == (0, 1, 3)
    assert "stopped at t = 0 s" in repr(result)


def test_files_that_are_no_results_are_refused_in_words(tmp_path):
    with pytest.raises(ModelError, match="there is no result file"):
        Result.open(tmp_path / "nothing.nc")
    with pytest.raises(ModelError, match="is a folder"):
        Result.open(tmp_path)
    text = tmp_path / "text.nc"
    text.write_text("a,b\n1,2\n")
    with pytest.raises(ModelError, match="is not a result of nivel"):
        Result.open(text)
    with h5py.File(tmp_path / "other.nc", "w") as file:
        file["x"] = 1.0
    with pytest.raises(ModelError, match="it lacks the attribute `nivel_version`"):
        Result.open(tmp_path / "other.nc")


def test_large_attributes_survive(tmp_path):
    source = "# a long machine file\n" * 10_000
    assert stored(tmp_path / "run.nc", machine_source=source).attributes["machine_source"] == source


@pytest.mark.parametrize("stride", [97, 499, 997])
def test_damaged_files_are_told_in_a_sentence(tmp_path, stride):
    """Bytes changed here and there: HDF5's own errors become one of the input."""
    path = tmp_path / "run.nc"
    stored(path)
    content = bytearray(path.read_bytes())
    for place in range(2000, len(content), stride):
        content[place] ^= 0x5A
    path.write_bytes(content)
    with pytest.raises(ModelError, match=re.escape(str(path))):
        read_all(path)


def read_all(path):
    """Everything in a file."""
    result = Result.open(path)
    return [result.array(name) for name in result.variables]


def written(folder):
    """A result file of the synthetic pendulum."""
    store = Store(folder / "whole.nc")
    store.begin(pendulum.header())
    store.take(pendulum.frames(TIME))
    return store.close({"outcome": "done"}).path


def test_a_damaged_result_is_refused_in_words(tmp_path):
    """Any byte of it: never a traceback."""
    original = written(tmp_path)
    content = original.read_bytes()
    rng = np.random.default_rng(3)
    for _ in range(60):
        broken = bytearray(content)
        for at in rng.integers(0, len(broken), 20):
            broken[at] = rng.integers(0, 256)
        path = tmp_path / "broken.nc"
        path.write_bytes(broken)
        with suppress(ModelError):
            Result.open(path).array("position")


@pytest.mark.parametrize("text", ["", "{", "[]", '{"verdict": 3}', '{"items": [{"x": 1}]}', '{"items": 5}', "null"])
def test_a_damaged_trust_report_is_refused_in_words(tmp_path, text):
    original = written(tmp_path)
    with h5py.File(original, "r+") as file:
        file.attrs["trust"] = text
    with pytest.raises(ModelError, match=r"damaged.*trust"):
        _ = Result.open(original).trust


def test_names_of_a_foreign_file_are_no_formulas_in_a_table(tmp_path):
    original = written(tmp_path)
    with h5py.File(original, "r+") as file:
        file.move("force.push.power", "=1+1")
    table = Result.open(original).export_csv(tmp_path / "a.csv").read_text(encoding="utf-8")
    names = table.splitlines()[0].split(",")
    assert "'=1+1 [W]" in names
    assert not any(name.startswith("=") for name in names)


def test_a_result_that_claims_more_frames_than_it_holds_is_refused(tmp_path):
    original = written(tmp_path)
    with h5py.File(original, "r+") as file:
        for name in ("time", "position"):
            file[name].resize(100_000_000, axis=0)
    with pytest.raises(ModelError, match="claims"):
        Result.open(original)


def write_ten_frames(path):
    store = Store(path)
    store.begin(pendulum.header())
    store.take(pendulum.frames(TIME[:10]))
    store.close({})


def test_final_forms_left_behind_by_killed_writers_are_removed(tmp_path):
    """One of a process that runs, and one that is young, stay."""
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    old, young, running = (tmp_path / f".run.nc.{name}.part" for name in (ended.pid, f"a.{ended.pid}", os.getppid()))
    for path in (old, young, running):
        path.write_bytes(b"")
    for path in (old, running):
        os.utime(path, (0, 0))
    write_ten_frames(tmp_path / "run.nc")
    assert not old.exists()
    assert young.exists()
    assert running.exists()


@pytest.mark.parametrize(
    ("attribute", "value", "said"),
    [
        ("scene", {"bodies": 3}, "`scene`: bodies is int"),
        ("machine_record", [], "`machine_record`: it is list"),
        ("timing", {"steps": "many"}, "`timing`: steps is str"),
    ],
)
def test_json_of_another_form_is_damage(attribute, value, said, tmp_path):
    path = tmp_path / "run.nc"
    write_ten_frames(path)
    with h5py.File(path, "r+") as file:
        file.attrs[attribute] = json.dumps(value)
    with pytest.raises(ModelError, match=said):
        Result.open(path)
