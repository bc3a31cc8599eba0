"""50 bodies and a deforming mesh of 1000 vertices: pictures a second in software rendering, server time a frame."""

import threading
import time

import pytest

from browsing import chromium, served, watched
from many_bodies import moment, stage
from nivel.view.package import Block
from nivel.view.sources import Live

ENOUGH = 30.0  # frames a second
ATTEMPTS = 15  # a busy machine spoils some
SERVER_TIME = 0.3e-3  # [s] a frame


@pytest.fixture
def live():
    block = Block()
    source, going = Live(stage(block), block), threading.Event()
    going.set()
    source.show(0.0, *moment(0.0))

    def run():
        begin = time.perf_counter()
        while going.is_set():
            t = time.perf_counter() - begin
            source.show(t, *moment(t))
            time.sleep(1 / 100)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    yield source
    going.clear()
    thread.join()


def test_fifty_bodies_and_a_deforming_mesh_are_shown_at_thirty_frames_a_second(live):
    with served(live) as viewing, chromium() as browser, watched(browser, width=1024, height=640) as page:
        page.open(viewing.address.url)
        page.page.wait_for_timeout(2500)  # it finds out what this machine can do
        rates = []
        for _ in range(ATTEMPTS):
            before, begin = page.page.evaluate("nivel.frames()"), time.perf_counter()
            page.page.wait_for_timeout(2000)
            rates.append((page.page.evaluate("nivel.frames()") - before) / (time.perf_counter() - begin))
            if rates[-1] >= ENOUGH:
                break
        (stream,) = viewing.streams
        shown, made = stream.frame_count, stream.send_seconds
        print(f"{rates} frames a second, {1e3 * made / shown:.3f} ms of server time a frame")
        # frames are new: the mesh moves, and its vertices have colours
        seen = page.page.evaluate(
            "() => { const m = nivel.app.actor.deforming[0].mesh.geometry; return [m.attributes.position.count,"
            "new Set(Array.from(m.attributes.color.array).map((c) => c.toFixed(2))).size] }"
        )
    assert max(rates) >= ENOUGH
    assert made / shown <= SERVER_TIME
    assert seen[0] == 1000
    assert seen[1] > 20
