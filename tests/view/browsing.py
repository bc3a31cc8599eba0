"""A browser for tests: Debian's chromium without a window, drawing with the processor, and a server in a thread."""

import asyncio
import json
import os
import shutil
import threading
import time
from contextlib import contextmanager

import pytest

import needing
from nivel.view.server import Address, Viewing, start
from patience import PATIENCE

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
NO_BROWSER = "no chromium on this machine: what the page does in a browser is not tested"
with_browser = pytest.mark.skipif(CHROMIUM is None and not needing.MUST_RUN, reason=NO_BROWSER)
FLAGS = [
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    # the page around the picture is not put together by what draws the picture: with the processor that is a detour
    "--disable-gpu-compositing",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
]
# pixels of a picture for one of the page, along both sides, and of a shadow: with the processor it takes as long as it has pixels
COARSE = (
    "([ratio, pixels]) => { const { world } = nivel.app, { shadow } = world.sun;"
    "world.finest = world.ratio = ratio; shadow.mapSize.set(pixels, pixels); shadow.map?.dispose(); shadow.map = null;"
    "world.resize() }"
)
PIXELS = [0.4, 256]
# the first pictures of a page are drawn before it is told: their shadows, which have 2048 pixels along each side, are as coarse
COARSE_FROM_THE_START = """(() => {
  const gl = WebGL2RenderingContext.prototype, less = (pixels) => (pixels === 2048 ? 256 : pixels);
  const sized = (name, first, when = () => true) => {
    const before = gl[name];
    gl[name] = function (...given) {
      if (when(given)) for (const k of [first, first + 1]) given[k] = less(given[k]);
      return before.apply(this, given);
    };
  };
  sized("viewport", 2);
  sized("renderbufferStorage", 2);
  sized("texStorage2D", 3);
  sized("texImage2D", 3, (given) => given.length === 9 && given[8] === null);
})()"""
LOCAL = ("file:", "data:", "blob:", "about:", "http://127.0.0.1:")


class Running:
    """The browser of this process, its driver and the event loop of both."""

    def __init__(self):
        self.driver = needing.needs("playwright.sync_api").sync_playwright().start()
        root = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        self.browser = self.driver.chromium.launch(
            executable_path=CHROMIUM, args=[*FLAGS, *root], timeout=1000 * PATIENCE
        )
        self.loop = asyncio.get_running_loop()

    def close(self):
        with going_on(self.loop):
            self.browser.close()
            self.driver.stop()


RUNNING: list[Running] = []
# pages without a test, by scheme and touch
FREE = {}


@contextmanager
def going_on(loop):
    """`loop` counts as running, as Playwright leaves it between two calls; outside of this a test may run a loop of its own."""
    before = asyncio._get_running_loop()
    asyncio._set_running_loop(loop)
    try:
        yield
    finally:
        asyncio._set_running_loop(before)


@contextmanager
def chromium():
    """The one browser of this process, without the pages that were opened meanwhile; without a browser a skipped test with the reason, or
    a failed one in CI."""
    if CHROMIUM is None:
        needing.miss(NO_BROWSER)
    with going_on(asyncio._get_running_loop()):
        if RUNNING and not RUNNING[0].browser.is_connected():
            close()
        if not RUNNING:
            RUNNING.append(Running())
    with going_on(RUNNING[0].loop):
        browser = RUNNING[0].browser
        before = list(browser.contexts)
        try:
            yield browser
        finally:
            free = [page.context for page in FREE.values()]
            for context in browser.contexts:
                if context not in before and context not in free:
                    context.close()


def close():
    """End the browser of this process, if one was started."""
    FREE.clear()
    while RUNNING:
        RUNNING.pop().close()


def until(page, condition, patience=PATIENCE):
    """Wait until an expression is true in a page, whose policy forbids it to evaluate texts by itself; or until a function says so."""
    end = time.monotonic() + patience
    while not (condition() if callable(condition) else page.evaluate(condition)):
        assert time.monotonic() < end, f"never: {condition}"
        page.wait_for_timeout(25)


