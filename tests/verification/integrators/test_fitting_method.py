"""The method of a machine that names none: chosen steps, an implicit method from where they become stiff, and a second choice."""

from itertools import count
from pathlib import Path

import numpy as np
import pytest

from nivel import load
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run import attempt as second_run
from nivel.analysis.run import simulate as simulation
from nivel.errors import ModelError
from nivel.files.reader import parse_machine
from nivel.files.writer import write_machine
from simulating import G, hinge, machine, simulate, slide, solid

EXAMPLES = Path(__file__).parents[3] / "examples"
SHORT = {"duration": 0.2}
STIFF = {"type": "joint-spring-damper", "coordinate": "rail", "stiffness": 1e8, "damping": 1e5}
PAD = {"type": "contact", "body": "ball", "plane": "floor", "stiffness": 1e8, "restitution": 0.5}


def block(force, **start):
    """A block of 2 kg on a rail along x, with a force on its displacement."""
    return {
        "bodies": {"block": solid(2.0)},
        "joints": {"rail": slide("ground", "block", **start)},
        "forces": {"spring": force},
    }


def falling_ball():
    return {
        "gravity": [0, 0, -G],
        "bodies": {"ball": {"mass": 1, "shape": {"type": "sphere", "radius": 0.05}, "position": [0, 0, 0.2]}},
        "markers": {"floor": {"body": "ground"}},
        "forces": {"pad": PAD},
    }


def goes_on(result):
    """The integrator that went on, and from when [s]; none where the first one stayed."""
    found = result.settings.get("went_on", {})
    return found.get("integrator", ""), found.get("from", np.inf)


def test_a_stiff_spring_is_stepped_over():
    """2 kg, 1e8 N/m and 1e5 N s/m: rates of 2.04e3/s and 4.9e4/s; the slow one decays as exp(-1020 t) - from the closed form."""
    r = simulate(block(STIFF, start={"displacement": 1e-3}), **SHORT)
    assert (r.settings["integrator"], r.settings["tolerance"], goes_on(r)[0]) == ("dopri5", 1e-8, "radau")
    fast, slow = np.roots([2.0, 1e5, 1e8])
    expected = 1e-3 * (fast * np.exp(slow * r.time) - slow * np.exp(fast * r.time)) / (fast - slow)
    np.testing.assert_allclose(r.array("rail.displacement"), expected, atol=1e-9)
    assert r.timing["steps"] < 1000


@pytest.mark.parametrize("named", ["rk4", "dopri5"])
def test_a_method_that_is_named_is_taken(named):
    sections = block({**STIFF, "stiffness": 1e3, "damping": 0.0}, start={"displacement": 1e-3})
    r = simulate(sections, integrator=named, **SHORT)
    assert (r.settings["integrator"], "reason" in r.settings, goes_on(r)[0]) == (named, False, "")


def test_an_undamped_spring_faster_than_a_millisecond_is_followed():
    """1000 rad/s: 1/π of a turn in a step of 1 ms, which loses the amplitude within a second."""
    r = machine(block({**STIFF, "stiffness": 2e6, "damping": 0.0}, start={"displacement": 1e-3})).simulate(
        duration=1.0, verify=True
    )
    assert (r.settings["integrator"], goes_on(r)[0], r.trust.light) == ("dopri5", "", "green")
    np.testing.assert_allclose(r.array("rail.displacement"), 1e-3 * np.cos(1e3 * r.time), atol=1e-7)


def test_a_motor_at_its_limit_hides_its_rate():
    """J ω̇ = gain (ω₀ - ω) within the limit M: ω = M t/J up to ω₀ - M/gain, then ω₀ - ω falls as exp(-gain t/J)."""
    sections = {
        "bodies": {"cam": solid(1.0, 1e-3)},
        "joints": {"shaft": hinge("ground", "cam")},
        "forces": {"motor": {"type": "motor", "coordinate": "shaft", "speed": 6.0, "gain": 50.0, "limit": 80.0}},
    }
    r = machine(sections).simulate(duration=0.1, verify=True)
    assert (r.settings["integrator"], goes_on(r)[0], r.trust.light) == ("dopri5", "radau", "green")
    begin = 1e-3 / 80.0 * (6.0 - 80.0 / 50.0)
    expected = 6.0 - 80.0 / 50.0 * np.exp(-5e4 * (r.time - begin))
    np.testing.assert_allclose(
        r.array("shaft.angle.rate")[1:], expected[1:], atol=2e-6
    )  # 1e-7 of 6 rad/s within the fall


