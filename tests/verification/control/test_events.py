"""Events against closed forms: their times, their order, their directions, the last frame; whatever the method and the chunks."""

import json

import numpy as np
import pytest
from scipy.special import ellipj, ellipk, ellipkinc

import machines
from nivel import Event
from nivel.analysis.run import history
from nivel.errors import SolveError
from running import run
from simulating import G, hinge, machine, simulate, slopes, solid, turning_error

pytestmark = pytest.mark.covering

MASS, ARM, INERTIA, AMPLITUDE = 2.0, 0.4, 0.05, 1.2
RATE = np.sqrt(MASS * G * ARM / (INERTIA + MASS * ARM**2))
MODULUS = np.sin(AMPLITUDE / 2) ** 2  # m = k²


def pendulum(**events):
    """A bar released at AMPLITUDE from the vertical; its centre is at `bar.x`, `bar.y`."""
    place = [ARM * np.sin(AMPLITUDE), -ARM * np.cos(AMPLITUDE), 0]
    return {
        "gravity": [0, -G, 0],
        "bodies": {"bar": solid(MASS, INERTIA, position=place)},
        "joints": {"pin": hinge("ground", "bar")},
        "events": events,
    }


def passing(angle, turns=3):
    """Times at which the pendulum passes `angle`: sin(φ/2) = k cd(ω₀ t), with sn(u) = cd(K - u)."""
    quarter = ellipk(MODULUS)
    there = quarter - ellipkinc(np.arcsin(np.sin(angle / 2) / np.sqrt(MODULUS)), MODULUS)
    return (
        np.sort(np.concatenate([4 * n * quarter + np.array([there, 4 * quarter - there]) for n in range(turns)])) / RATE
    )


def times(result, name=None):
    return np.array([event.time for event in result.events if name in (None, event.name)])


LEVEL = {"when": f"bar.x - {float(ARM * np.sin(0.5))}"}  # the angle 0.5, to the right of the vertical


def test_closed_form_of_the_pendulum_is_the_motion():
    """The reference itself: φ of `ellipj` at the times of `passing` is the angle asked for."""
    sn, _, dn, _ = ellipj(ellipk(MODULUS) - RATE * passing(0.5), MODULUS)
    assert np.all(dn > 0)
    np.testing.assert_allclose(2 * np.arcsin(np.sqrt(MODULUS) * sn), 0.5, atol=1e-12)


@pytest.mark.parametrize(
    "settings", [{}, {"coordinates": "relative"}, {"coordinates": "independent"}, {"formulation": "lagrange"}]
)
def test_event_times_have_the_order_of_the_method(settings):
    """rk4: errors fall with h⁴, as those of the state and of the cubic through a step do."""
    steps, errors = [0.02, 0.01, 0.005], []
    for step in steps:
        r = simulate(pendulum(level=LEVEL), duration=3.0, step=step, output_interval=0.5, **settings)
        expected = passing(0.5)
        expected = expected[expected < 3.0]
        assert len(r.events) == len(expected) >= 3
        errors.append(np.abs(times(r) - expected).max())
    assert errors[-1] < 2e-8
    assert slopes(steps, errors).min() > 3.7, errors


@pytest.mark.parametrize("stabilisation", ["none", "direct", "baumgarte", "geometric"])
def test_events_come_with_every_stabilisation(stabilisation):
    r = simulate(pendulum(level=LEVEL), duration=2.0, step=1e-3, output_interval=0.1, stabilisation=stabilisation)
    expected = passing(0.5)
    np.testing.assert_allclose(times(r), expected[expected < 2.0], atol=1e-6 if stabilisation == "baumgarte" else 1e-7)


@pytest.mark.parametrize("integrator", ["euler", "heun", "rkn4", "ab3", "am4", "abm4", "gear3"])
def test_events_come_with_every_kind_of_integrator(integrator):
    """A fall under constant acceleration, on which all but the first are exact, through a height within a step."""
    height = {"when": "ball.z + 1"}
    sections = {"gravity": [0, 0, -G], "bodies": {"ball": solid()}, "events": {"height": height}}
    r = simulate(sections, duration=0.6, step=0.01, integrator=integrator)
    assert times(r) == pytest.approx([np.sqrt(2 / G)], abs=6e-3 if integrator == "euler" else 1e-9)


def falling(**events):
    return {"gravity": [0, 0, -G], "bodies": {"ball": solid(position=[0, 0, 10])}, "events": events}


def test_free_fall_through_a_height_is_exact():
    """The cubic through a step is the parabola itself."""
    r = simulate(falling(level={"when": "ball.z - 5.1"}), duration=1.5, step=0.07)
    assert times(r) == pytest.approx([np.sqrt(2 * 4.9 / G)], abs=1e-12 * 0.07)
    assert r.events[0].direction == "falling"