def drawn(page, pictures=2):
    """Wait until so many further pictures are on the screen. One is drawn only when something changed: each is asked for."""
    page.evaluate("(more) => { window.awaited = nivel.frames() + more }", pictures)
    until(page, "(nivel.app.world.invalidate(), nivel.frames() >= awaited)")


def landed(page):
    """Wait until the camera is where it was told to go, and shows it."""
    until(page, "nivel.app.world.flight === null")
    drawn(page)


class Watched:
    """A page and everything that went wrong in it: `said` errors and warnings, `left` requests to other machines.

    The page of an earlier test serves again, empty, where scheme and touch are the same: a new one has to read all scripts anew.
    """

    def __init__(self, browser, *, width=1280, height=800, scheme="light", touch=False):
        self.kind = scheme, touch
        self.page = FREE.pop(self.kind, None)
        if self.page is None:
            self.page = browser.new_context(color_scheme=scheme, has_touch=touch).new_page()
            self.page.add_init_script(COARSE_FROM_THE_START)
        self.context = self.page.context
        self.context.set_default_timeout(1000 * PATIENCE)
        self.page.set_viewport_size({"width": width, "height": height})
        self.said, self.left = [], []
        self.heard = {"console": self._console, "pageerror": self._error, "request": self._request}
        for event, hear in self.heard.items():
            self.page.on(event, hear)

    def _error(self, error):
        self.said.append(str(error))

    def _request(self, request):
        if not request.url.startswith(LOCAL):
            self.left.append(request.url)

    def _console(self, message):
        # drawing with the processor is slow to read back, which tests do and users do not
        if message.type in ("error", "warning") and "GPU stall due to ReadPixels" not in message.text:
            self.said.append(message.text)

    def open(self, address):
        self.page.goto(address)
        until(self.page, "!!window.nivel")
        self.page.evaluate(COARSE, PIXELS)
        drawn(self.page)
        return self.page

    def pose(self, body=0):
        """Position and Euler parameters (scalar first) of a body as they are drawn."""
        return self.page.evaluate(
            "(k) => { const { bodies, stage } = nivel.app.actor, p = bodies[k].position, q = bodies[k].quaternion;"
            "return [...[p.x, p.y, p.z].map((x, i) => x + stage.origin[i]), q.w, q.x, q.y, q.z]; }",
            body,
        )

    def close(self):
        """Leave the page, and fail on whatever went wrong."""
        self.page.goto("about:blank")
        for event, hear in self.heard.items():
            self.page.remove_listener(event, hear)
        self.page.unroute_all()
        self.context.set_offline(False)
        if self.kind in FREE:
            self.context.close()
        else:
            FREE[self.kind] = self.page
        assert self.said == []
        assert self.left == []


@contextmanager
def watched(browser, **given):
    """A watched page; on the way out everything must have gone well."""
    page = Watched(browser, **given)
    try:
        yield page
    except BaseException:
        page.context.close()
        raise
    page.close()


def titled(page, file):
    """What a script of the page in `file` wrote as its title, in JSON."""
    page.goto(file.as_uri())
    until(page, "document.title.startsWith('{')")
    return json.loads(page.title())


@contextmanager
def served(source, address=None):
    """The viewing of a source that is served in another thread."""
    viewing, ready, loop = Viewing(source, address or Address()), threading.Event(), asyncio.new_event_loop()
    stop = asyncio.Event()

    async def serve():
        async with await start(viewing):
            ready.set()
            await stop.wait()

    thread = threading.Thread(target=lambda: loop.run_until_complete(serve()), daemon=True)
    thread.start()
    assert ready.wait(PATIENCE)
    try:
        yield viewing
    finally:
        loop.call_soon_threadsafe(stop.set)
        thread.join(PATIENCE)
        loop.close()
