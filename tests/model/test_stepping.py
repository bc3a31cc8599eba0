"""A simulation that is stepped from Python: the motion of a run, states that are kept and restored, and what a step costs."""

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.run.stepping import Snapshot
from nivel.errors import ModelError, SolveError

EXAMPLES = Path(__file__).parents[2] / "examples"
CART = """
format: 1
bodies: {cart: {mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}
states: {push: {rate: 0*time}}
forces: {drive: {type: motor, coordinate: rail.displacement, effort: push.value}}
events: {far: {when: rail.displacement - 1, direction: rising, stop: true}}
simulation: {duration: 1 s, step: 1 ms}
"""


def nivel_copy(sim):
    return sim.copy()


def pickled(sim):
    return pickle.loads(pickle.dumps(sim))


def cart():
    from nivel.files import parse_machine

    return nivel.Machine.from_record(parse_machine(CART))


def test_steps_make_the_motion_of_a_run_to_the_last_bit():
    machine = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml").with_settings({"integrator": "rk4"})
    run = machine.simulate(duration=0.3, output_interval="1 ms")  # whose last step is made to end at the end
    sim = machine.start(record=True, output_interval="1 ms")
    for _ in range(100):
        sim.step()
    assert sim["hinge.angle"] == run.array("hinge.angle")[100]
    sim.advance(0.1)
    assert sim.time == pytest.approx(0.2)
    np.testing.assert_array_equal(sim["crank.position"], run.array("crank.position")[200])
    recording = sim.result()
    np.testing.assert_array_equal(recording.array("position"), run.array("position")[:201])
    assert (recording.outcome, recording.trust.verified) == ("done", False)


@pytest.mark.parametrize("integrator", ["rk4", "am4", "ros2"])
def test_steps_take_no_notice_of_how_many_follow(integrator):
    """What is iterated stops at the same digit in a simulation without an end, in a short run and in a long one."""
    machine = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    given = {"integrator": integrator, "output_interval": "1 ms"}
    sim = machine.start(record=True, **given)
    sim.advance(0.2)
    short, long = (machine.simulate(duration=each, verify=False, **given).array("position") for each in (0.2, 0.3))
    np.testing.assert_array_equal(short, long[:201])
    np.testing.assert_array_equal(sim.result().array("position"), short)


@pytest.mark.parametrize("integrator", ["rk4", "am4", "generalised-alpha"])
def test_a_state_that_is_restored_goes_on_as_before(integrator, tmp_path):
    machine = nivel.load(EXAMPLES / "mechanisms" / "four-bar.yaml")
    sim = machine.start(integrator=integrator, coordinates="absolute" if integrator == "generalised-alpha" else None)
    sim.advance(0.05)
    sim.state.save(tmp_path / "state.npz")
    sim.advance(0.05)
    expected = sim["position"]
    other = machine.start(integrator=integrator, coordinates="absolute" if integrator == "generalised-alpha" else None)
    saved = Snapshot.open(tmp_path / "state.npz")
    assert repr(saved) == f"Snapshot(time={saved.time!r})"
    other.restore(saved)
    assert other.time == pytest.approx(0.05)
    other.advance(0.05)
    np.testing.assert_array_equal(other["position"], expected)


@pytest.mark.parametrize("how", [nivel_copy, copy.copy, pickled], ids=["copy", "copy.copy", "pickle"])
def test_a_copy_goes_on_by_itself(how):
    sim = nivel.load(EXAMPLES / "mechanisms" / "four-bar.yaml").start()
    sim.advance(0.05)
    other = how(sim)
    assert other.time == sim.time
    other.advance(0.05)
    assert sim.time == pytest.approx(0.05)
    sim.advance(0.05)
    np.testing.assert_array_equal(other["position"], sim["position"])


