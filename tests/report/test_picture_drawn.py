"""The picture in a report: names as a browser draws them keep apart, and it fills its card, whatever stands beside it."""

from itertools import combinations

import numpy as np
import pytest

import nivel
from example_files import EXAMPLES
from nivel.demos import demo_file
from nivel.looks.viewpoint import upwards
from nivel.report.picture import machine_picture

GAP = 4.5  # pixels between two names, a third of the height of a letter
# those with many joints at one point, or many names in little room
CROWDED = {
    **{f"demo {name}": demo_file(name) for name in ("loader-crane", "harbour-crane", "excavator")},
    **{
        name: EXAMPLES / f"{name}.yaml"
        for name in ("machines/washing-machine", "mechanisms/gear-train", "vehicles/suspension")
    },
}
BOXES = """() => [...document.querySelectorAll("svg text:not(.aid)")].map((text) => {
  const { x, y, width, height } = text.getBBox();
  return [text.textContent, x, y, x + width, y + height];
})"""


@pytest.fixture(scope="module")
def page(browser):
    page = browser.new_page()
    yield page
    page.close()


def gap(a, b):
    """Pixels between two boxes; negative where they lie over each other."""
    across = max(a[1], b[1]) - min(a[3], b[3])
    down = max(a[2], b[2]) - min(a[4], b[4])
    return max(across, down)


def test_names_keep_apart(page):
    close = []
    for example, file in CROWDED.items():
        machine = nivel.load(file)
        posed = machine.posed()
        up = np.array(upwards(machine.record.gravity))
        page.set_content(machine_picture(posed.scene, *posed.pose(), up))
        boxes = page.evaluate(BOXES)
        assert len(boxes) >= 4
        close += [(example, a[0], b[0]) for a, b in combinations(boxes, 2) if gap(a, b) < GAP]
    assert close == []


def test_the_picture_fills_its_card_beside_checks_that_did_not_pass(page, tmp_path):
    """The demo of a four-bar linkage has redundant constraints: its column of checks is long."""
    result = nivel.load(demo_file("four-bar")).simulate(duration=0.05, verify=False)
    assert "redundancy" in result.trust.found
    result.report(tmp_path / "report.html")
    page.set_viewport_size({"width": 1280, "height": 900})
    page.goto((tmp_path / "report.html").as_uri())
    card, picture = (page.locator(each).bounding_box() for each in (".card.picture", ".picture svg.machine"))
    head = page.locator(".picture-head").bounding_box()
    assert picture["y"] - (head["y"] + head["height"]) < 20
    assert card["y"] + card["height"] - (picture["y"] + picture["height"]) < 40
    assert picture["width"] > 0.9 * card["width"]
    assert picture["y"] + picture["height"] < 900  # all of it is in sight
