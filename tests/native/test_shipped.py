"""The library of a wheel, here of two entries: used where processor and sources fit, and equal to what is compiled."""

import ctypes
import json
import shutil
import subprocess

import numpy as np
import pytest
import toy_entries as toys

from nivel.native import library, processor, shipped, store, workers
from nivel.native.processor import LEVELS
from nivel.native.sources import fingerprint

pytestmark = pytest.mark.skipif(shutil.which("cc") is None, reason="no compiler that links")
ENTRIES = (toys.squares, toys.made)
X = np.array([3.0, 4.5, -5.25])


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with the library, as `packaging/build_wheel.py` leaves it."""
    level = processor.asked_level() or next((name for name, each in LEVELS.items() if processor.runs_here(each)), "")
    if not level:
        pytest.skip("a processor below all levels")
    assert all(entry.address for entry in ENTRIES)  # what is compiled by itself
    targets = {entry: tmp_path / f"{entry.symbol}.o" for entry in ENTRIES}
    workers.compile_all(library.job_of(entry, [(str(path), LEVELS[level].target)]) for entry, path in targets.items())
    for path in targets.values():
        path.write_bytes(store.read(path))
    command = ["cc", "-shared", "-o", tmp_path / shipped.file_of(level), *targets.values(), "-Wl,--no-undefined", "-lm"]
    subprocess.run(command, check=True)
    sources = {entry.name: fingerprint(entry.name) for entry in ENTRIES}
    (tmp_path / shipped.MANIFEST).write_text(json.dumps({"levels": [level], "entries": sources}))
    monkeypatch.setattr(shipped, "FOLDER", tmp_path)
    _forget()
    yield tmp_path
    monkeypatch.undo()
    _forget()


def _forget():
    for function in (shipped.manifest, shipped.level, shipped._library):
        function.cache_clear()


def change(folder, **changes):
    """Rewrite the manifest."""
    path = folder / shipped.MANIFEST
    path.write_text(json.dumps({**json.loads(path.read_text()), **changes}))
    _forget()


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda entry: entry.__name__)
def test_results_are_those_of_what_is_compiled(folder, entry):
    at = shipped.address_in_library(entry)
    assert at != entry.address
    assert entry.signature.function_at(at)(X, 0) == entry(X, 0)


def test_what_is_in_the_library_is_not_missing(folder):
    assert library.missing(ENTRIES) == []
    assert shipped.address_in_library(toys.sine) is None


def test_other_sources_are_not_taken_from_it(folder):
    change(folder, entries={toys.squares.name: "another digest"})
    assert shipped.address_in_library(toys.squares) is None


def test_a_processor_without_the_level_does_not_use_it(folder, monkeypatch):
    monkeypatch.setattr(processor, "processor_flags", lambda: frozenset({"sse2"}))
    _forget()
    assert shipped.level() == ""
    assert shipped.address_in_library(toys.squares) is None


def test_the_symbols_of_entries_are_all_that_it_shows(folder):
    loaded = ctypes.CDLL(str(folder / shipped.file_of(shipped.level())))
    assert loaded[toys.squares.symbol]
    with pytest.raises(AttributeError):
        assert loaded["square"]


def test_a_library_that_cannot_be_loaded_is_told_and_not_used(folder, capsys):
    (folder / shipped.file_of(shipped.level())).write_bytes(b"damaged")
    shipped._library.cache_clear()
    assert shipped.address_in_library(toys.squares) is None
    assert "is not used" in capsys.readouterr().err