def test_run_stops_at_the_event_with_a_last_frame_there():
    r = simulate(falling(ground={"when": "ball.z", "stop": True}), duration=5.0, step=0.01, output_interval=0.1)
    end = np.sqrt(20 / G)
    assert (r.outcome, r.stopped_by) == ("done", "ground")
    assert r.time[-1] == times(r)[-1] == pytest.approx(end, abs=1e-14)
    assert r.array("ball.position.z")[-1] == pytest.approx(0.0, abs=1e-13)
    assert r.array("ball.velocity.z")[-1] == pytest.approx(-G * end, rel=1e-14)
    np.testing.assert_allclose(r.time[:-1], 0.1 * np.arange(15), atol=1e-14)
    assert json.loads(r.attributes["events"]) == [{"name": "ground", "time": r.time[-1], "direction": "falling"}]
    assert r.summary()["stopped_by"] == "ground"
    assert "the event ground ended the run" in r.trust.items[0].text
    assert r.trust.items[0].verdict == "green"


def test_directions_choose_among_the_passages():
    """Through the level to the left and back again."""
    sections = pendulum(both=LEVEL, up={**LEVEL, "direction": "rising"}, down={**LEVEL, "direction": "falling"})
    r = simulate(sections, duration=3.0, step=1e-2)
    both = times(r, "both")
    assert len(both) == 5 or len(both) == 4
    np.testing.assert_array_equal(times(r, "down"), both[::2])
    np.testing.assert_array_equal(times(r, "up"), both[1::2])
    assert {event.direction for event in r.events if event.name == "down"} == {"falling"}


def test_events_of_one_step_come_in_the_order_of_time_and_none_after_a_stop():
    events = {f"at_{z}": {"when": f"ball.z - {z}"} for z in (8.2, 8.8, 8.5, 8.0)}
    events["at_8.5"]["stop"] = True
    events = {name.replace(".", "_"): event for name, event in events.items()}
    r = simulate(falling(**events), duration=1.0, step=0.25)
    assert [event.name for event in r.events] == ["at_8_8", "at_8_5"]
    np.testing.assert_allclose(times(r), np.sqrt(2 * np.array([1.2, 1.5]) / G), atol=1e-14)
    assert r.time[-1] == r.events[-1].time


def test_events_at_one_time_come_in_the_order_of_the_file():
    events = {"b": {"when": "ball.z - 9"}, "a": {"when": "9 - ball.z", "stop": True}, "c": {"when": "2*ball.z - 18"}}
    r = simulate(falling(**events), duration=1.0, step=0.1)
    assert [event.name for event in r.events] == ["b", "a", "c"]
    assert np.ptp(times(r)) < 1e-13


@pytest.mark.parametrize("stop", [False, True])
def test_value_that_is_zero_at_the_end_of_a_step_is_one_event(stop):
    """Steps of 1/8 s, whose multiples are exact."""
    r = simulate(falling(half={"when": "time - 0.5", "stop": stop}), duration=1.0, step=0.125)
    assert [(event.time, event.direction) for event in r.events] == [(0.5, "rising")]
    assert r.time[-1] == (0.5 if stop else 1.0)
    assert np.all(np.diff(r.time) > 0.1)


@pytest.mark.parametrize("when", ["abs(time - 0.5)", "(time - 0.5)^2", "time", "-time", "ball.vz", "0*time"])
def test_zero_at_the_start_and_touching_zero_are_no_events(when):
    assert simulate(falling(e={"when": when}), duration=1.0, step=0.125).events == ()


def test_angle_that_counts_its_turns_is_one_event():
    sections = {
        "bodies": {"disc": solid(angular_velocity=[0, 0, 100])},
        "joints": {"pin": hinge("ground", "disc")},
        "events": {"fourth": {"when": "pin.angle - 8*pi"}, "back": {"when": "pin.angle + 0.1"}},
    }
    r = simulate(sections, duration=1.0, step=1e-3)
    assert [event.name for event in r.events] == ["fourth"]
    assert r.events[0].time == pytest.approx(0.08 * np.pi, rel=turning_error(100, 1e-3))


def crossings(step=1e-3):
    """Events of the slider-crank: its slider through a place, its crank through angles."""
    return machines.slider_crank().replace(
        events=(
            Event(name="middle", when="slider.x - 1.8"),
            Event(name="quarter", when="sin(2*hinge.angle)"),
            Event(name="clock", when="sin(40*pi*time)"),
        )
    )


@pytest.mark.parametrize("stabilisation", ["direct", "baumgarte", "geometric"])
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_events_are_the_same_for_every_chunk_and_buffer(coordinates, stabilisation, monkeypatch):
    settings = {"duration": 0.5, "step": 1e-3, "stabilisation": stabilisation}
    record = crossings().replace(simulation=machines.slider_crank().simulation.replace(coordinates=coordinates))
    whole = run(record, chunk_steps=10_000, **settings)
    assert len(whole.finished.events) >= 20
    monkeypatch.setattr(history, "EVENT_ROWS", 1)
    monkeypatch.setattr(history, "BUFFER_BYTES", 1)
    for chunk in (1, 7):
        parts = run(record, chunk_steps=chunk, **settings)
        assert np.array_equal(whole.frames, parts.frames)
        assert whole.finished.events == parts.finished.events


