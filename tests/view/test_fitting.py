"""A machine in frames of many sizes: it is whole, no control covers it, and it takes the room that there is."""

import pytest

import nivel
from browsing import drawn, until, watched
from nivel import Table
from nivel.demos import demo_file
from nivel.view.page import write_scene

MOMENTS = (0.0, 1.0, 2.0)
# left, upper, right and lower edge of the machine in the picture, in pixels, from all vertices of what is drawn of its bodies
REACH = """() => {
  const { world, actor } = nivel.app, frame = world.holder.getBoundingClientRect(), edge = [Infinity, Infinity, -Infinity, -Infinity];
  world.camera.updateMatrixWorld();
  actor.root.updateMatrixWorld(true);
  for (const { holder, geometry } of actor.solids) {
    const at = geometry.getAttribute("position"), point = world.camera.position.clone();
    for (let k = 0; k < at.count; k++) {
      point.fromBufferAttribute(at, k).applyMatrix4(holder.matrixWorld).project(world.camera);
      const x = frame.left + (0.5 + 0.5 * point.x) * frame.width, y = frame.top + (0.5 - 0.5 * point.y) * frame.height;
      edge.splice(0, 4, Math.min(edge[0], x), Math.min(edge[1], y), Math.max(edge[2], x), Math.max(edge[3], y));
    }
  }
  return edge;
}"""
BOX = "(name) => { const box = document.querySelector(name).getBoundingClientRect(); return [box.left, box.top, box.right, box.bottom]; }"


@pytest.fixture(scope="module")
def crane(tmp_path_factory):
    """The page of a loader crane that slews, raises its booms and pushes them out for two seconds."""
    full = Table((0.0, 0.5, 2.0), (0.0, 1.0, 1.0))
    machine = nivel.load(demo_file("loader-crane")).with_settings({"duration": 2.0})
    levers = ("slew_lever", "lift_lever", "jib_lever", "extension_lever")
    result = machine.simulate(inputs=dict.fromkeys(levers, full))
    return write_scene([result], tmp_path_factory.mktemp("fitting") / "crane.html")


def reach(page):
    """The edges of the machine over some moments of its motion."""
    seen = []
    for moment in MOMENTS:
        page.evaluate("(time) => nivel.app.goTo(time)", moment)
        drawn(page)
        seen.append(page.evaluate(REACH))
    low, high = zip(*[edges[:2] for edges in seen], strict=True), zip(*[edges[2:] for edges in seen], strict=True)
    return [*map(min, low), *map(max, high)]


@pytest.fixture(scope="module")
def page(crane, browser):
    with watched(browser, width=500, height=500) as seen:
        yield seen.open(crane.as_uri())


@pytest.mark.parametrize(("width", "height"), [(688, 430), (400, 430), (320, 240), (688, 200), (390, 800)])
def test_a_machine_is_whole_between_the_bars_of_its_page(width, height, page):
    page.set_viewport_size({"width": width, "height": height})
    drawn(page)
    until(page, f"nivel.app.world.holder.clientWidth === {width}")
    left, upper, right, lower = reach(page)
    top, bar, canvas = (page.evaluate(BOX, name) for name in (".top", ".timeline", ".view canvas"))
    assert canvas == [0, 0, width, height]
    assert top[1] >= 0
    assert bar[3] <= height
    assert left >= 0
    assert right <= width
    assert upper >= top[3]
    assert lower <= bar[1]
    # it touches the margin of one pair of edges: 8 % and a twentieth of its length, for signs and thicknesses
    assert max((right - left) / width, (lower - upper) / (bar[1] - top[3])) >= 0.6
    assert page.evaluate("[document.scrollingElement.scrollTop, document.documentElement.scrollHeight]") == [0, height]


def test_the_picture_on_the_first_page_has_three_quarters_of_its_frame(crane, browser, tmp_path):
    """The bars of a page in a frame of 688 x 430 take the rest."""
    outer = tmp_path / "outer.html"
    outer.write_text(f'<iframe src="{crane.as_uri()}" width="688" height="430" style="border:0"></iframe>', "utf-8")
    with watched(browser) as seen:
        seen.page.goto(outer.as_uri())
        until(seen.page, lambda: len(seen.page.frames) == 2 and seen.page.frames[1].evaluate("!!window.nivel"))
        page = seen.page.frames[1]
        top, bar = page.evaluate(BOX, ".top"), page.evaluate(BOX, ".timeline")
        assert (bar[1] - top[3]) / 430 >= 0.75
        assert bar[3] == 430
        left, upper, right, lower = page.evaluate(REACH)
        assert 0 <= left < right <= 688
        assert top[3] <= upper < lower <= bar[1]
