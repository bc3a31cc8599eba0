"""A live machine in the browser: keys and a gamepad move it, gauges follow, a stopped browser holds nothing up."""

import os
import signal

import numpy as np
import pytest

import cart
import nivel
from browsing import served, until, watched
from nivel.demos import demo_file
from nivel.integrate.loop.paced import DONE
from nivel.live.page import session_of
from nivel.live.picture import gauges
from nivel.live.recording import Recording
from nivel.live.replay import replay
from nivel.live.source import LiveSource


@pytest.fixture(scope="module")
def live():
    """A running session and the viewing of its page."""
    with cart.running() as session, served(LiveSource(session)) as viewing:
        session.command("run")
        yield session, viewing


@pytest.mark.full
def test_keys_and_a_gamepad_move_the_machine_and_gauges_follow(live, browser):
    session, viewing = live
    with watched(browser) as seen:
        page = seen.open(viewing.address.url)
        until(page, "!!nivel.app.live.status")
        page.keyboard.down("d")
        until(page, lambda: session.values()["lever"] == 1.0)
        until(page, "nivel.app.live.status.driver === 'you'")
        page.keyboard.up("d")
        until(page, lambda: session.values()["lever"] == 0.0)
        speed = session.newest[session.facts["layout"].width - 1]
        until(page, "document.querySelector('.strip output').textContent.endsWith('m/s')")
        page.keyboard.down("a")
        until(page, lambda: session.values()["lever"] == -1.0)
        page.keyboard.up("a")
        # a stubbed gamepad: half of the way beyond the dead zone of 0.1
        pad = "{connected: true, axes: [0.55], buttons: []}"
        page.evaluate(f"navigator.getGamepads = () => [{pad}]")
        until(page, lambda: session.values()["lever"] == pytest.approx(0.5))
        page.evaluate("navigator.getGamepads = () => []")
        until(page, lambda: session.values()["lever"] == 0.0)
        page.get_by_role("button", name="Pause").click()
        until(page, lambda: session.mode == "paused")
        ticks = int(session.live.control[DONE])
        page.get_by_role("button", name="One tick").click()
        until(page, lambda: int(session.live.control[DONE]) == ticks + 1)
        page.get_by_role("button", name="Back to the start").click()
        until(page, lambda: int(session.live.control[DONE]) == 0)
        page.get_by_role("button", name="Run").click()
        until(page, lambda: session.mode == "running")
    assert np.isfinite(speed)
    # the page is gone: nobody operates, all is at rest
    cart.until(lambda: not session.is_operated)


def test_a_page_that_lost_its_connection_operates_again_and_takes_over_what_others_left(live, browser):
    """The key that is held moves the lever again; of the brake, which stays where it is left, the page has what another operator set."""
    session, viewing = live
    session.command("run")

    def follows_another():
        session.operate([0.0, 0.25])
        return page.evaluate("nivel.app.live.operator.values[1]") == 0.25

    with watched(browser, width=500, height=400) as seen:
        page = seen.open(viewing.address.url)
        until(page, follows_another)
        page.keyboard.down("d")
        until(page, lambda: session.values()["lever"] == 1.0)
        before = set(viewing.streams)
        page.evaluate("nivel.app.connection.socket.close()")
        until(page, lambda: viewing.streams and not viewing.streams & before)
        until(page, "nivel.app.live.status.driver === 'you'")
        until(page, lambda: session.is_operated and session.values()["lever"] == 1.0)
        page.keyboard.up("d")
    session.command("reset")


def test_a_stopped_browser_does_not_touch_the_loop(live, browser):
    session, viewing = live
    with watched(browser) as seen:
        page = seen.open(viewing.address.url)
        until(page, "!!nivel.app.live.status")
        processes = [each for each in descendants(os.getpid()) if "chrom" in name_of(each)]
        assert processes
        ticks = int(session.live.control[DONE])
        for each in processes:
            os.kill(each, signal.SIGSTOP)
        try:
            cart.until(lambda: session.live.control[DONE] >= ticks + 2000, "2 s of the machine")
        finally:
            for each in processes:
                os.kill(each, signal.SIGCONT)
        until(page, "nivel.app.live.status.mode === 'running'")


@pytest.mark.full
def test_a_crane_is_driven_with_keys_and_a_gamepad_and_its_recording_is_repeated(browser, tmp_path):
    """The loader crane of `nivel demo`: W raises the boom, a gamepad slews, gauges follow, and the replay is equal to the last bit."""
    crane = nivel.load(demo_file("loader-crane"))
    with (
        session_of(crane, {}, urgent=False, record=tmp_path / "crane.live.npz") as session,
        served(LiveSource(session)) as viewing,
    ):
        session.command("run")
        layout = session.facts["layout"]
        gauge = {name: variable.columns.start for name, variable in gauges(layout)}
        before = session.newest[gauge["boom-angle"]]
        with watched(browser, width=500, height=400) as seen:
            page = seen.open(viewing.address.url)
            page.keyboard.down("w")
            until(page, lambda: session.newest[gauge["boom-angle"]] > before + 5.0)
            page.keyboard.up("w")
            shown = "parseFloat(document.querySelectorAll('.strip output')[4].textContent.replace('−', '-'))"
            until(page, lambda: page.evaluate(shown) > before + 4.0)
            slewed = session.values()["slew_lever"]
            page.evaluate("navigator.getGamepads = () => [{connected: true, axes: [1], buttons: []}]")
            until(page, lambda: session.values()["slew_lever"] == 1.0)
            page.evaluate("navigator.getGamepads = () => []")
        assert slewed == 0.0
        (take,) = session.takes
    again = replay(Recording(session.plan.machine, "", {}, session.pace, (take,)), take)
    assert again.is_identical
    assert again.compared > 60