def grows():
    """A spring that becomes a million times stiffer, with a damper, from 0.05 to 0.1 s; samples, an event, and a filter go on."""
    force = "-(1e3 + 1e9*step(time, 0.05, 0, 0.1, 1))*rail.displacement - 1e5*step(time, 0.05, 0, 0.1, 1)*rail.displacement_rate"
    return block({"type": "motor", "coordinate": "rail", "effort": force}, start={"displacement": 1e-3}) | {
        "states": {
            "count": {"update": "count.value + 1", "every": "7 ms"},
            "lag": {"rate": "20*(rail.displacement - lag.value)"},
        },
        "events": {"through": {"when": "rail.displacement"}},
    }


def test_what_becomes_stiff_goes_on_with_the_state_at_hand():
    """Samples, states and events of the run that goes on are those of an implicit one from the start."""
    shown = {"output_interval": 1e-3}
    r = simulate(grows(), **SHORT, **shown)
    other = simulate(grows(), integrator="radau", tolerance=1e-10, **SHORT, **shown)
    named = simulate(grows(), integrator="dopri5", tolerance=1e-8, duration=0.05, **shown)
    assert goes_on(r)[0] == "radau"
    assert 0.05 < goes_on(r)[1] < 0.1
    np.testing.assert_allclose(r.array("rail.displacement"), other.array("rail.displacement"), atol=1e-9)
    np.testing.assert_allclose(r.array("state.lag"), other.array("state.lag"), atol=1e-9)
    np.testing.assert_array_equal(r.array("state.count"), other.array("state.count"))
    assert r.array("state.count")[-1] == 29  # at 0, 7, …, 196 ms
    begun = [[each.time for each in run.events if each.time < 0.06] for run in (r, other)]
    np.testing.assert_allclose(begun[0], begun[1], atol=1e-7)
    # until then it is the run of the first method
    before = len(named.time) - 1
    first = r.array("rail.displacement")[:before]
    np.testing.assert_allclose(named.array("rail.displacement")[:before], first, atol=1e-10)


@pytest.mark.compiles
def test_gradients_of_what_becomes_stiff_are_those_of_one_method():
    """x(t) is proportional to its start, as the force is to x."""
    sections = grows()
    del sections["states"], sections["events"]
    found = machine(sections).gradient("rail.displacement", "joints.rail.start.displacement", duration=0.08)
    slope = float(found["d(rail.displacement)/d(joints.rail.start.displacement)"])
    assert slope == pytest.approx(float(found["rail.displacement"]) / 1e-3, rel=1e-5, abs=1e-9)


def test_a_contact_ends_steps_and_is_stepped_over():
    """The ball bounces from 0.15 m to a quarter of the height."""
    r = machine(falling_ball()).simulate(duration=0.5, verify=True)
    assert r.trust.verdict == "green"
    height = r.array("ball.position.z")[r.time > 0.25].max() - 0.05
    assert height == pytest.approx(0.25 * 0.15, rel=2e-2)  # restitution by a damper holds to some percent


def cantilever():
    beam = {
        "from": [0, 0, 0],
        "to": [1, 0, 0],
        "up": [0, 0, 1],
        "elements": 2,
        "section": {"type": "circle", "radius": 0.01},
    }
    steel = {"youngs_modulus": 2e11, "poisson_ratio": 0.3, "density": 7850}
    return machine(
        {
            "gravity": [0, 0, -G],
            "beams": {"rod": {**beam, "material": steel}},
            "joints": {"clamp": {"type": "fixed", "bodies": ["ground", "rod.start"], "point": [0, 0, 0]}},
        }
    )


def test_a_beam_has_the_method_of_vibrations():
    found = cantilever().check()
    assert (found.settings.integrator, found.reason) == ("generalised-alpha", "beams have rates beyond all steps")


@pytest.mark.parametrize(("given", "step"), [({}, 0.06), ({"output_interval": 0.25}, 0.05), ({"step": 2e-3}, 2e-3)])
def test_a_long_run_of_beams_begins_with_a_thousandth_of_it(given, step):
    record = cantilever().record
    plan = plan_run(record.with_simulation(record.simulation.replace(duration=60.0, **given)))
    assert plan.settings.step == pytest.approx(step, rel=1e-12)
    other = record.with_simulation(record.simulation.replace(duration=60.0, integrator="generalised-alpha"))
    assert plan_run(other).settings.step == 1e-3


def test_waves_in_lines_are_met_by_steps():
    """Samples of 0.5 ms, which no step of 1 ms shows; the water hammer is as green as with the step of its file."""
    record = load(EXAMPLES / "hydraulics" / "water-hammer.yaml").record
    plan = plan_run(record.replace(simulation=type(record.simulation)(duration=1.0)))
    assert (plan.settings.integrator, plan.settings.step) == ("extrapolated-euler", 5e-4)


