"""The report in a real browser: no error, all plots drawn, one cursor and one time range for all of them."""

import json
import re

import numpy as np
import pytest

import synthetic_run as pendulum
from browsing import titled, watched
from nivel.results import Memory

EVENTS = json.dumps(
    [{"name": name, "time": time, "direction": "rising"} for name, time in (("bottom", 3.0), ("top", 6.0))]
)
# notes down what is written in plots
WRITTEN = """window.written = [];
  const write = CanvasRenderingContext2D.prototype.fillText;
  CanvasRenderingContext2D.prototype.fillText = function (text, ...place) { written.push(text); write.call(this, text, ...place); };"""
# runs in the page: zooms the first plot with the mouse, looks at all, resets; what it saw goes into the title
SCRIPT = """
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const fire = (target, kind, x) => {
  const box = target.getBoundingClientRect();
  const at = { clientX: box.left + x * box.width, clientY: box.top + 40 };
  target.dispatchEvent(new MouseEvent(kind, { bubbles: true, button: 0, detail: 1, movementX: 5, ...at }));
};
const canvases = [...document.querySelectorAll(".plot .canvas canvas")];
const painted = canvases.map((c) => c.getContext("2d").getImageData(0, 0, c.width, c.height).data.some((v) => v > 0));
const ranges = () => [...new Set(seen.map((u) => [u.scales.x.min, u.scales.x.max].join()))].map((r) => r.split(",").map(Number));
const marks = (name) => written.filter((text) => text === name).length;
(async () => {
  const over = document.querySelector(".plot .u-over");
  await wait(50);
  const before = ranges(), marked = [marks("bottom"), marks("top")];
  written.length = 0;
  fire(over, "mouseenter", 0.25); fire(over, "mousemove", 0.25); fire(over, "mousedown", 0.25);
  fire(over, "mousemove", 0.4); fire(over, "mousemove", 0.5); fire(over, "mouseup", 0.5);
  await wait(50);
  marked.push(marks("bottom"), marks("top"));
  const zoomed = ranges(), shown = !document.getElementById("reset").hidden;
  fire(over, "mousemove", 0.5);
  await wait(20);
  const legends = [...document.querySelectorAll(".plot .u-legend")].map((legend) => legend.textContent);
  fire(over, "dblclick", 0.5);
  await wait(50);
  const reset = ranges(), hidden = document.getElementById("reset").hidden;
  const choice = document.querySelector(".plot select");
  choice.value = "1"; choice.dispatchEvent(new Event("change"));
  await wait(50);
  const times = Array.from({ length: 1000 }, (_, k) => 0.01 * k), turn = 2 * Math.PI;
  const wave = times.map((t) => 3 + 0.1 * Math.sin(2 * turn * t) + 0.03 * Math.cos(10 * turn * t));
  const { frequency, amplitude: a } = Spectra.amplitudes(wave, 0.01);
  const peaks = a.map((v, k) => [frequency[k], v]).filter(([, v], k) => v > 0.02 && v > (a[k - 1] ?? 0) && v > a[k + 1]);
  const fall = Spectra.waterfall(times, times.map((t) => Math.sin(turn * t * (1 + t))), 0.01);
  const loudest = fall.rows.map((row, k) => [fall.middles[k], fall.frequency[row.indexOf(Math.max(...row))]]);
  const views = [...document.querySelectorAll(".plot select.view:not([hidden])")];
  const isDrawn = (c) => c.getContext("2d").getImageData(0, 0, c.width, c.height).data.some((v) => v > 0);
  const drawn = [];
  for (const view of ["spectrum", "waterfall", "time"]) {
    for (const choice of views) { choice.value = view; choice.dispatchEvent(new Event("change")); }
    await wait(50);
    drawn.push(views.every((choice) => isDrawn(choice.closest(".plot").querySelector("canvas"))));
  }
  document.title = JSON.stringify({ peaks, loudest, views: views.length, drawn,
    painted, marked, before, zoomed, shown, legends, reset, hidden,
    unit: choice.closest(".plot").querySelector(".unit").textContent,
    wide: document.documentElement.scrollWidth - document.documentElement.clientWidth });
})();
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    memory = Memory()
    memory.begin(pendulum.header())
    memory.take(pendulum.frames(np.linspace(0.0, 8.0, 801)))
    path = memory.close({"outcome": "done", "events": EVENTS}).report(folder / "run.html")
    html = path.read_text(encoding="utf-8")
    # every plot that is made is noted down, then the script is appended
    html = html.replace(
        '"use strict";\n  const data', f'"use strict";\n  window.seen = [];\n  {WRITTEN}\n  const data', 1
    )
    html = html.replace("plots.set(card, plot);", "plots.set(card, plot); window.seen.push(plot);", 1)
    (folder / "driven.html").write_text(html.replace("</body>", f"<script>{SCRIPT}</script></body>"), encoding="utf-8")
    return folder


def browse(page, browser, width):
    """What the script in the page saw."""
    with watched(browser, width=width, height=1200) as seen:
        return titled(seen.page, page / "driven.html")


def test_the_report_works_in_a_browser(page, browser):
    seen = browse(page, browser, 1200)
    assert len(seen["painted"]) == 7
    assert all(seen["painted"])
    assert seen["before"] == [[0.0, 8.0]]
    # every plot marks the events between its ends
    first, other, zoomed, outside = seen["marked"]
    assert first == other >= 7
    assert zoomed >= 7
    assert outside == 0
    ((low, high),) = seen["zoomed"]  # one range for all plots
    assert (low, high) == (pytest.approx(2.0, abs=0.1), pytest.approx(4.0, abs=0.1))
    assert seen["reset"] == [[0.0, 8.0]]
    assert (seen["shown"], seen["hidden"]) == (True, True)
    for legend, unit in zip(seen["legends"][:4], ("rad", "m", "J", "J"), strict=True):
        assert re.search(rf"\d {unit}", legend), legend  # all cursors are where the first is
    assert seen["unit"] == "[rad/s]"
    assert seen["wide"] == 0

    # 0.1 sin(2π 2 t) + 0.03 cos(2π 10 t); and sin(2π t (1 + t)), whose frequency is 1 + 2 t
    np.testing.assert_allclose(seen["peaks"], [[2.0, 0.1], [10.0, 0.03]], rtol=1e-9)
    for middle, frequency in seen["loudest"]:
        assert frequency == pytest.approx(1 + 2 * middle, abs=1.0)
    assert seen["views"] >= 4
    assert all(seen["drawn"])


def test_the_report_fits_a_phone(page, browser):
    seen = browse(page, browser, 400)
    assert all(seen["painted"])
    assert seen["wide"] == 0
