"""Object files are whole, undamaged, one's own, or not there."""

import errno
import os
import threading
from pathlib import Path

import pytest
import toy_entries as toys

from nivel.cli.failures import told
from nivel.native import library, processor, store, workers


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("NIVEL_CACHE_DIR", str(tmp_path / "cache"))
    store.folder.cache_clear()
    yield tmp_path / "cache" / "objects"
    store.folder.cache_clear()


def test_what_is_written_is_read(home):
    path = store.path_of("entry", "text")
    assert path.parent == home
    assert store.read(path) is None
    store.write(path, b"machine code")
    assert store.read(path) == b"machine code"
    assert os.listdir(home) == [path.name]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device without room")
def test_a_full_disk_is_told_in_one_sentence(tmp_path, capsys):
    """What compiles meets it, in a process of its own, which then takes other jobs."""

    def compile_to(path):
        workers.compile_all([library.job_of(toys.squares, [(str(path), processor.target())])])

    with pytest.raises(OSError, match="/dev/full") as found:
        compile_to("/dev/full")
    assert found.value.errno == errno.ENOSPC
    with pytest.raises(SystemExit, match="3"), told():
        compile_to("/dev/full")
    assert capsys.readouterr().err == "/dev/full cannot be written: no space left on device\n"
    compile_to(tmp_path / "squares.o")
    assert store.read(tmp_path / "squares.o")


def test_only_the_user_can_write_there(home):
    store.folder()
    assert home.stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize(
    "damage", [lambda b: b[:-1], lambda b: b[:40], lambda b: b"", lambda b: b[:50] + b"X" + b[51:]]
)
def test_damage_is_found(home, damage):
    path = store.path_of("entry", "text")
    store.write(path, bytes(range(256)))
    path.write_bytes(damage(path.read_bytes()))
    with pytest.warns(UserWarning, match="damaged"):
        assert store.read(path) is None
    assert not path.exists()


@pytest.mark.parametrize("thing", ["folder", "full folder", "pipe", "link to a device", "link to nothing"])
def test_what_is_no_file_in_the_place_of_one_is_left_alone(home, thing):
    """Reading /dev/zero or a pipe would never end, and a folder cannot be replaced: the file gets another name."""
    path = store.path_of("entry", "text")
    match thing:
        case "folder":
            path.mkdir()
        case "full folder":
            (path / "inside").mkdir(parents=True)
        case "pipe":
            os.mkfifo(path)
        case "link to a device":
            path.symlink_to("/dev/zero")
        case "link to nothing":
            path.symlink_to(home / "nothing")
    found = store.path_of("entry", "text")
    assert store.read(path) is None
    assert store.read(found) is None
    store.write(found, b"machine code")
    assert store.path_of("entry", "text") == found
    assert store.read(found) == b"machine code"
    assert thing == "link to nothing" or path != found


def test_folder_of_others_is_not_used(home):
    home.mkdir(parents=True)
    home.chmod(0o777)
    with pytest.warns(UserWarning, match="can be written by others"):
        folder = store.folder()
    assert folder != home
    assert folder.stat().st_mode & 0o077 == 0


def test_without_a_place_for_the_cache_there_is_a_temporary_one(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("NIVEL_CACHE_DIR", str(tmp_path / "file"))
    store.folder.cache_clear()
    folder = store.folder()
    assert folder.is_dir()
    assert tmp_path not in folder.parents
    store.folder.cache_clear()


def test_everything_it_depends_on_gives_it_another_name(home, monkeypatch):
    names = {store.path_of(*parts) for parts in (("a", "x"), ("b", "x"), ("a", "y"), ("a", "x", ""))}
    monkeypatch.setattr(store, "compiler", lambda: ("another processor",))
    assert len(names | {store.path_of("a", "x")}) == 5


def test_many_that_write_the_same_leave_it_whole(home):
    path, code = store.path_of("entry", "text"), bytes(100_000)
    threads = [threading.Thread(target=lambda: [store.write(path, code) for _ in range(20)]) for _ in range(4)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        assert store.read(path) in (None, code)
    assert store.read(path) == code
