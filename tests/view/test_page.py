"""The page in a browser: every example plays, scrubs and opens from a file; nothing is complained of, nothing leaves the machine."""

import json
import runpy
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import nivel
import synthetic_run as pendulum
from browsing import drawn, landed, served, until, watched
from example_files import RIGID
from lanes import tail
from nivel.results import Memory
from nivel.view.page import write_scene
from nivel.view.sources import Playback
from patience import PATIENCE
from playing import assert_plays_and_scrubs

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
MACHINES = [*RIGID, EXAMPLES / "mechanisms" / "double_pendulum.py"]
SHOWN = [path for path in MACHINES if path.stem == "slider-crank"]


@cache
def result_of(path):
    if path.suffix == ".py":
        return runpy.run_path(str(path))["machine"].simulate(duration=1)
    return nivel.load(path, allow_code=True).simulate()


@pytest.mark.parametrize("path", tail(MACHINES, SHOWN), ids=lambda path: path.stem)
def test_every_example_plays_scrubs_and_opens_from_a_file(path, browser, tmp_path):
    assert_plays_and_scrubs(browser, result_of(path), tmp_path / "scene.html")


def test_the_served_page_fetches_what_it_plots(browser):
    result = result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    with served(Playback([result])) as viewing, watched(browser) as seen:
        page = seen.open(viewing.address.url)
        page.get_by_role("button", name="crank", exact=True).click()
        page.get_by_role("button", name="Plot crank.position.y").click()
        until(page, "document.querySelectorAll('.chart canvas').length === 2")
        page.keyboard.press("Escape")
        page.evaluate("nivel.app.goTo(1.307)")
        frame = int(np.searchsorted(result.time, page.evaluate("nivel.app.player.time"), side="right") - 1)
        shown = page.locator(".readout li", has_text="crank.position.y").locator("b").inner_text()
        assert float(shown.replace("−", "-")) == pytest.approx(result.array("crank.position.y")[frame], rel=1e-4)
        # a click into a plot moves the picture there
        box = page.locator(".chart .u-over").first.bounding_box()
        page.mouse.click(box["x"] + box["width"] / 2, box["y"] + 20)
        assert page.evaluate("nivel.app.player.time") == pytest.approx(4.0, abs=0.2)


def test_a_ball_and_a_free_body_are_moved_by_their_sliders(browser):
    body = {"mass": 1, "inertia": (0.1, 0.1, 0.1)}
    machine = nivel.Machine(
        "balls",
        bodies=[
            nivel.Body(name="bob", position=(0, 0, -1), **body),
            nivel.Body(name="kite", position=(1, 0, 0), **body),
        ],
        joints=[nivel.Joint(name="ball", type="spherical", bodies=("ground", "bob"), point=(0, 0, 0))],
    )
    with served(machine.viewer_source()) as viewing, watched(browser) as seen:
        page = seen.open(viewing.address.url)
        names = [each.get_attribute("aria-label") for each in page.locator(".coordinates input").all()]
        turns = ["angle_x", "angle_y", "angle_z"]
        assert names == [*(f"ball.{name}" for name in turns), *(f"kite.{name}" for name in ["x", "y", "z", *turns])]
        page.get_by_role("slider", name="ball.angle_x").fill("0.5")
        until(page, "Math.abs(nivel.app.actor.bodies[0].position.y - Math.sin(0.5)) < 1e-5")
        page.get_by_role("slider", name="kite.z", exact=True).fill("0.7")
        until(page, "Math.abs(nivel.app.actor.bodies[1].position.z - 0.7) < 1e-5")