def test_events_change_nothing_in_the_motion():
    """With a fixed step a machine moves the same whether it is watched or not."""
    plain = run(machines.slider_crank(), duration=0.2, step=1e-3)
    watched = run(crossings(), duration=0.2, step=1e-3)
    assert np.array_equal(plain.frames, watched.frames)
    assert watched.finished.timing["evaluations"] < 2 * plain.finished.timing["evaluations"]


def test_step_without_an_event_costs_no_evaluation():
    quiet = machines.slider_crank().replace(events=(Event(name="never", when="slider.x - 100"),))
    assert run(quiet, duration=0.1, step=1e-3).finished.timing["evaluations"] == 4 * 100 + 1


@pytest.mark.parametrize("when", ["sqrt(0.5 - time)", "log(0.5 - time)", "1/(time - 0.5)"])
def test_value_that_is_no_number_is_an_error_with_the_name_of_the_event(when):
    with pytest.raises(SolveError, match="the value of the event broken is no longer a number") as caught:
        simulate(falling(broken={"when": when}), duration=1.0, step=0.125)
    assert "`when` of broken" in caught.value.advice
    assert caught.value.result.time[-1] == pytest.approx(0.375, abs=0.126)


def test_events_of_tables_and_python_functions():
    ramp = {"times": [0, 1, 2], "values": [-1, 1, 1]}
    law = {
        "source": "def f(t, z):\n    return z - 9.0 if t > 0.1 else 1.0\n",
        "function": "f",
        "arguments": ["time", "ball.z"],
    }
    r = simulate(falling(ramp={"when": ramp}, law={"when": law}), duration=1.0, step=0.04)
    assert times(r, "ramp") == pytest.approx([0.5], abs=1e-13)
    assert times(r, "law") == pytest.approx([np.sqrt(2 / G)], abs=1e-13)


def test_event_of_an_assembly_comes_when_it_would_in_the_part(tmp_path):
    """A part that falls sideways in its own file, placed with its x axis down: the same time, under its own name."""
    from nivel.api import load

    part = tmp_path / "part.yaml"
    part.write_text(
        "format: 1\nbodies: {stone: {mass: 1, inertia: [1, 1, 1]}}\nevents: {far: {when: stone.x - 1, stop: true}}\n"
    )
    main = tmp_path / "main.yaml"
    main.write_text(
        f"format: 1\ngravity: [0, 0, {-G}]\nassemblies:\n"
        "  left: {file: part.yaml, position: [1, 2, 3], orientation: {axis: [0, 1, 0], angle: 90 deg}}\n"
        "simulation: {step: 0.01, duration: 2}\n"
    )
    r = load(main).simulate()
    assert r.stopped_by == "left_far"
    assert r.time[-1] == pytest.approx(np.sqrt(2 / G), abs=1e-12)
    assert r.array("left_stone.position")[-1] == pytest.approx([1, 2, 2], abs=1e-12)


def test_events_are_told_by_check_in_words():
    said = str(
        machine(falling(a={"when": "ball.z", "stop": True}, b={"when": "ball.z-1", "direction": "rising"})).check()
    )
    assert "  a: ball.z passes zero; the run ends there" in said
    assert "b: ball.z - 1.0 passes zero, rising" in said


def test_results_files_reports_and_texts_have_all_events(tmp_path):
    """More events than a compact attribute of a file could hold."""
    sections = falling(tick={"when": "sin(2*pi*1000*time)"}, end={"when": "time - 1.00025", "stop": True})
    settings = {"duration": 2.0, "step": 2e-4, "output_interval": 0.1}
    r = machine({**sections, "simulation": settings}).simulate(out=tmp_path / "fall.nc")
    ticks = times(r, "tick")
    np.testing.assert_allclose(ticks, np.arange(1, 2001) / 2000, atol=1e-14)
    assert r.stopped_by == "end"
    text = r.report(tmp_path / "fall.html").read_text()
    assert "tick 2000 times, first at t = 0.0005 s, last at 1 s" in text
    assert "end at t = 1.00025 s, which ended the run" in text
    assert "end at t = 1.00025 s, which ended the run" in repr(r)
    assert "end at t = 1.00025 s, which ended the run" in r._repr_html_()


def test_command_line_tells_the_events(tmp_path):
    from click.testing import CliRunner

    from nivel.cli import main

    file = tmp_path / "fall.yaml"
    file.write_text(
        "format: 1\ngravity: [0, 0, -9.81]\nbodies: {b: {mass: 1, inertia: [1, 1, 1]}}\n"
        "events: {deep: {when: b.z + 1, stop: true}}\n"
    )
    done = CliRunner().invoke(main, ["run", str(file), "--no-report", "--out", str(tmp_path / "fall.nc")])
    assert done.exit_code == 0
    assert "event: deep at t = 0.45152" in done.output