def test_other_choices_together_do_three_times_the_work_of_the_first(monkeypatch):
    """The beam that swings under its weight is not green with its first steps."""
    monkeypatch.setattr(second_run, "LEAST_WORK", 0.0)
    done, one = [], second_run.attempt

    def noted(*given):
        done.append(one(*given))
        return done[-1]

    monkeypatch.setattr(second_run, "attempt", noted)
    trust = cantilever().simulate(duration=0.02, verify=True).trust
    work = [simulation._work_of(each) for each in done]
    assert len(work) > 1
    assert sum(work[1:]) <= 3.0 * work[0]
    told = [item.text for item in trust.items if item.name == "quantities" and item.verdict != "green"]
    assert told
    step = f"steps of {done[-1].plan.settings.step / 4.0 * 1e6:.3g} µs"
    assert all(text.endswith(f"not begun: generalised-alpha, {step}, as {simulation.SPENT}") for text in told)


@pytest.mark.parametrize("given", [{"tolerance": 1e-3}, {"tolerance": 1e-8}])
def test_a_choice_that_settings_keep_off_is_told(given):
    """Energy of an undamped spring: the tolerance that is given is kept, and the line says so, unless it is green."""
    spring = machine(block({**STIFF, "stiffness": 2e4, "damping": 0.0}, start={"displacement": 1e-3}))
    energy = next(
        item for item in spring.simulate(duration=1.0, verify=True, **given).trust.items if item.name == "energy"
    )
    assert (energy.verdict == "green") == (given["tolerance"] == 1e-8)
    assert energy.text.endswith("not begun: other steps, as `tolerance` is given") == (energy.verdict != "green")


def test_steps_of_one_cost_where_a_machine_is_stepped():
    sections = block(STIFF, start={"displacement": 1e-3})
    sim = machine(sections).start(record=True)
    sim.advance(0.1)
    assert sim.result().settings["integrator"] == "ros2"
    assert sim["rail.displacement"] == pytest.approx(0.0, abs=1e-6)


def test_a_slack_rope_becomes_taut():
    """2 kg fall by 0.5 m into a rope of 1e8 N/m, are stopped within π/7071 s, and rise again as they fell."""
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"load": solid(2.0, position=[0, 0, -0.5])},
        "joints": {"rail": slide("ground", "load", axis=[0, 0, 1], point=[0, 0, -0.5])},
        "forces": {
            "rope": {"type": "rope", "bodies": ["ground", "load"], "points": [[0, 0, 0], [0, 0, -0.5]], "length": 1, "stiffness": 1e8}
        },
    }  # fmt: skip
    r = simulate(sections, duration=0.6)
    contact = 2.0 * (np.pi - np.arctan2(np.sqrt(2.0 * 0.5 * G) * np.sqrt(5e7), G)) / np.sqrt(5e7)
    since = r.time[-1] - np.sqrt(2.0 * 0.5 / G) - contact
    expected = -1.0 + np.sqrt(2.0 * 0.5 * G) * since - 0.5 * G * since**2
    assert r.array("load.position.z")[-1] == pytest.approx(expected, abs=1e-7)


def test_a_fast_rotor_is_resolved():
    sections = {
        "bodies": {"rotor": solid(1.0, angular_velocity=[0, 0, 6000.0])},
        "joints": {"axle": {"type": "revolute", "bodies": ["ground", "rotor"], "point": [0, 0, 0], "axis": [0, 0, 1]}},
    }
    r = machine(sections).simulate(duration=0.05, verify=True)
    assert r.trust.verdict == "green"
    assert r.array("axle.angle")[-1] == pytest.approx(300.0, rel=1e-9)


def test_a_slow_machine_has_few_steps():
    """1000 kg on 1e-3 N/m: ω = 1e-3/s; over 1e4 s x = x₀ exp(-ζωt) (cos ωd t + ζ/√(1-ζ²) sin ωd t)."""
    soft = {"type": "joint-spring-damper", "coordinate": "rail", "stiffness": 1e-3, "damping": 1e-2}
    sections = block(soft, start={"displacement": 0.1})
    sections["bodies"]["block"]["mass"] = 1000.0
    r = simulate(sections, duration=1e4)
    assert r.timing["steps"] < 2000
    zeta = 5e-3
    damped = 1e-3 * np.sqrt(1 - zeta**2)
    expected = 0.1 * np.exp(-zeta * 1e-3 * r.time)
    expected *= np.cos(damped * r.time) + zeta / np.sqrt(1 - zeta**2) * np.sin(damped * r.time)
    np.testing.assert_allclose(r.array("rail.displacement"), expected, atol=1e-8)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
