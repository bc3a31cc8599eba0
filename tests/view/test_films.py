"""Stills and films of an example as other programs read them: their size, their frames, their length, and that they move."""

import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import nivel
from browsing import with_browser
from needing import needs
from nivel.view.capture import Look, _ffmpeg, film, still
from nivel.view.sources import Playback

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
LOOK = Look(width=320, height=240, rate=20, speed=0.5)
FRAMES = 21  # of half a second: both ends count
image = needs("PIL.Image")


@pytest.fixture(scope="module")
def source():
    return Playback([nivel.load(EXAMPLES / "mechanisms" / "four-bar.yaml").simulate(duration=0.5)])


def assert_moving(pictures):
    """Pictures (n, h, w, 3): something is in each, and no two in a row are the same."""
    for picture in pictures:
        assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 40
    changes = np.abs(np.diff(pictures.astype(int), axis=0)).max(axis=3)
    assert ((changes > 40).sum(axis=(1, 2)) > 5).all()


@with_browser
@pytest.mark.full
def test_an_mp4_is_read_by_ffmpeg(source, tmp_path):
    heard = []
    film(source, tmp_path / "a.mp4", LOOK, lambda *done: heard.append(done))
    assert heard[-1] == (FRAMES, FRAMES)
    said = subprocess.run(
        [_ffmpeg(), "-i", str(tmp_path / "a.mp4")], capture_output=True, text=True, check=False
    ).stderr
    assert re.search(r"Video: h264 .*yuv420p.* 320x240.* 20 fps", said)
    duration = re.search(r"Duration: 00:00:(\d\d\.\d\d)", said)
    assert float(duration[1]) == pytest.approx(FRAMES / LOOK.rate, abs=0.02)
    raw = subprocess.run(
        [_ffmpeg(), "-loglevel", "error", "-i", str(tmp_path / "a.mp4"), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
        capture_output=True,
        check=True,
    ).stdout
    pictures = np.frombuffer(raw, np.uint8).reshape(-1, 240, 320, 3)
    assert len(pictures) == FRAMES
    assert_moving(pictures)


@with_browser
@pytest.mark.full
def test_a_gif_is_read_by_pillow(source, tmp_path):
    film(source, tmp_path / "a.gif", LOOK, lambda *_: None)
    pictures = []
    with image.open(tmp_path / "a.gif") as made:
        assert (made.format, made.n_frames, made.info["duration"], made.info["loop"]) == ("GIF", FRAMES, 50, 0)
        for k in range(FRAMES):
            made.seek(k)
            pictures.append(np.asarray(made.convert("RGB")))
    assert_moving(np.array(pictures))


@with_browser
@pytest.mark.full
def test_a_still_is_the_frame_of_the_film(source, tmp_path):
    still(source, tmp_path / "a.png", LOOK, 0.25)
    film(source, tmp_path / "a.gif", LOOK, lambda *_: None)
    with image.open(tmp_path / "a.png") as made:
        assert (made.format, made.size) == ("PNG", (320, 240))
        picture = np.asarray(made.convert("RGB")).astype(int)
    with image.open(tmp_path / "a.gif") as made:
        far = []
        for k in range(FRAMES):
            made.seek(k)
            far.append(np.abs(np.asarray(made.convert("RGB")).astype(int) - picture).mean())
    assert int(np.argmin(far)) == 10
