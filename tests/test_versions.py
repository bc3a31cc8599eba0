"""Versions of files, as `docs/versions.md` has them: what this nivel reads, and what it says about the rest."""

import json
import re
from pathlib import Path

import h5py
import numpy as np
import pytest
from click.testing import CliRunner

import nivel
import synthetic_run as pendulum
from nivel.cli import main
from nivel.errors import ModelError
from nivel.files.outline import FORMAT as MACHINE_FORMAT
from nivel.files.reader import parse_machine
from nivel.files.schema import schema
from nivel.flexible.body import body_file
from nivel.flexible.model import model_file
from nivel.live import recording
from nivel.results import Result, Store
from nivel.results.frames.contents import FORMAT

PAGE = (Path(__file__).parent.parent / "docs" / "versions.md").read_text(encoding="utf-8")
MACHINE = "format: 1\nbodies: {a: {mass: 1, inertia: [1, 1, 1]}}\nsimulation: {duration: 1 ms, step: 1 ms}\n"
NEWER = "0.10.0"


def message(text):
    with pytest.raises(ModelError) as raised:
        parse_machine(text, "machine.yaml")
    return str(raised.value)


def test_the_page_has_the_formats_that_the_program_reads():
    table = dict(re.findall(r"^\| ([\w ]+) \| .*? \| (\d+) \|", PAGE, re.MULTILINE))
    assert table == {
        "machine file": str(MACHINE_FORMAT),
        "model of a flexible body": str(model_file.FORMAT),
        "result file": str(FORMAT),
        "reduced body": str(body_file.FORMAT),
        "recording of a live run": str(recording.FORMAT),
    }


def test_the_editor_schema_has_the_format():
    assert schema()["properties"]["format"]["const"] == MACHINE_FORMAT


@pytest.mark.parametrize("given", ["2", "17"])
def test_a_format_of_the_future_asks_for_a_newer_nivel_and_for_nothing_else(given):
    told = message(MACHINE.replace("format: 1", f"format: {given}").replace("mass", "weight_of_format_2"))
    assert told.count("machine.yaml:") == 1
    assert f"machine.yaml:1:9: format: this nivel reads format 1, not `{given}`" in told
    assert "belongs to a newer nivel: `pip install --upgrade nivel`" in told


@pytest.mark.parametrize("given", ["0", "-1", "1.5", "one", "true", "[1]"])
def test_what_was_never_a_format_is_answered_with_the_line_to_write(given):
    told = message(MACHINE.replace("format: 1", f"format: {given}"))
    assert "write `format: 1`" in told
    assert "newer" not in told


def test_a_missing_format_is_answered_with_the_line_to_write():
    assert "`format: 1` is missing" in message(MACHINE.replace("format: 1\n", ""))


def test_the_command_ends_with_the_code_of_wrong_input(tmp_path):
    path = tmp_path / "future.yaml"
    path.write_text(MACHINE.replace("format: 1", "format: 2"), encoding="utf-8")
    done = CliRunner().invoke(main, ["check", str(path)])
    assert done.exit_code == 2
    assert "belongs to a newer nivel" in done.stderr


@pytest.fixture
def stored(tmp_path):
    """Path of a result file, some of whose attributes are changed, or taken away where the value is None."""

    def change(**attributes):
        path = tmp_path / "run.nc"
        store = Store(path)
        store.begin(pendulum.header())
        store.take(pendulum.frames(np.linspace(0.0, 1.0, 5)))
        store.close({"outcome": "completed"})
        with h5py.File(path, "a") as file:
            for name, value in attributes.items():
                file.attrs.pop(name, None)
                if value is not None:
                    file.attrs[name] = value
        return path

    return change


def test_a_run_writes_its_format_and_its_version(tmp_path):
    result = nivel.Machine.from_record(parse_machine(MACHINE, "machine.yaml")).simulate(out=tmp_path / "run.nc")
    assert Result.open(result.path).attributes["result_format"] == FORMAT
    assert Result.open(result.path).attributes["nivel_version"] == nivel.__version__


def test_results_without_a_format_are_of_format_1(stored):
    """nivel 0.1.0 wrote none."""
    path = stored(nivel_version="0.1.0", result_format=None)
    assert len(Result.open(path).time) == 5


def test_results_of_a_newer_version_and_the_same_format_are_read(stored):
    path = stored(nivel_version=NEWER, result_format=1, an_attribute_of_the_future="7")
    with h5py.File(path, "a") as file:
        file["a_variable_of_the_future"] = np.zeros(5)
        file["a_variable_of_the_future"].dims[0].attach_scale(file["time"])
        file["a_variable_of_the_future"].attrs.update({"units": "m", "long_name": "of the future"})
    result = Result.open(path)
    assert result.array("position").shape == (5, 1, 3)
    assert str(result)


def test_results_of_a_newer_format_are_refused_with_what_to_install(stored):
    path = stored(nivel_version=NEWER, result_format=2)
    with h5py.File(path, "a") as file:  # nothing else of the file has to be as it is today
        for name in list(file):
            del file[name]
    with pytest.raises(ModelError) as raised:
        Result.open(path)
    told = str(raised.value)
    assert f"{path} was written by nivel {NEWER} in result format 2" in told
    assert f"nivel {nivel.__version__}, which runs here, reads format 1" in told
    assert f"`pip install nivel=={NEWER}`" in told
    done = CliRunner().invoke(main, ["explain", str(path)])
    assert done.exit_code == 2
    assert "in result format 2" in done.stderr


def test_a_format_that_is_no_number_is_damage(stored):
    with pytest.raises(ModelError, match="is damaged"):
        Result.open(stored(result_format="one"))


RECORD = json.dumps({"name": "pendulum", "control": [{"name": "brain", "type": "of-the-future"}]})


@pytest.mark.parametrize(("version", "newer"), [(NEWER, True), ("0.1.9", False), ("unknown", False)])
def test_what_cannot_be_read_in_a_result_of_a_newer_version_is_said_to_be_of_it(stored, version, newer):
    path = stored(nivel_version=version, machine_record=RECORD)
    with pytest.raises(ModelError, match="`machine_record` cannot be read") as raised:
        Result.open(path).report(path.with_suffix(".html"))
    assert (f"it was written by nivel {version}" in str(raised.value)) == newer


def test_a_beam_of_a_newer_version_is_refused_in_words(stored):
    path = stored(nivel_version=NEWER, machine_record=RECORD)
    with pytest.raises(ModelError, match=f"it was written by nivel {NEWER}"):
        Result.open(path).sections("boom")


def test_a_recording_of_another_format_names_the_version_that_wrote_it(tmp_path):
    path = tmp_path / "lift.live.npz"
    for about, version in (({"format": 3, "nivel_version": NEWER}, NEWER), ({"format": 1}, "0.1.0")):
        with path.open("wb") as file:
            np.savez_compressed(file, about=np.array(json.dumps(about)))
        with pytest.raises(ModelError) as raised:
            recording.read_recording(path)
        assert f"was written by nivel {version} in format {about['format']} of recordings" in str(raised.value)
        assert f"reads format {recording.FORMAT}: replay it with the version that wrote it" in str(raised.value)


def test_a_body_of_another_format_is_reduced_again(tmp_path):
    path = tmp_path / "boom.nc"
    with h5py.File(path, "w") as file:
        file.attrs.update({"kind": body_file.KIND, "format": 2})
    with pytest.raises(ModelError, match="has format 2, this nivel reads 1: reduce the model again"):
        body_file.read_body(path)