def test_friction_stops_within_the_tolerance(tolerance):
    """A block of speed v under μ g comes to rest at v²/(2 μ g), too late by at most a tenth of the tolerance and the method's own error."""
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"block": solid(2.0, velocity=[1, 0, 0])},
        "joints": {"rail": slide("ground", "block")},
        "forces": {"rub": {"type": "friction", "coordinate": "rail", "model": "stiction", "coefficient": 0.3}},
    }
    given = {} if tolerance == 1e-8 else {"tolerance": tolerance}
    r = machine(sections).simulate(duration=0.5, verify=True, **given)
    assert (r.settings["integrator"], r.trust.light) == ("radau", "green")
    assert r.array("rail.displacement")[-1] == pytest.approx(0.5 / (0.3 * G), abs=10.0 * tolerance)


def test_tolerance_step_and_interval_go_with_a_method_that_is_not_named():
    sections = block({**STIFF, "stiffness": 1e3, "damping": 0.0}, start={"displacement": 1e-3})
    r = machine(sections).simulate(tolerance=1e-5, step=1e-4, output_interval=3.3e-4, **SHORT)
    assert (r.settings["integrator"], r.settings["tolerance"]) == ("dopri5", 1e-5)
    assert r.time[1] == pytest.approx(3.3e-4, rel=1e-12)
    # fixed steps divide the interval where none is given
    fixed = machine(sections).simulate(integrator="rk4", output_interval=3.3e-4, **SHORT)
    assert fixed.settings["step"] == pytest.approx(3.3e-4, rel=1e-12)
    with pytest.raises(ModelError, match="not a multiple"):
        machine(sections).simulate(integrator="rk4", step=1e-3, output_interval=3.3e-3, **SHORT)


def test_check_tells_the_method_of_the_run():
    sections = block(STIFF, start={"displacement": 1e-3})
    found, run = machine(sections).check(), simulate(sections, **SHORT)
    assert (found.settings.integrator, found.reason) == (run.settings["integrator"], run.settings["reason"])
    assert "method: dopri5, because no method is named; where it is stiff, radau goes on" in str(found)


def test_a_law_that_jumps_to_and_fro_comes_to_its_end_by_fixed_steps():
    """Dry friction as sign(v) shrinks every chosen step once the block rests; fixed steps pass it, and the light tells what they leave.

    From 1 m/s against 1 N the block of 2 kg rests after v² m/(2 F) = 1 m.
    """
    rub = {"type": "force", "body": "block", "vector": ["-if(rail.displacement_rate > 0, 1, -1)", 0, 0]}
    result = simulate({**block(rub, start_rates={"displacement": 1.0}), "simulation": {"duration": 3.0}})
    assert (result.outcome, result.settings["integrator"]) == ("done", "rk4")
    assert result.array("rail.displacement")[-1] == pytest.approx(1.0, abs=2e-3)
    assert result.trust.verdict != "green" or result.trust.accuracy_estimate < 2e-3


def test_a_busy_computer_changes_no_choice(monkeypatch):
    """Second runs and second choices are bounded by work: an hour between any two looks at the clock is nothing to them."""
    hours = count()
    monkeypatch.setattr(second_run.clock_of_python, "perf_counter", lambda: 3600.0 * next(hours))
    r = cantilever().simulate(duration=0.02, verify=True)
    assert r.settings["step"] < 1e-3
    assert r.trust.verified
    assert all("given up" not in item.text for item in r.trust.items)


def test_a_second_run_ends_where_its_work_is_spent(monkeypatch):
    """A tenth of the tolerance takes 10^(1/5) times the steps; it is given up though it ends before that is seen."""
    monkeypatch.setattr(second_run, "LEAST_WORK", 0.0)
    spring = machine(block({**STIFF, "stiffness": 2e4, "damping": 0.0}, start={"displacement": 1e-3}))
    assert spring.simulate(duration=1.0, verify=True).trust.verified
    monkeypatch.setattr(second_run, "MOST_TIMES", 1.0)
    r = spring.simulate(duration=1.0, verify=True)
    line = next(item for item in r.trust.items if item.name == "verified")
    assert line.verdict != "green"
    assert "the work for verification was spent" in line.text


def test_what_is_named_is_written():
    """A file that names the integrator or the tolerance that is the default of the record says so when it is written."""
    sections = block(STIFF) | {"simulation": {"integrator": "rk4", "tolerance": 1e-6}}
    again = parse_machine(write_machine(machine(sections).record))
    assert again.simulation.model_fields_set == {"integrator", "tolerance"}
    assert parse_machine(write_machine(machine(block(STIFF)).record)).simulation.model_fields_set == set()
