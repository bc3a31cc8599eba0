"""Looking around with the mouse, with fingers, and at the parts of a machine."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import nivel
from browsing import drawn, landed, until, watched
from nivel.view.page import write_scene

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
EYE, AIM = "nivel.app.world.camera.position.toArray()", "nivel.app.world.controls.target.toArray()"


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    result = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml").simulate(duration=1)
    return result, write_scene([result], tmp_path_factory.mktemp("scene") / "scene.html")


def looked_from(page):
    """Where the eye is, and what it is aimed at."""
    drawn(page)
    return np.array(page.evaluate(EYE)), np.array(page.evaluate(AIM))


def drag(page, button, across, down):
    page.mouse.move(600, 300)
    page.mouse.down(button=button)
    page.mouse.move(600 + across, 300 + down, steps=5)
    page.mouse.up(button=button)


# pixels on the page: what no panel covers, and the points around the machine as it stands
FREE = """['.panel.left', '.top', '.panel.right', '.timeline'].map((name) => document.querySelector(name).getBoundingClientRect())
  .map((box, k) => [box.right, box.bottom, box.left, box.top][k])"""
NOW = """nivel.app.world.now().map((point) => point.project(nivel.app.world.camera))
  .map(({ x, y }) => [0.5 * (1 + x) * innerWidth, 0.5 * (1 - y) * innerHeight])"""


def test_the_mouse_turns_shifts_and_zooms(browser, scene):
    with watched(browser) as seen:
        page = seen.open(scene[1].as_uri())
        eye, aim = looked_from(page)
        drag(page, "left", 80, 30)
        turned, still = looked_from(page)
        np.testing.assert_allclose(still, aim, atol=1e-9)
        assert np.linalg.norm(turned - aim) == pytest.approx(np.linalg.norm(eye - aim), rel=1e-6)
        assert np.linalg.norm(turned - eye) > 0.1 * np.linalg.norm(eye - aim)
        drag(page, "right", 60, 0)
        shifted, moved = looked_from(page)
        np.testing.assert_allclose(shifted - moved, turned - aim, atol=1e-6)
        assert np.linalg.norm(moved - aim) > 1e-2
        page.mouse.move(600, 300)
        page.mouse.wheel(0, -400)
        until(page, f"Math.hypot(...{EYE}.map((x, k) => x - [{','.join(map(str, shifted))}][k])) > 1e-3")
        near, at = looked_from(page)
        assert np.linalg.norm(near - at) < 0.98 * np.linalg.norm(shifted - moved)
        page.get_by_role("button", name="Fit to the present position").click()
        landed(page)
        fitted, again = looked_from(page)
        # what stands there now is in the middle of the free part of the picture, nearer than where the whole motion is in sight
        left, upper, right, lower = page.evaluate(FREE)
        points = np.array(page.evaluate(NOW))
        low, high = points.min(axis=0), points.max(axis=0)
        room = np.array([right - left, lower - upper])
        assert np.all(low >= (left, upper))
        assert np.all(high <= (right, lower))
        np.testing.assert_allclose(
            0.5 * (low + high), (0.5 * (left + right), 0.5 * (upper + lower)), atol=0.05 * room.max()
        )
        assert np.max((high - low) / room) > 0.7
        assert np.linalg.norm(fitted - again) < np.linalg.norm(eye - aim)


def test_fingers_turn_and_zoom(browser, scene):
    with watched(browser, width=390, height=800, touch=True) as seen:
        page = seen.open(scene[1].as_uri())
        fingers = seen.context.new_cdp_session(page)

        def touch(kind, *points):
            points = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(points)]
            fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        eye, aim = looked_from(page)
        touch("touchStart", (200, 300))
        for k in range(1, 6):
            touch("touchMove", (200 + 12 * k, 300))
        touch("touchEnd")
        turned, still = looked_from(page)
        np.testing.assert_allclose(still, aim, atol=1e-9)
        assert np.linalg.norm(turned - eye) > 0.1 * np.linalg.norm(eye - aim)
        touch("touchStart", (170, 300), (220, 300))
        for k in range(1, 6):
            touch("touchMove", (170 - 10 * k, 300), (220 + 10 * k, 300))
        touch("touchEnd")
        near, at = looked_from(page)
        assert np.linalg.norm(near - at) < 0.8 * np.linalg.norm(turned - aim)


def test_of_what_is_chosen_data_are_shown_and_plotted_and_its_markers_traced(browser, scene):
    result, file = scene
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        page.get_by_role("button", name="hinge, revolute", exact=True).click()
        own = [name for name in result.names if name.startswith("hinge.")]
        labels = [each.get_attribute("aria-label") for each in page.locator(".variables button").all()]
        assert labels
        assert set(labels) <= {f"Plot {name}" for name in own}
        assert "Plot hinge.force.x" in labels
        page.get_by_role("button", name="Plot hinge.force.x", exact=True).click()
        until(page, "document.querySelector('.plots').textContent.includes('hinge.force.x')")
        page.keyboard.press("Escape")
        page.get_by_role("button", name="crank", exact=True).click()
        page.get_by_role("button", name="Trace centre of mass").click()
        page.get_by_role("button", name="Trace crank_pin").click()
        page.evaluate(f"nivel.app.goTo({float(result.time[-1])!r})")
        drawn(page)
        assert page.evaluate("nivel.app.traces.keys") == ["body crank", "marker crank_pin"]
        traced = "Array.from(nivel.app.traces.paths.get('marker crank_pin').whole.geometry.attributes.position.array)"
        point = next(each["position"] for each in result.scene["markers"] if each["name"] == "crank_pin")
        turned = Rotation.from_quat(result.array("crank.orientation"), scalar_first=True)
        expected = result.array("crank.position") + turned.apply(point)
        np.testing.assert_allclose(np.reshape(page.evaluate(traced), (-1, 3)), expected, atol=1e-5)
