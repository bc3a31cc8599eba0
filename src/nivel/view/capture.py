"""Stills and films: the page draws them in a browser without a window, driven over Chromium's DevTools protocol."""

import base64
import itertools
import json
import os
import re
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.extras import is_installed, require
from nivel.files.target import write_file
from nivel.lazy import PIL, Struct, imageio_ffmpeg, websockets
from nivel.view.page import page_of
from nivel.view.sources import Source

if TYPE_CHECKING:
    from websockets.sync.client import ClientConnection


NAMES: Final = (
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "msedge",
    "brave-browser",
)
PLACES: Final = (
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
)
FLAGS: Final = (
    "--headless=new",
    "--remote-debugging-port=0",
    "--no-first-run",
    "--no-default-browser-check",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-extensions",
    "--hide-scrollbars",
    "--mute-audio",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
PATIENCE: Final = 90.0  # seconds for the browser to start, and for each of its answers
WANTED: Final = (
    "pictures and films are drawn by a browser, and none was found: install chromium, chrome or edge, "
    "or set the environment variable NIVEL_BROWSER to the program of one"
)


def find_browser() -> str | None:
    """The program of a browser of Chromium's family, or None: NIVEL_BROWSER, or the first that is found."""
    chosen = os.environ.get("NIVEL_BROWSER")
    if chosen:
        return shutil.which(chosen)
    found = next(filter(None, map(shutil.which, NAMES)), None)
    return found or next((place for place in PLACES if Path(place).is_file()), None)


class Tab:
    """A page in the browser."""

    def __init__(self, connection: "ClientConnection") -> None:
        self._connection = connection
        self._numbers = itertools.count(1)

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        """The answer to a command of the protocol; what happens meanwhile is passed over."""
        number = next(self._numbers)
        self._connection.send(json.dumps({"id": number, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self._connection.recv(timeout=PATIENCE))
            if answer.get("id") == number:
                if "error" in answer:
                    raise ModelError(f"the browser refused {method}: {answer['error'].get('message', '')}")
                return answer["result"]

    def run(self, expression: str) -> Any:
        """The value of an expression in the page, awaited."""
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise ModelError(f"the page failed in the browser: {answer['exceptionDetails'].get('text', '')}")
        return answer["result"].get("value")

    def picture(self) -> bytes:
        """What is on the screen, as PNG."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])


@contextmanager
def tab(page: Path, width: int, height: int, *, dark: bool) -> Iterator[Tab]:
    """The file `page` in a browser of this size.

    Raises ModelError where no browser is found or it does not start.
    """
    program = require_browser()
    with tempfile.TemporaryDirectory(prefix="nivel-browser-", ignore_cleanup_errors=True) as profile:
        running = _started(program, Path(profile))
        try:
            address = _address(running, Path(profile))
            with websockets.sync.client.connect(
                address, max_size=None, open_timeout=PATIENCE, compression=None
            ) as connection:
                opened = Tab(connection)
                opened.call(
                    "Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False
                )
                scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
                opened.call("Emulation.setEmulatedMedia", features=[scheme])
                opened.call("Page.navigate", url=page.as_uri())
                _wait_for(
                    opened,
                    "document.readyState === 'complete' && !!(window.nivel || document.querySelector('.complaint'))",
                )
                complaint = opened.run("document.querySelector('.complaint')?.textContent")
                if complaint:
                    raise ModelError(f"the page says in the browser: {complaint}")
                yield opened
        except (OSError, TimeoutError) as error:
            raise ModelError(f"{program} does not answer: {error}") from error
        finally:
            running.terminate()
            try:
                running.wait(10.0)
            except subprocess.TimeoutExpired:
                running.kill()
                running.wait()


def require_browser() -> str:
    """The program of a browser. Raises ModelError where there is none."""
    if (program := find_browser()) is not None:
        return program
    if not (chosen := os.environ.get("NIVEL_BROWSER")):
        raise ModelError(WANTED)
    said = "which is no program that can be started; set it to the program of chromium, chrome or edge"
    raise ModelError(f"NIVEL_BROWSER is `{chosen}`, {said}")


def _started(program: str, profile: Path) -> subprocess.Popen[bytes]:
    flags = [*FLAGS, f"--user-data-dir={profile}"]
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        flags.append("--no-sandbox")  # it refuses to start as root with one
    quiet = subprocess.DEVNULL
    try:
        return subprocess.Popen([program, *flags, "about:blank"], stdin=quiet, stdout=quiet, stderr=quiet)
    except OSError as error:
        raise ModelError(f"{program} cannot be started: {(error.strerror or str(error)).lower()}") from error


def _address(running: subprocess.Popen[bytes], profile: Path) -> str:
    """Of the first page of the browser, once it listens."""
    from urllib.error import URLError
    from urllib.request import ProxyHandler, build_opener

    port_file, end = profile / "DevToolsActivePort", time.monotonic() + PATIENCE
    straight = build_opener(ProxyHandler({}))
    while time.monotonic() < end:
        if running.poll() is not None:
            program = running.args[0] if isinstance(running.args, list) else running.args
            raise ModelError(
                f"{program} ended at once with code {running.returncode}: is it chromium, chrome or edge? "
                "NIVEL_BROWSER says which one is taken"
            )
        if port_file.exists() and (lines := port_file.read_text(encoding="utf-8").split()):
            try:
                with straight.open(f"http://127.0.0.1:{int(lines[0])}/json/list", timeout=5.0) as answer:
                    targets = json.load(answer)
            except (URLError, OSError, ValueError):
                targets = []
            for target in targets:
                if target.get("type") == "page":
                    return str(target["webSocketDebuggerUrl"])
        time.sleep(0.05)
    raise ModelError(f"the browser did not start within {PATIENCE:.0f} s")


def _wait_for(page: Tab, condition: str) -> None:
    end = time.monotonic() + PATIENCE
    while not page.run(condition):
        if time.monotonic() > end:
            raise ModelError("the page did not appear in the browser")
        time.sleep(0.05)


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
