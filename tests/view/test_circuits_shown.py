"""The diagram of hydraulic circuits in the page, with the pressures of the moment."""

import re
from pathlib import Path

import numpy as np
import pytest

import nivel
from browsing import until, watched
from nivel.view.package import Block
from nivel.view.page import write_scene
from nivel.view.playback import ALONE, stage

FILE = Path(__file__).parents[2] / "examples" / "hydraulics" / "cylinder-boom.yaml"


@pytest.fixture(scope="module")
def result():
    return nivel.load(FILE).simulate(duration=0.6)


def test_the_package_has_a_diagram_that_names_what_it_shows(result):
    shown = stage(result, ALONE, Block())
    names = re.findall(r'data-pressure="([^"]+)"', shown.circuit)
    assert sorted(names) == ["lift.pressure_A", "lift.pressure_B", "supply.pressure"]
    carried = {column.name for column in shown.columns if column.values is not None}
    assert {f"hydraulics.{name}" for name in names} <= carried


def test_machines_without_circuits_have_no_diagram():
    pendulum = nivel.load(FILE.parents[1] / "mechanisms" / "simple-pendulum.yaml").simulate(duration=0.01)
    assert stage(pendulum, ALONE, Block()).circuit == ""


@pytest.mark.full
def test_pressures_follow_the_cursor_and_a_click_plots_one(result, tmp_path, browser):
    write_scene([result], tmp_path / "page.html")
    with watched(browser) as seen:
        page = seen.open((tmp_path / "page.html").as_uri())
        for time in (0.0, 0.5):
            page.evaluate(f"nivel.app.goTo({time})")
            k = int(np.argmin(np.abs(result.time - time)))
            for name in ("supply.pressure", "lift.pressure_A"):
                wanted = float(result.array(f"hydraulics.{name}")[k]) / 1e5
                place = f"document.querySelector('[data-pressure=\"{name}\"]').textContent"
                until(page, f"Math.abs(parseFloat({place}) - {wanted}) < 1e-3 * {wanted}")
        page.locator("text:has([data-pressure='supply.pressure'])").click()
        until(page, "document.querySelector('.plots').textContent.includes('supply.pressure')")
