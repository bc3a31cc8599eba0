"""Stills and films: the page draws them in a browser."""

import json
import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.extras import is_installed, require
from nivel.files.target import write_file
from nivel.lazy import PIL, Struct, imageio_ffmpeg
from nivel.view.browser import Tab, require_browser, tab
from nivel.view.page import page_of
from nivel.view.sources import Source

FILMS: Final = (".mp4", ".gif")
SIDES: Final = ("first", "front", "right", "top", "back", "left", "below")
SMALLEST: Final = 64  # pixels
LARGEST: Final = 4096
MOST_FRAMES: Final = 5000
NO_FFMPEG: Final = "an .mp4 film needs ffmpeg: install it, or pip install 'nivel[film]'; a .gif or a page (--export scene.html) needs none"


class Look(Struct):
    """How stills and films look. rate : frames a second of film. speed : seconds of motion in one of film. colours : the quantity that
    beams or flexible bodies show, or empty."""

    width: int = 1280
    height: int = 720
    side: str = "first"
    rate: int = 25
    speed: float = 1.0
    dark: bool = False
    colours: str = ""

    @classmethod
    def of(cls, *, size: str, side: str, rate: int, speed: float, dark: bool, colours: str = "") -> "Look":
        """From words. Raises ModelError with all that is wrong."""
        faults = []
        found = re.fullmatch(r"(\d{2,4})\s*[x×*]\s*(\d{2,4})", size.strip())
        width, height = (int(found[1]), int(found[2])) if found else (0, 0)
        if not (SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
            faults.append(f"a size like 1280x720, each from {SMALLEST} to {LARGEST} pixels, was expected, got {size!r}")
        if side not in SIDES:
            faults.append(f"there is no side {side!r}; there are {', '.join(SIDES)}")
        if not (np.isfinite(speed) and speed > 0.0):
            faults.append(f"a speed greater than zero was expected, got {speed:g}")
        if faults:
            raise ModelError([Fault.at("", message) for message in faults])
        return cls(width, height, side, rate, speed, dark, colours)


def require_parts(path: Path) -> None:
    """Refuse a picture or film `path` where a part is missing that draws or codes it. Raises ModelError."""
    require("pictures and films need", "websockets")
    require_browser()
    if path.suffix.lower() == ".gif":
        require("a .gif film needs", "PIL")
    elif path.suffix.lower() in FILMS:
        _ffmpeg()


def still(source: Source, path: Path, look: Look, moment: float | None = None) -> None:
    """Write a picture (PNG) of the moment [s], default the start."""
    require_parts(path)
    with _opened(source, look, fine=True) as page:
        start, end = _span(page)
        if moment is not None and not start <= moment <= end:
            raise ModelError(f"the motion goes from {start:g} s to {end:g} s; there is no moment {moment:g} s")
        page.run(f"nivel.pose({start if moment is None else moment!r})")
        write_file(path, "picture", page.picture())


def film(source: Source, path: Path, look: Look, progress: Callable[[int, int], None]) -> None:
    """Write a film; the end of `path` says which kind. `progress` hears frames done and their number.

    Raises ModelError before the first frame where what it needs is missing.
    """
    require_parts(path)
    coder = _gif if path.suffix.lower() == ".gif" else _mp4
    with _opened(source, look) as page:
        start, end = _span(page)
        if not end > start:
            raise ModelError("there is no motion to film: one moment only; write a picture with --still")
        count = int(np.floor((end - start) / look.speed * look.rate + 1e-9)) + 1
        if count > MOST_FRAMES:
            faster = (end - start) * look.rate / MOST_FRAMES
            raise ModelError(
                f"the film would have {count} frames, more than {MOST_FRAMES}; take a --speed of {faster:.3g} or more"
            )
        with coder(path, look) as take:
            for k in range(count):
                page.run(f"nivel.pose({min(start + k * look.speed / look.rate, end)!r})")
                take(page.picture())
                progress(k + 1, count)


@contextmanager
def _opened(source: Source, look: Look, *, fine: bool = False) -> Iterator[Tab]:
    """The page of the source in a browser, without controls; fine : with smooth edges, which take several times as long."""
    with tempfile.TemporaryDirectory(prefix="nivel-page-") as folder:
        page = Path(folder) / "page.html"
        page.write_text(page_of(source), encoding="utf-8")
        with tab(page, look.width, look.height, dark=look.dark) as opened:
            opened.run(f"nivel.bare('{look.side}', {json.dumps(fine)})")
            if look.colours and not opened.run(f"nivel.app.colour({json.dumps(look.colours)})"):
                known = opened.run("nivel.app.colours.all")
                missing = opened.run("nivel.app.stage.colourless")
                raise ModelError(
                    f"there are no colours by {look.colours!r}; there are {', '.join(known) or 'none'}"
                    + "".join(f"; {text}" for text in missing)
                )
            yield opened


def _span(page: Tab) -> tuple[float, float]:
    start, end = page.run("nivel.span()")
    return float(start), float(end)


Take = Callable[[bytes], Any]


@contextmanager
def _gif(path: Path, look: Look) -> Iterator[Take]:
    pictures: list[Any] = []

    def take(content: bytes) -> None:
        picture = PIL.Image.open(BytesIO(content)).convert("RGB")
        palette = pictures[0] if pictures else None  # the colours of the first picture serve all: none flickers
        pictures.append(picture.quantize(255, palette=palette, dither=PIL.Image.Dither.NONE))

    yield take
    content, duration = BytesIO(), round(1000 / look.rate)
    first, *others = pictures
    first.save(content, "GIF", save_all=True, append_images=others, duration=duration, loop=0, optimize=False)
    write_file(path, "film", content.getvalue())


@contextmanager
def _mp4(path: Path, look: Look) -> Iterator[Take]:
    program = _ffmpeg()
    with tempfile.TemporaryDirectory(prefix="nivel-film-") as folder:
        made = Path(folder) / "film.mp4"
        # players want even sizes and this kind of colours
        even = "scale=trunc(iw/2)*2:trunc(ih/2)*2"
        command = [program, "-y", "-loglevel", "error", "-f", "image2pipe", "-framerate", str(look.rate), "-i", "-"]
        command += ["-vf", even, "-pix_fmt", "yuv420p", "-movflags", "+faststart", str(made)]
        with tempfile.TemporaryFile() as said:
            running = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=said, stderr=said)
            assert running.stdin is not None
            try:
                yield running.stdin.write
                running.stdin.close()
                code = running.wait()
            except BrokenPipeError:
                code = running.wait()
            finally:
                if running.poll() is None:
                    running.kill()
                    running.wait()
            if code:
                said.seek(0)
                words = said.read().decode(errors="replace").strip().splitlines() or ["no reason given"]
                raise ModelError(f"ffmpeg failed: {words[-1]}")
        write_file(path, "film", made.read_bytes())


def _ffmpeg() -> str:
    program = shutil.which("ffmpeg")
    if program is not None:
        return program
    if not is_installed("imageio_ffmpeg"):
        raise ModelError(NO_FFMPEG)
    try:
        return imageio_ffmpeg.get_ffmpeg_exe()
    except RuntimeError:
        raise ModelError(NO_FFMPEG) from None
