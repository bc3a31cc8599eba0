"""Result files that were cut off, changed, or are none: a sentence and exit code 2 from every command, at once and without much memory."""

import json
import resource
import shutil

import h5py
import numpy as np
import pytest
from click.testing import CliRunner

import synthetic_run as pendulum
from nivel.cli import main
from nivel.errors import ModelError
from nivel.results import Result, Store

TIME = np.linspace(0.0, 1.0, 101)


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    path = tmp_path_factory.mktemp("good") / "run.nc"
    store = Store(path)
    store.begin(pendulum.header())
    store.take(pendulum.frames(TIME))
    store.close({"outcome": "done"})
    return path


def _cut(path):
    with path.open("r+b") as file:
        file.truncate(path.stat().st_size // 2)


def _bytes(contents):
    return lambda path: path.write_bytes(contents)


def _edited(change):
    def apply(path):
        with h5py.File(path, "r+") as file:
            change(file)

    return apply


def _replaced(file, name, **given):
    """Another dataset under the name, with the same names of its dimensions."""
    scales = [dimension[0] for dimension in file[name].dims]
    attributes = {key: file[name].attrs[key] for key in ("units", "long_name")}
    del file[name]
    made = file.create_dataset(name, dtype="f8", **given)
    made.attrs.update(attributes)
    for dimension, scale in zip(made.dims, scales, strict=False):
        dimension.attach_scale(scale)


def _linked(file):
    del file["position"]
    file["position"] = h5py.ExternalLink("/etc/passwd", "/position")


def _outside(file):
    shape = file["position"].shape
    del file["position"]
    file.create_dataset("position", shape, dtype="f8", external=[("/etc/hostname", 0, h5py.h5f.UNLIMITED)])


def _without_scene(file):
    del file.attrs["scene"]


def _with(attribute, text):
    def change(file):
        file.attrs[attribute] = text

    return change


def _no_characters(file):
    file.attrs["machine"] = np.bytes_(b"\xff\xfe")


HOSTILE = {
    "cut off": _cut,
    "a text": _bytes(b"format: 1\nbodies: {}\n"),
    "empty": _bytes(b""),
    "noise": _bytes(np.random.default_rng(1).bytes(10_000)),
    "the head of a result alone": _bytes(b"\x89HDF\r\n\x1a\n" + bytes(2000)),
    "no times": _edited(lambda file: file.pop("time")),
    "a huge variable that holds nothing": _edited(
        lambda file: _replaced(file, "position", shape=(10**9, 10**4, 3), chunks=(1, 1, 3))
    ),
    "more frames than are held": _edited(lambda file: _replaced(file, "energy_error", shape=(10**12,), chunks=(1,))),
    "more numbers a frame than names": _edited(lambda file: _replaced(file, "position", data=np.zeros((101, 50, 3)))),
    "a folder where a variable was": _edited(lambda file: (file.pop("position"), file.create_group("position"))),
    "a link to another file": _edited(_linked),
    "numbers of another file": _edited(_outside),
    "no scene": _edited(_without_scene),
    "a scene that is a number": _edited(_with("scene", "1e999")),
    "brackets without an end": _edited(_with("settings", "[" * 100_000)),
    "bytes that are no characters": _edited(_no_characters),
    "a format of the future": _edited(_with("result_format", 99)),
    "flexible bodies that are none": _edited(_with("flexible_bodies", json.dumps([{"name": "a", "modes": 3}]))),
    "buckling that is none": _edited(_with("buckling", json.dumps([{"time": []}]))),
}
COMMANDS = (
    ["explain", "bad.nc"],
    ["export", "bad.nc", "--csv", "-"],
    ["loads", "bad.nc"],
    ["view", "bad.nc", "--export", "view.html", "--force"],
    ["stress", "bad.nc", "--force"],
)


@pytest.mark.parametrize("kind", HOSTILE)
def test_every_command_refuses_it_in_a_sentence(kind, good, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shutil.copy(good, "bad.nc")
    HOSTILE[kind](tmp_path / "bad.nc")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for command in COMMANDS:
        done = CliRunner().invoke(main, command)
        assert done.exit_code == 2, (command, done.output, done.exception)
        assert "bad.nc" in done.output
        assert "Traceback" not in done.output
        assert "root:" not in done.output
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 300_000  # kB
    with pytest.raises(ModelError):
        _ = Result.open("bad.nc").dataset


def test_the_good_one_is_read(good):
    done = CliRunner().invoke(main, ["export", str(good), "--csv", "-"])
    assert done.exit_code == 0, done.output
    assert len(done.output.splitlines()) > 100