def test_inputs_act_from_the_step_that_they_are_given_for():
    """x = ½ (F/m) t² of a cart of 2 kg that is pushed with 4 N, then coasts."""
    sim = cart().start()
    sim.advance(0.5, {"push": 4.0})
    assert sim["rail.displacement"] == pytest.approx(0.25, abs=1e-12)
    sim.step({"push": 0.0})
    sim.advance(0.499)
    assert sim["rail.displacement"] == pytest.approx(0.25 + 0.5 * 1.0, abs=1e-12)
    assert sim["cart.velocity.x"] == pytest.approx(1.0, abs=1e-12)
    assert sim["cart.acceleration.x"] == pytest.approx(0.0, abs=1e-12)


def test_a_declared_input_is_set_step_by_step_and_keeps_its_value():
    """x = ½ (F/m) t² with F of the input, which stays until it is set again; outside of its range it is refused."""
    from nivel.files import parse_machine

    text = CART.replace("states: {push: {rate: 0*time}}", "inputs: {push: {range: [-10, 10]}}")
    sim = nivel.Machine.from_record(parse_machine(text)).start()
    sim.step({"push": 4.0})
    sim.advance(0.499)
    assert sim["rail.displacement"] == pytest.approx(0.25, abs=1e-12)
    kept = sim.state
    sim.advance(0.1, {"push": -4.0})
    assert sim["cart.velocity.x"] == pytest.approx(0.8, abs=1e-12)
    sim.restore(kept)
    sim.advance(0.1)
    assert sim["cart.velocity.x"] == pytest.approx(1.2, abs=1e-12)
    with pytest.raises(ModelError, match=r"inputs\.push: 11 is outside the range from -10 to 10"):
        sim.step({"push": 11})


def test_an_event_that_ends_the_run_ends_the_simulation():
    """½ (F/m) t² = 1 for F = 8 N, m = 2 kg at t = 1/√2 s."""
    sim = cart().start()
    sim.advance(1.0, {"push": 8.0})
    assert sim.stopped_by == "far"
    assert sim.time == pytest.approx(0.5**0.5, abs=1e-9)
    assert [event.name for event in sim.events] == ["far"]
    with pytest.raises(ModelError, match="the event `far` ended it"):
        sim.step()


def test_a_step_that_fails_says_when_and_why():
    text = CART.replace("effort: push.value", "effort: 1/(push.value - 1)")
    from nivel.files import parse_machine

    sim = nivel.Machine.from_record(parse_machine(text)).start(record=True)
    sim.advance(0.01)
    before = sim.state
    with pytest.raises(SolveError) as caught:
        sim.step({"push": 1.0})
    assert caught.value.time == pytest.approx(0.01)
    assert sim.result().outcome == caught.value.result.outcome == "failed"
    assert sim.result().failure in str(caught.value)
    sim.restore(before)
    assert sim.result().outcome == "done"


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda sim: sim.step({"psh": 1}), "the input or state `psh` is not known; did you mean `push`?"),
        (lambda sim: sim.step({"push": float("nan")}), "inputs.push: a finite number was expected"),
        (lambda sim: sim.advance(0.0015), "is not a multiple of the step"),
        (lambda sim: sim.advance("1 s"), "a number of seconds was expected, got `1 s`"),
        (lambda sim: sim["rail.displacment"], "did you mean `rail.displacement`"),
        (
            lambda sim: sim.restore(nivel.load(EXAMPLES / "mechanisms" / "four-bar.yaml").start().state),
            "of another machine",
        ),
        (lambda sim: sim.result(), "record=True"),
        (lambda sim: Snapshot.open(__file__), "is no saved state"),
    ],
)
def test_faults_say_what_to_write(call, message):
    sim = cart().start()
    with pytest.raises(ModelError) as caught:
        call(sim)
    assert message in str(caught.value)


def test_an_integrator_that_chooses_its_steps_is_refused():
    with pytest.raises(ModelError, match="chooses its steps"):
        cart().start(integrator="dop853")