def test_a_machine_is_moved_by_its_sliders(browser):
    source = nivel.load(EXAMPLES / "mechanisms" / "four-bar.yaml").viewer_source()
    with served(source) as viewing, watched(browser) as seen:
        page = seen.open(viewing.address.url)
        before = np.array(seen.pose(1))
        slider = page.get_by_role("slider", name="crank_pivot.angle")
        slider.focus()
        for _ in range(20):
            page.keyboard.press("ArrowRight")
        wanted = float(slider.input_value())
        assert wanted > source._movable.movements[0].value + 0.05
        until(page, lambda: abs(source._movable.values()[0] - wanted) < 1e-9)
        until(page, lambda: np.allclose(seen.pose(1)[:3], source._movable.pose()[0][1], atol=1e-5))
        assert np.abs(np.array(seen.pose(1)) - before).max() > 1e-3
        page.get_by_role("button", name="Back to the assembled position").click()
        until(page, lambda: np.allclose(seen.pose(1), before, atol=1e-5))


def test_the_time_is_dragged_with_the_mouse_and_tapped_with_a_finger(browser, tmp_path):
    file = write_scene([result_of(EXAMPLES / "mechanisms" / "simple-pendulum.yaml")], tmp_path / "scene.html")
    with watched(browser, touch=True) as seen:
        page = seen.open(file.as_uri())
        start, end = page.evaluate("nivel.span()")
        box = page.get_by_role("slider", name="Time").bounding_box()
        y = box["y"] + box["height"] / 2

        def share():
            return (page.evaluate("nivel.app.player.time") - start) / (end - start)

        page.mouse.move(box["x"] + 0.1 * box["width"], y)
        page.mouse.down()
        page.mouse.move(box["x"] + 0.8 * box["width"], y, steps=4)
        page.mouse.up()
        assert share() == pytest.approx(0.8, abs=0.02)
        # also while it plays
        page.get_by_role("button", name="Play", exact=True).click()
        page.touchscreen.tap(box["x"] + 0.25 * box["width"], y)
        until(page, "!nivel.app.player.playing")
        assert share() == pytest.approx(0.25, abs=0.02)


def test_a_body_moved_out_of_the_picture_is_followed(browser):
    body = {"mass": 1, "inertia": (0.1, 0.1, 0.1), "shape": {"type": "sphere", "radius": 0.05}}
    bodies = [
        nivel.Body(name="kite", position=(0, 0, 0), **body),
        nivel.Body(name="rock", position=(0.3, 0, 0), **body),
    ]
    joints = [nivel.Joint(name="hold", type="fixed", bodies=("ground", "rock"), point=(0.3, 0, 0))]
    inside = (
        "(() => { const { x, y } = nivel.app.actor.bodies[0].position.clone().project(nivel.app.world.camera);"
        "return Math.abs(x) < 1 && Math.abs(y) < 1 })()"
    )
    with (
        served(nivel.Machine("far", bodies=bodies, joints=joints).viewer_source()) as viewing,
        watched(browser) as seen,
    ):
        page = seen.open(viewing.address.url)
        slider = page.get_by_role("slider", name="kite.z", exact=True)
        for share, looks_closer in ((1.0, False), (-1.0, True)):
            if looks_closer:
                page.evaluate("nivel.app.world.zoom(0.5)")
            place = share * float(slider.get_attribute("max"))
            slider.fill(str(place))
            until(page, f"Math.abs(nivel.app.actor.bodies[0].position.z - {place}) < 1e-5")
            landed(page)
            assert page.evaluate(inside)
        # what is in sight stays as it is looked at
        eye = "nivel.app.world.camera.position.toArray()"
        before = page.evaluate(eye)
        slider.fill(str(0.95 * place))
        until(page, f"Math.abs(nivel.app.actor.bodies[0].position.z - {0.95 * place}) < 1e-5")
        landed(page)
        np.testing.assert_allclose(page.evaluate(eye), before)


def test_fit_finds_a_machine_that_was_moved_away(browser):
    kite = nivel.Body(
        name="kite", mass=1, inertia=(0.1, 0.1, 0.1), position=(0, 0, 0), shape={"type": "sphere", "radius": 0.05}
    )
    with served(nivel.Machine("far", bodies=[kite]).viewer_source()) as viewing, watched(browser) as seen:
        page = seen.open(viewing.address.url)
        page.get_by_role("slider", name="kite.x", exact=True).fill("1")
        until(page, "Math.abs(nivel.app.actor.bodies[0].position.x - 1) < 1e-5")
        page.get_by_role("button", name="Fit to the present position").click()
        until(page, "nivel.app.world.controls.target.distanceTo(nivel.app.actor.bodies[0].position) < 0.01")