def descendants(process):
    """Processes that were started by this one, and by these."""
    parents = {}
    for each in filter(str.isdecimal, os.listdir("/proc")):
        try:
            with open(f"/proc/{each}/stat") as file:
                parents[int(each)] = int(file.read().rpartition(")")[2].split()[1])
        except OSError:
            continue
    found, fresh = [], [process]
    while fresh:
        fresh = [each for each, parent in parents.items() if parent in fresh]
        found += fresh
    return found


def name_of(process):
    try:
        with open(f"/proc/{process}/comm") as file:
            return file.read()
    except OSError:
        return ""


def test_a_page_that_may_only_watch_disables_its_buttons_and_a_red_run_is_said_with_its_reasons(live, browser):
    """The status is changed on its way to the page."""
    _, viewing = live
    with watched(browser) as seen:
        page = seen.open(viewing.address.url)
        until(page, "!!nivel.app.live.status")
        names = ["Run", "Pause", "One tick", "Back to the start", "Save state", "Restore", "A program operates"]
        assert page.get_by_role("button", name="Back to the start").is_enabled()
        changed = "driver: 'program', watches: 'a program drives', light: 'red', reasons: ['Energy: error 0.5']"
        page.evaluate(
            f"live => {{ const update = live.update.bind(live); live.update = (s) => update({{...s, {changed}}}); }}",
            page.evaluate_handle("nivel.app.live"),
        )
        until(page, "!!nivel.app.live.status.watches")
        buttons = [each for name in names for each in page.get_by_role("button", name=name, exact=True).all()]
        assert len(buttons) == len(names) - 1
        assert not any(each.is_enabled() for each in buttons)
        said = page.evaluate("document.querySelector('.live').textContent")
        assert "A program drives." in said
        assert "Energy: error 0.5" in said
        assert page.evaluate("document.querySelector('.light').dataset.verdict") == "red"


def test_a_body_is_pulled_by_the_mouse(live, browser):
    """With shift a drag pulls the cart along its rail, and the view does not turn; after it the hand has let go."""
    session, viewing = live
    session.command("reset")
    session.command("run")
    with watched(browser) as seen:
        page = seen.open(viewing.address.url)
        until(page, "!!nivel.app.live.status")
        turned = "nivel.app.world.camera.quaternion.toArray()"
        before = page.evaluate(turned)
        x, y = page.evaluate(
            "(() => { const { world, actor } = nivel.app, p = actor.bodies[0].position.clone().project(world.camera),"
            "box = world.renderer.domElement.getBoundingClientRect();"
            "return [box.left + (p.x + 1) / 2 * box.width, box.top + (1 - p.y) / 2 * box.height]; })()"
        )
        page.keyboard.down("Shift")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 60, y, steps=3)
        until(page, lambda: session.live.value[-8] == 1.0)
        until(page, lambda: abs(session.newest[1]) > 0.05)  # x of the cart
        page.mouse.up()
        page.keyboard.up("Shift")
        until(page, lambda: session.live.value[-8] == 0.0)
        assert page.evaluate(turned) == pytest.approx(before, abs=1e-6)


def test_gauges_and_paths_are_the_same_on_a_page_that_shows_few_frames(live, browser):
    """The page acknowledges a frame after 0.2 s: its curve has all regular moments, and numbers stand at round-off of zero as 0."""
    session, viewing = live
    session.command("reset")
    session.command("run")
    spacing = session.pace.every * session.pace.tick
    with watched(browser, width=500, height=400) as seen:
        page = seen.open(viewing.address.url)
        page.evaluate(
            "(() => { const { connection } = nivel.app, send = connection.send.bind(connection);"
            "connection.send = (said) => said.type === 'shown' ? setTimeout(send, 200, said) : send(said); })()"
        )
        until(page, "nivel.app.live.strips[0].times.at(-1) > 2")
        times = np.array(page.evaluate("nivel.app.live.strips[0].times"))
        assert times[0] == 0.0
        np.testing.assert_allclose(np.diff(times), spacing, rtol=1e-6)
        assert page.locator(".strip .name").inner_text() == "Speed"
        assert page.locator(".strip output").inner_text() == "0 m/s"
        for unit, half in (("deg", 90.0), ("rad", np.pi / 2)):
            gauge = f"{{name: 'a', label: 'a', unit: '{unit}', low: {-half}, high: {half}, limit: {half / 3}}}"
            strip = f"new nivel.app.live.strips[0].constructor({gauge}).element"
            assert page.evaluate(f"{strip}.querySelector('.scale').textContent") == "−90 … 90°, limit 30°"
    session.command("reset")
