"""A browser without a window, driven over Chromium's DevTools protocol: one page, loaded from a file."""

import base64
import itertools
import json
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from nivel.errors import ModelError
from nivel.lazy import websockets

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