def kept(failure="", joint_torque=0.0):
    """A second of the pendulum: one that failed where a `failure` is given."""
    time = np.linspace(0.0, 1.0, 101)
    values = pendulum.histories(time)
    values["joint_torque"] = values["joint_torque"] + joint_torque
    memory = Memory()
    memory.begin(pendulum.header(failure=failure))
    memory.take(pendulum.packed(time, values))
    return memory.close({"outcome": "failed" if failure else "done"})


def test_notes_of_several_lines_cover_no_panel(browser, tmp_path):
    result = kept(failure="a long story of what went wrong " * 8)
    file = write_scene([result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        notes, panel = (page.locator(each).first.bounding_box() for each in (".notes", ".panel.structure"))
        assert notes["y"] + notes["height"] <= panel["y"]


def test_torques_that_are_round_off_have_no_arrows(browser, tmp_path):
    file = write_scene([kept(joint_torque=1e-13)], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        assert page.evaluate("nivel.app.arrows.has('reaction-force')")
        assert not page.evaluate("nivel.app.arrows.has('reaction-torque')")


def test_keys_do_what_the_help_says(browser, tmp_path):
    result = result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    file = write_scene([result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        page.locator("canvas").first.focus()
        time = lambda: page.evaluate("nivel.app.player.time")  # noqa: E731
        page.keyboard.press("ArrowRight")
        assert time() == pytest.approx(result.time[1])
        page.keyboard.press("Shift+ArrowRight")
        assert time() == pytest.approx(result.time[11])
        page.keyboard.press("ArrowLeft")
        assert time() == pytest.approx(result.time[10])
        page.keyboard.press("End")
        assert time() == pytest.approx(result.time[-1])
        page.keyboard.press("Home")
        assert time() == 0.0
        page.keyboard.press("+")
        assert page.evaluate("nivel.app.player.speed") == 2
        page.keyboard.press("-")
        page.keyboard.press("l")
        assert page.evaluate("nivel.app.player.loop") is False
        page.keyboard.press("Space")
        assert page.evaluate("nivel.app.player.playing") is True
        page.keyboard.press("Space")
        # views: gravity is along -Y, so the top is seen from +Y
        page.keyboard.press("3")
        landed(page)
        towards = page.evaluate(
            "() => { const w = nivel.app.world, v = w.camera.position.clone().sub(w.controls.target).normalize(); return v.toArray() }"
        )
        np.testing.assert_allclose(towards, [0, 1, 0], atol=5e-3)
        page.keyboard.press("?")
        assert page.get_by_role("dialog").is_visible()
        page.keyboard.press("Escape")
        # follow a body
        page.get_by_role("button", name="rod", exact=True).click()
        page.locator("canvas").first.focus()
        page.keyboard.press("f")
        page.evaluate("nivel.app.goTo(1.0)")
        drawn(page)
        target = page.evaluate("nivel.app.world.controls.target.toArray()")
        np.testing.assert_allclose(target, seen.pose(1)[:3], atol=1e-4)


def test_everything_can_be_switched_on_without_complaint(browser, tmp_path):
    result = result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    file = write_scene([result, result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        page.get_by_role("button", name="Display", exact=True).click()
        for switch in page.get_by_role("switch").all():
            switch.check()
        page.evaluate("nivel.app.goTo(2.0)")
        drawn(page)
        lengths = page.evaluate("nivel.app.arrows.drawn.filter((a) => a.visible).length")
        assert lengths >= 3
        assert page.evaluate("nivel.app.violations.exaggeration") >= 1e3
        page.get_by_role("button", name="Data and plots", exact=True).click()
        page.get_by_role("button", name="rod", exact=True).click()
        page.get_by_role("button", name="Trace centre of mass").click()
        assert page.evaluate("nivel.app.traces.keys") == ["body rod"]


def test_every_joint_is_read_as_name_and_kind_and_plots_are_reached_by_keys(browser, tmp_path):
    result = result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    file = write_scene([result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        joints = [(joint["name"], joint["type"]) for joint in result.scene["joints"]]
        for name, kind in joints:
            assert page.get_by_role("button", name=f"{name}, {kind}", exact=True).count() == 1
        plot = page.get_by_role("slider", name="Moment in the plot of").first
        plot.focus()
        page.keyboard.press("ArrowRight")
        assert page.evaluate("nivel.app.player.frame") == 1
        page.keyboard.press("End")
        assert float(plot.get_attribute("aria-valuenow")) == pytest.approx(result.time[-1])
        assert plot.get_attribute("aria-valuetext").startswith(f"{result.time[-1]:g} s: ")


def test_of_sheets_one_stays_when_the_page_gets_narrow(browser, tmp_path):
    file = write_scene([result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml")], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        assert page.locator(".panel:visible").count() == 2
        page.set_viewport_size({"width": 390, "height": 800})
        until(page, lambda: page.locator(".panel:visible").count() == 1)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_a_ghost_is_named_and_of_another_machine_said_to_be_one(browser, tmp_path):
    one, other = (
        result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml"),
        result_of(EXAMPLES / "mechanisms" / "simple-pendulum.yaml"),
    )
    with watched(browser) as seen:
        page = seen.open(write_scene([one, one], tmp_path / "same.html").as_uri())
        assert page.locator(".notes .ghost").inner_text() == f"Ghost: {one.name}"
        assert one.name in page.locator(".chart figcaption").first.inner_text()
        page = seen.open(write_scene([one, other], tmp_path / "other.html").as_uri())
        assert page.locator(".notes .ghost").inner_text() == f"Ghost: {other.name}, another machine"


def test_negative_times_play_and_scrub(browser, tmp_path):
    memory = Memory()
    memory.begin(pendulum.header())
    memory.take(pendulum.packed(np.linspace(-2.0, -1.0, 101), pendulum.histories(np.linspace(0.0, 1.0, 101))))
    file = write_scene([memory.close({"outcome": "done"})], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        assert page.evaluate("nivel.span()") == [-2.0, -1.0]
        assert page.locator("output.time").inner_text().startswith("−2.0")
        page.get_by_role("slider", name="Time").focus()
        page.keyboard.press("ArrowRight")
        assert page.evaluate("nivel.app.player.time") == pytest.approx(-1.99)
        page.keyboard.press("End")
        assert page.evaluate("nivel.app.player.time") == -1.0


def test_a_click_into_the_picture_chooses_a_body(browser, tmp_path):
    file = write_scene([result_of(EXAMPLES / "mechanisms" / "simple-pendulum.yaml")], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        x, y = page.evaluate(
            "() => { const a = nivel.app, v = a.actor.bodies[0].position.clone().project(a.world.camera), c = a.world.renderer.domElement;"
            "return [(v.x + 1) / 2 * c.clientWidth, (1 - v.y) / 2 * c.clientHeight] }"
        )
        page.mouse.click(x, y)
        assert page.locator(".chosen h2").inner_text() in ("bob", "hinge")


@pytest.mark.parametrize(
    ("width", "height", "scheme"),
    [
        (1280, 800, "light"),
        (390, 800, "dark"),
        pytest.param(1280, 800, "dark", marks=pytest.mark.full),
        pytest.param(390, 800, "light", marks=pytest.mark.full),
    ],
)
def test_the_page_fits_its_window_and_every_control_has_a_name(browser, tmp_path, scheme, width, height):
    file = write_scene([result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml")], tmp_path / "scene.html")
    with watched(browser, width=width, height=height, scheme=scheme, touch=width < 500) as seen:
        page = seen.open(file.as_uri())
        for name in ("Structure", "Data and plots", "Display"):
            button = page.get_by_role("button", name=name, exact=True)
            if button.get_attribute("aria-pressed") != "true":
                button.click()
            drawn(page)
            outside = page.evaluate(
                "() => [...document.querySelectorAll('button, input, select, .panel, .timeline, .top')].filter((e) => {"
                "const b = e.getBoundingClientRect(); return b.width && (b.left < -1 || b.right > innerWidth + 1) })"
                ".map((e) => e.outerHTML.slice(0, 80))"
            )
            assert outside == []
        nameless = page.evaluate(
            "() => [...document.querySelectorAll('button, input, select')].filter((e) => !e.getAttribute('aria-label') &&"
            "!e.textContent.trim() && !(e.labels && e.labels.length)).length"
        )
        assert nameless == 0
        assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_poses_that_are_not_finite_hide_their_body(browser, tmp_path):
    time = np.linspace(0.0, 1.0, 101)
    values = pendulum.histories(time)
    values["position"][50:] = np.nan
    memory = Memory()
    memory.begin(pendulum.header(outcome="failed", failure="the step became too small"))
    memory.take(pendulum.packed(time, values))
    file = write_scene([memory.close({"outcome": "failed"})], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        assert "the step became too small" in page.locator(".notes").inner_text()
        page.evaluate("nivel.app.goTo(0.9)")
        assert page.evaluate("nivel.app.actor.bodies[0].visible") is False
        page.evaluate("nivel.app.goTo(0.1)")
        assert page.evaluate("nivel.app.actor.bodies[0].visible") is True


def inner(page):
    """The page of the viewer inside another page."""
    until(page, lambda: len(page.frames) > 1 and page.frames[1].evaluate("!!window.nivel"))
    return page.frames[1]


def test_a_report_plays_its_run_and_a_notebook_too(browser, tmp_path):
    result = result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    report = result.report(tmp_path / "report.html")
    with watched(browser) as seen:
        page = seen.page
        page.goto(report.as_uri())
        page.get_by_role("button", name="Play the motion").click()
        frame = inner(page)
        assert frame.evaluate("nivel.span()") == pytest.approx([0.0, 8.0])
        until(frame, "nivel.app.player.playing && nivel.app.player.time > 0")
        notebook = tmp_path / "notebook.html"
        notebook.write_text(f"<!doctype html><meta charset=utf-8>{result.view()._repr_html_()}", encoding="utf-8")
        page.goto(notebook.as_uri())
        inner(page)


def test_a_report_says_that_a_motion_is_left_out_and_how_to_see_it(monkeypatch, tmp_path):
    result = result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    assert "The motion is not in this page" not in result.report(tmp_path / "with.html").read_text(encoding="utf-8")
    monkeypatch.setattr("nivel.report.write.LARGEST_MOTION", 1000)
    text = result.report(tmp_path / "without.html").read_text(encoding="utf-8")
    assert "<iframe" not in text
    assert "`nivel view RESULT.nc` plays it" in text
    assert "--export scene.html" in text


def test_an_exported_page_plays_at_once_where_its_address_asks_for_it(browser, tmp_path):
    file = write_scene([result_of(EXAMPLES / "mechanisms" / "slider-crank.yaml")], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(f"{file.as_uri()}#play")
        until(page, "nivel.app.player.playing && nivel.app.player.time > 0")


def test_damaged_data_are_told_in_the_page(browser, tmp_path):
    file = write_scene([result_of(EXAMPLES / "mechanisms" / "simple-pendulum.yaml")], tmp_path / "scene.html")
    text = file.read_text(encoding="utf-8")
    start = text.index('id="package">') + len('id="package">')
    (tmp_path / "cut.html").write_text(text[: start + 400] + text[text.index("</script>", start) :], encoding="utf-8")
    page = browser.new_page()
    page.set_default_timeout(1000 * PATIENCE)
    page.goto((tmp_path / "cut.html").as_uri())
    page.wait_for_selector(".complaint")
    assert "cannot be shown" in page.locator(".complaint").inner_text()
    page.close()


def test_what_the_scene_knows_of_flexible_bodies_is_json():
    from many_bodies import stage
    from nivel.view.package import Block

    block = Block()
    assert json.dumps(stage(block).flexible[0].name) == '"plate"'
