"""Stills and films through the page in a browser, and `nivel view` on the command line."""

import shutil
import subprocess
import sys
from contextlib import chdir
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
import synthetic_run as pendulum
from browsing import with_browser
from needing import needs
from nivel.cli import main
from nivel.errors import ModelError
from nivel.results import Store
from nivel.view import capture
from nivel.view.capture import Look, film, still
from nivel.view.sources import Playback
from patience import PATIENCE

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
SMALL = Look(width=320, height=240)


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """A result file of one swing of the pendulum, about 0.28 s each way."""
    store = Store(tmp_path_factory.mktemp("stored") / "pendulum.nc")
    store.begin(pendulum.header())
    store.take(pendulum.frames(np.linspace(0.0, 1.0, 101)))
    return store.close({"outcome": "done"}).path


def source(path):
    return Playback([nivel.open_result(path)])


def pixels(path):
    image = needs("PIL.Image")
    return np.asarray(image.open(path).convert("RGB")).astype(int)


def assert_in_the_middle(changed):
    """Pixels (h, w) that a motion changes, which is in the plane of the picture: they fill it, on both sides of its middle."""
    rows, columns = np.nonzero(changed)
    assert len(rows) > 50
    height, width = changed.shape
    assert 0 < rows.min() < rows.max() < height - 1
    assert 0 < columns.min() < columns.max() < width - 1
    assert max(np.ptp(rows) / height, np.ptp(columns) / width) > 0.5
    assert abs(rows.min() + rows.max() - height) < 0.3 * height
    assert abs(columns.min() + columns.max() - width) < 0.3 * width


@with_browser
def test_a_still_has_its_size_and_shows_its_moment(stored, tmp_path):
    still(source(stored), tmp_path / "a.png", SMALL)
    still(source(stored), tmp_path / "b.png", SMALL, 0.7)
    still(source(stored), tmp_path / "c.png", Look(width=320, height=240, dark=True, side="top"), 0.7)
    first, later, dark = (pixels(tmp_path / f"{name}.png") for name in "abc")
    assert first.shape == (240, 320, 3)
    assert_in_the_middle(np.abs(first - later).max(axis=2) > 25)
    assert dark.mean() < 90 < first.mean()
    with pytest.raises(ModelError, match="no moment 5 s"):
        still(source(stored), tmp_path / "d.png", SMALL, 5.0)


@with_browser
@pytest.mark.full
def test_a_gif_has_all_frames_and_they_differ(stored, tmp_path):
    image = needs("PIL.Image")
    heard = []
    film(
        source(stored),
        tmp_path / "a.gif",
        Look(width=160, height=120, rate=10),
        lambda done, total: heard.append((done, total)),
    )
    with image.open(tmp_path / "a.gif") as made:
        assert made.n_frames == 11
        assert made.info["duration"] == 100
        assert made.size == (160, 120)
        first = np.asarray(made.convert("RGB")).astype(int)
        made.seek(7)
        assert_in_the_middle(np.abs(np.asarray(made.convert("RGB")) - first).max(axis=2) > 25)
    assert heard[-1] == (11, 11)


@with_browser
@pytest.mark.full
def test_an_mp4_is_made_where_ffmpeg_is_found(stored, tmp_path):
    if not shutil.which("ffmpeg"):
        needs("imageio_ffmpeg")
    film(source(stored), tmp_path / "a.mp4", Look(width=161, height=121, rate=10, speed=2.0), lambda *_: None)
    assert (tmp_path / "a.mp4").read_bytes()[4:8] == b"ftyp"


@with_browser
def test_films_that_would_never_end_are_refused(stored, tmp_path):
    with pytest.raises(ModelError, match="more than 5000; take a --speed"):
        film(source(stored), tmp_path / "a.gif", Look(speed=1e-4), lambda *_: None)


