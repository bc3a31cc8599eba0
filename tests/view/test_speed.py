"""50 bodies with a deforming mesh of 1000 vertices, and a chain of 300 links: drawn picture after picture, with what is near in detail."""

import threading
import time
from contextlib import contextmanager

import pytest

import many_bodies
from browsing import chromium, drawn, served, until, watched
from nivel.view.package import Block
from packages import Live

LEARNING = 48  # pictures in which the page finds out what this machine can do


@contextmanager
def going(stage, moment):
    """A source of a stage with a new moment a hundred times a second."""
    block = Block()
    source, running = Live(stage(block), block), threading.Event()
    running.set()
    source.show(0.0, *moment(0.0))

    def run():
        begin = time.perf_counter()
        while running.is_set():
            t = time.perf_counter() - begin
            source.show(t, *moment(t))
            time.sleep(1 / 100)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        yield source
    finally:
        running.clear()
        thread.join()


@contextmanager
def opened(stage, moment):
    """The page that shows a stage while it moves, and the way of its frames to it."""
    with (
        going(stage, moment) as live,
        served(live) as viewing,
        chromium() as browser,
        watched(browser, width=1024, height=640) as seen,
    ):
        page = seen.open(viewing.address.url)
        drawn(page, LEARNING)
        (stream,) = viewing.streams
        yield page, stream


@pytest.mark.parametrize(
    ("stage", "moment"),
    [
        pytest.param(many_bodies.stage, many_bodies.moment, marks=pytest.mark.full),
        pytest.param(many_bodies.chain, many_bodies.wave, marks=pytest.mark.full),
    ],
    ids=["fifty bodies and a mesh", "a chain of 300 links"],
)
def test_large_scenes_are_shown_moment_after_moment(stage, moment):
    """The page draws what it gets and asks for the next one, a hundred times; pictures follow moments."""
    with opened(stage, moment) as (page, stream):
        begin, first = stream.frame_count, page.evaluate("nivel.frames()")
        until(page, lambda: stream.frame_count >= begin + 100)
        until(page, f"nivel.frames() >= {first + 50}")


@pytest.mark.full
def test_frames_are_new_and_vertices_have_their_colours():
    count = "(() => { const m = nivel.app.actor.deforming[0].mesh.geometry; return [m.attributes.position.count,"
    colours = "new Set(Array.from(m.attributes.color.array).map((c) => c.toFixed(2))).size] })()"
    places = "nivel.app.actor.deforming[0].mesh.geometry.attributes.position.array"
    with opened(many_bodies.stage, many_bodies.moment) as (page, _):
        page.evaluate(f"window.first = {places}.slice()")
        until(page, f"{places}.some((x, k) => Math.abs(x - first[k]) > 1e-3)")
        vertices, tones = page.evaluate(count + colours)
    assert vertices == 1000
    assert tones > 20


@pytest.mark.full
def test_links_of_a_chain_are_solids_near_by_and_lines_from_afar():
    levels = "Array.from(nivel.app.actor.levels)"
    with opened(many_bodies.chain, many_bodies.wave) as (page, _):
        far = page.evaluate(levels)
        page.evaluate(
            "() => { nivel.app.choose({ kind: 'body', name: 'link_150' }); nivel.app.followOrFit(); nivel.app.world.zoom(0.01) }"
        )
        until(page, "nivel.app.actor.levels[150] === 0 && nivel.app.actor.levels[0] === 3")
        near = page.evaluate(levels)
    assert set(far) == {2}  # lines
    assert near[150] == 0  # everything is drawn of the link that is looked at
    assert near[0] == near[299] == 3  # nothing of those out of sight
