"""Narrow features of functions of the motion, and events that are passed twice in a step: seen, or told."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.prepared_state import prepare
from nivel.integrate.loop.sink import Header
from nivel.results.memory import Memory

FAULTS = Path(__file__).parent
WALL = (FAULTS / "t4-wall.yaml").read_text(encoding="utf-8")
BARRIER = (FAULTS / "t9-barrier.yaml").read_text(encoding="utf-8")
LOAD = "{of: nose.x, points: [5.105, 5.106, 5.107], values: [0, -1e6, 0]}"
# The nose of a mass of 1 kg meets a spring of 1e9 N/m at 5.105 m with 10 m/s and goes back after half a period.
BACK = 5.005 - 10.0 * (1.0 - 0.5005 - np.pi / np.sqrt(1e9))


def of_text(text, folder):
    path = folder / "machine.yaml"
    path.write_text(text, encoding="utf-8")
    return nivel.load(path, allow_code=True)


def lines(result, name):
    return [item for item in result.trust.items if item.name == name]


@pytest.mark.parametrize(("fault", "integrator"), [("t4-wall", "dopri5"), ("t5-gap", "radau")])
def test_a_cart_turns_back_at_a_wall_that_is_narrower_than_a_step(fault, integrator):
    result = nivel.load(FAULTS / f"{fault}.yaml").simulate(verify=True, integrator=integrator)
    off = abs(result.array("cart.position")[-1, 0] - BACK)
    assert off < 1e-3
    assert off < 3.0 * result.estimated_error("cart.position").max()
    assert result.trust.verdict == "green"


@pytest.mark.parametrize(
    ("sections", "load"),
    [
        ("control: {w: {type: lookup, input: nose.x, points: [5.105, 5.106, 5.107], values: [0, -1e6, 0]}}", "w.value"),
        ("control: {place: {type: signal, value: nose.x}}", LOAD.replace("nose.x", "place.value")),
        ("functions: {w: {points: [5.105, 5.106, 5.107], values: [0, -1e6, 0]}}", '"w(nose.x)"'),
        ("", '"-1e6*max(0, 1 - abs(mod(nose.x, 6) - 5.106)/0.001)"'),
    ],
    ids=["lookup", "table of a block", "curve", "mod"],
)
def test_the_wall_is_met_however_it_is_written(sections, load, tmp_path):
    text = WALL.replace(LOAD, load) + sections
    result = of_text(text, tmp_path).simulate(integrator="dopri5", verify=False)
    assert abs(result.array("cart.position")[-1, 0] - BACK) < 1e-3


def test_a_wall_is_met_between_coarse_frames(tmp_path):
    """A fall from rest onto the wall: between two frames 0.4 s apart a straight line is far beside it."""
    text = WALL.replace("velocity: [10, 0, 0]", "position: [4.9, 0, 0]").replace("1 s, step: 1 ms", "0.4 s, step: 1 ms")
    text = text.replace("forces:", "forces:\n  pull: {type: force, body: cart, vector: [8, 0, 0]}")
    text = text.replace("step: 1 ms", "step: 1 ms, output_interval: 0.4 s")
    result = of_text(text, tmp_path).simulate(integrator="dopri5", verify=False)
    fall = np.sqrt(2.0 * 0.105 / 8.0)
    later = 0.4 - (2.0 * fall + np.pi / np.sqrt(1e9))
    assert len(result.time) == 2
    assert result.array("cart.position")[-1, 0] == pytest.approx(4.9 + 4.0 * later**2, abs=1e-4)


def test_fixed_steps_that_pass_the_wall_are_not_green():
    result = nivel.load(FAULTS / "t4-wall.yaml").simulate(verify=True, integrator="rk4")
    (line,) = lines(result, "loads")
    assert line.verdict == "red"
    assert "wall.vector.x" in line.text
    assert not result.trust.headline.startswith("exact")


def test_a_wall_narrower_than_the_samples_of_a_step_is_not_green(tmp_path):
    """2 µm, of a step that is 0.5 m long."""
    load = "{of: nose.x, points: [5.105, 5.105001, 5.105002], values: [0, -1e9, 0]}"
    text = WALL.replace(LOAD, load).replace("step: 1 ms", "step: 50 ms")
    assert of_text(text, tmp_path).simulate(verify=True, integrator="rk4").trust.verdict == "red"


def test_a_force_faster_than_what_a_step_looks_at_is_not_green(tmp_path):
    """1.6 MHz in steps of 1 ms: bounds of so many periods take longer than the run, and the line says so."""
    result = of_text(WALL.replace(LOAD, '"sin(1e7*time)*cos(3.1e6*time)"'), tmp_path).simulate(integrator="rk4")
    assert result.trust.verdict == "red"
    assert any(
        "what wall.vector.x may do within a sixteenth of a step" in line.text for line in lines(result, "unexamined")
    )


def test_a_motion_with_narrow_features_does_not_depend_on_chunks():
    record = nivel.load(FAULTS / "t4-wall.yaml").record
    plan = plan_run(record.with_simulation(record.simulation.replace(integrator="dopri5")))
    ends = []
    for chunk in (1, 7, None):
        prepared, sink = prepare(plan.methods), Memory()
        sink.begin(Header(prepared.motion.system.layout, {}))
        march(prepared, plan.settings, [sink], chunk_steps=chunk)
        ends.append(sink.result().array("position")[-1].tobytes())
    assert len(set(ends)) == 1


@pytest.mark.parametrize(
    ("load", "integrator"),
    [
        ("{of: nose.x, points: [0, 2, 4, 8], values: [0, -1, 1, 0]}", "radau"),
        ('"-0.1*sin(3*nose.x)"', "dopri5"),
        ('"10*(mod(time, 0.5) - 0.25)"', "dopri5"),
    ],
    ids=["wide table", "sine", "mod of time"],
)
def test_harmless_functions_stay_green(load, integrator, tmp_path):
    result = of_text(WALL.replace(LOAD, load), tmp_path).simulate(verify=True, integrator=integrator)
    assert result.trust.verdict == "green"


@pytest.mark.parametrize("period", [1, 5])
def test_a_kick_that_begins_at_the_end_of_a_step_is_not_missed_there(period, tmp_path):
    """Kicks of 5 N for 20 ms, the last of which begins at the end of the run: after k of them the speed is 0.1 k m/s."""
    text = WALL.replace(LOAD, f'"if(mod(time, {period}) < 0.02, 5, 0)"').replace(", velocity: [10, 0, 0]", "")
    result = of_text(text.replace("1 s, step: 1 ms", "10 s"), tmp_path).simulate(verify=True, integrator="radau")
    assert result.array("cart.velocity")[-1, 0] == pytest.approx(1.0 / period, rel=1e-5)
    assert result.trust.verdict == "green"


# --- events ---


@pytest.mark.parametrize(
    "when",
    [
        "0.01 - abs(r.displacement - 5.045)",
        "1e-4 - (r.displacement - 5.045)^2",
        "min(r.displacement - 5.035, 5.055 - r.displacement)",
        "0.01 - abs(mod(r.displacement, 100) - 5.045)",
        "1e-4 - abs(time - 0.05045)",
    ],
)
def test_an_event_that_is_passed_twice_in_a_step_comes(when, tmp_path):
    """The brake of 50 N goes on at the end of the step in which the cart of 100 m/s passes 5.035 m."""
    text = BARRIER.replace("0.01-abs(r.displacement-5.045)", when)
    result = of_text(text, tmp_path).simulate(verify=False, integrator="rk4")
    (event,) = result.events
    assert event.time == pytest.approx(0.05035, abs=1e-9)
    assert event.direction == "rising"
    assert result.array("cart.velocity")[-1, 0] == pytest.approx(100.0 - 50.0 * (1.0 - 0.051), rel=1e-9)


def test_the_second_pass_is_found_where_it_is_wanted(tmp_path):
    text = BARRIER.replace("direction: rising", "direction: falling")
    (event,) = of_text(text, tmp_path).simulate(verify=False, integrator="rk4").events
    assert event.time == pytest.approx(0.05055, abs=1e-9)
    assert event.direction == "falling"


def test_chosen_steps_end_where_an_event_is_passed_twice():
    result = nivel.load(FAULTS / "t9-barrier.yaml").simulate(verify=True, integrator="dopri5")
    assert result.array("cart.velocity")[-1, 0] == pytest.approx(100.0 - 50.0 * (1.0 - 0.05035), rel=1e-9)
    assert result.trust.verdict == "green"


def test_an_event_that_stays_unseen_is_told(tmp_path):
    """Ten gates in one step: a sine of each has the same sign at both ends."""
    text = BARRIER.replace("0.01-abs(r.displacement-5.045)", "mod(r.displacement, 0.01) - 0.009")
    (line,) = lines(of_text(text, tmp_path).simulate(verify=False, duration=0.05, integrator="rk4"), "events")
    assert line.verdict == "amber"
    assert "gate" in line.text


def test_a_function_that_cannot_be_examined_is_named(tmp_path):
    (tmp_path / "laws.py").write_text(
        "def wall(x):\n    return -1e6*max(0.0, 1.0 - abs(x - 14.894)/0.001)\n", encoding="utf-8"
    )
    law = "{python: laws.py, function: wall, arguments: [gap.distance]}"
    text = WALL.replace(LOAD, law)
    result = of_text(text, tmp_path).simulate(verify=True, integrator="radau")
    line, pulse = lines(result, "unexamined")
    assert "wall.vector.x may do within a sixteenth of a step" in line.text
    assert "a pulse of wall.vector.x between frames" in pulse.text
    assert not result.trust.headline.startswith("exact")