def test_what_is_missing_is_said(stored, tmp_path, monkeypatch):
    monkeypatch.setattr(capture.shutil, "which", lambda _name: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(ModelError, match=r"needs ffmpeg.*nivel\[film\].*--export scene.html"):
        capture._ffmpeg()
    monkeypatch.setattr(capture, "PLACES", ())
    monkeypatch.delenv("NIVEL_BROWSER", raising=False)
    with pytest.raises(ModelError, match="none was found: install chromium"):
        still(source(stored), tmp_path / "a.png", SMALL)
    monkeypatch.setenv("NIVEL_BROWSER", "/nowhere/chromium")
    with pytest.raises(ModelError, match="NIVEL_BROWSER is `/nowhere/chromium`, which is no program"):
        still(source(stored), tmp_path / "a.png", SMALL)


def test_a_browser_that_is_none_is_said(stored, tmp_path, monkeypatch):
    monkeypatch.setenv("NIVEL_BROWSER", sys.executable)
    with pytest.raises(ModelError, match=r"ended at once with code .*NIVEL_BROWSER"):
        still(source(stored), tmp_path / "a.png", SMALL)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"size": "huge"}, "1280x720"),
        ({"size": "10x10"}, "1280x720"),
        ({"side": "inside"}, "no side"),
        ({"speed": 0.0}, "greater than zero"),
    ],
)
def test_looks_that_make_no_sense_are_refused(given, said):
    with pytest.raises(ModelError, match=said):
        Look.of(**{"size": "640x480", "side": "front", "rate": 25, "speed": 1.0, "dark": False, **given})


# --- nivel view ---


def view(folder, *arguments):
    """`nivel view` in this process, where a defect is an error of the test."""
    with chdir(folder):
        return CliRunner().invoke(main, ["view", *map(str, arguments)], prog_name="nivel", catch_exceptions=False)


def view_in_a_process(folder, *arguments):
    command = [sys.executable, "-m", "nivel", "view", *map(str, arguments)]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=PATIENCE)


def test_an_export_is_one_file_and_is_not_replaced_unasked(stored, tmp_path):
    done = view(tmp_path, stored, "--export", "scene.html")
    assert (done.exit_code, done.stderr.strip()) == (0, "written: scene.html")
    done = view(tmp_path, stored, "--export", "scene.html")
    assert done.exit_code == 2
    assert "--force" in done.stderr
    assert view(tmp_path, stored, stored, "--export", "scene.html", "--force", "--quiet").stderr == ""


@pytest.mark.full
@with_browser
def test_a_still_and_a_film_from_the_command_line(stored, tmp_path):
    done = view_in_a_process(
        tmp_path, stored, "--still", "a.png", "--at", "0.3", "--export", "b.gif", "--size", "160x120", "--speed", "5"
    )
    assert done.returncode == 0, done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"a.png", "b.gif"}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("missing.nc",), "there is no result file"),
        (("missing.yaml",), "no such file"),
        (("text.nc",), "not a result of nivel"),
        (("cut.nc",), "not a result of nivel"),
        (("other.nc",), "nivel_version"),
        (("bad.yaml",), "positon"),
        (("good.nc", "text.nc"), "not a result of nivel"),
        (("good.nc", "--export", "a.avi"), ".html, .png, .mp4 or .gif"),
        (("good.nc", "--export", "nowhere/a.html"), "no folder"),
        (("good.nc", "--export", "good.nc"), ".html, .png"),
        (("good.nc", "--size", "x", "--side", "y"), "--side"),
        (("good.nc", "--set", "a=1"), "--set is for machine files"),
        (("good.nc", "--host", "192.0.2.1", "--no-browser"), "no address that this machine can listen at"),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, tuple) else "",
)
def test_what_cannot_be_shown_is_said_with_exit_code_two(arguments, said, stored, tmp_path):
    import h5py

    shutil.copy(stored, tmp_path / "good.nc")
    (tmp_path / "text.nc").write_text("hello", encoding="utf-8")
    (tmp_path / "cut.nc").write_bytes(stored.read_bytes()[:5000])
    with h5py.File(tmp_path / "other.nc", "w") as file:
        file["time"] = [1.0]
    (tmp_path / "bad.yaml").write_text(
        "format: 1\nbodies:\n  a: {mass: 1, inertia: [1, 1, 1], positon: [0, 0, 0]}\n", encoding="utf-8"
    )
    done = view(tmp_path, *arguments)
    assert done.exit_code == 2, done.stderr
    assert said in done.stderr
    assert "Traceback" not in done.stderr


def test_a_machine_is_exported_as_it_is_assembled(tmp_path):
    done = view(tmp_path, EXAMPLES / "mechanisms" / "simple-pendulum.yaml", "--export", "pendulum.html", "--quiet")
    assert done.exit_code == 0, done.stderr
    assert (tmp_path / "pendulum.html").stat().st_size < 1_000_000
