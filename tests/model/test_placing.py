"""Joint coordinates and rates set on a machine that moves, and states given to machines with other numbers, against fresh starts."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.run.stepping import Snapshot
from nivel.errors import ModelError

MECHANISMS = Path(__file__).parents[2] / "examples" / "mechanisms"
ARM = """
format: 1
gravity: [0, 0, -9.81]
bodies:
  upper: {mass: 2, inertia: [0.1, 0.2, 0.3], position: [0.5, 0, 0]}
  lower: {mass: 1, inertia: [0.05, 0.1, 0.1], position: [1.3, 0, 0]}
joints:
  shoulder: {type: revolute, bodies: [ground, upper], point: [0, 0, 0], axis: [0, 1, 0]}
  elbow: {type: revolute, bodies: [upper, lower], point: [1, 0, 0], axis: [0, 1, 0]}
events: {up: {when: shoulder.angle - 0.4, direction: rising}}
simulation: {duration: 1 s, step: 1 ms, integrator: rk4}
"""


def arm(**given):
    from nivel.files import parse_machine

    return nivel.Machine.from_record(parse_machine(ARM)).with_values(given)


def started(machine, joint, angle, rate):
    """A simulation of the machine as it is assembled with this angle and rate at the start: an independent way to the same state."""
    values = {f"joints.{joint}.start.angle": angle, f"joints.{joint}.start_rates.angle": rate}
    return machine.with_values(values)


@pytest.mark.parametrize("coordinates", ["relative", "absolute", "independent"])
def test_a_loop_that_is_placed_moves_as_one_that_starts_there(coordinates):
    machine = nivel.load(MECHANISMS / "slider-crank.yaml")
    sim = machine.start(coordinates=coordinates)
    sim.advance(0.4)
    sim.place({"hinge.angle": -0.8}, rates={"hinge.angle": -1.5})
    other = started(machine, "hinge", -0.8, -1.5).start(coordinates=coordinates)
    np.testing.assert_allclose(sim["position"], other["position"], atol=1e-11)
    np.testing.assert_allclose(sim["velocity"], other["velocity"], atol=1e-10)
    np.testing.assert_allclose(sim["joint_force"], other["joint_force"], rtol=1e-8, atol=1e-6)
    sim.advance(0.2)
    other.advance(0.2)
    np.testing.assert_allclose(sim["position"], other["position"], atol=1e-8)


def test_what_the_joints_leave_free_stays():
    sim = arm().start()
    sim.advance(0.1)
    angle, rate, shoulder = sim["elbow.angle"], sim["joint_rate"][1], sim["joint_rate"][0]
    sim.place({"shoulder.angle": 0.3})
    assert sim["shoulder.angle"] == pytest.approx(0.3, abs=1e-12)
    assert sim["elbow.angle"] == pytest.approx(angle, abs=1e-12)
    np.testing.assert_allclose(sim["joint_rate"], [shoulder, rate], atol=1e-11)
    sim.place({}, rates={"elbow.angle": 2.0})
    np.testing.assert_allclose(sim["joint_rate"], [shoulder, 2.0], atol=1e-11)
    assert sim.time == pytest.approx(0.1)


def test_the_energy_balance_goes_on_from_the_new_place():
    """What the place gives in energy is no error of the steps, and a state from before has its own balance again."""
    sim = arm().start()
    sim.advance(0.1)
    before, error, energy = sim.state, sim["energy_error"], sim["kinetic_energy"] + sim["potential_energy"]
    sim.place({"shoulder.angle": -1.0}, rates={"shoulder.angle": 5.0})
    assert abs(sim["kinetic_energy"] + sim["potential_energy"] - energy) > 20.0
    assert sim["energy_error"] == pytest.approx(error, abs=1e-12)
    sim.advance(0.1)
    assert abs(sim["energy_error"]) < 1e-5
    sim.restore(before)
    assert sim["energy_error"] == error


def test_turns_are_counted_and_events_begin_on_their_new_side():
    sim = arm().start()
    sim.place({"shoulder.angle": 2 * np.pi + 0.5})
    assert sim["shoulder.angle"] == pytest.approx(2 * np.pi + 0.5, abs=1e-11)
    sim.step()
    assert not sim.events, "a place beyond an event has not passed it"


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda sim: sim.place({"hing.angle": 1.0}), "the joint coordinate `hing.angle` is not known; did you mean"),
        (lambda sim: sim.place({"hinge.angle": float("inf")}), "coordinates.hinge.angle: a finite number was expected"),
        (lambda sim: sim.place([1.0]), "numbers by joint coordinate were expected"),
        (
            lambda sim: sim.place({"slide.displacement": 9.0}),
            "slide.displacement: the joints do not allow the value 9",
        ),
        (
            lambda sim: sim.place({}, {"hinge.angle": 1.0, "slide.displacement": 9.0}),
            "the joints do not allow the rate",
        ),
    ],
)
def test_what_cannot_be_placed_is_refused_and_nothing_changes(call, message):
    sim = nivel.load(MECHANISMS / "slider-crank.yaml").start()
    sim.advance(0.1)
    before = sim["position"]
    with pytest.raises(ModelError, match=message):
        call(sim)
    np.testing.assert_array_equal(sim["position"], before)


@pytest.mark.parametrize("given", [{}, {"integrator": "ros2"}], ids=["rk4", "ros2"])
def test_a_state_of_a_variant_goes_on_with_the_numbers_of_this_machine(given, tmp_path):
    """The state of the heavy machine, in the light one: as the light one would start with that angle and rate."""
    light = nivel.load(MECHANISMS / "slider-crank.yaml")
    heavy = light.with_values({"bodies.crank.mass": 40.0}).start(**given)
    heavy.advance(0.3)
    heavy.state.save(tmp_path / "heavy.npz")
    sim = light.start(**given)
    sim.restore(Snapshot.open(tmp_path / "heavy.npz"))
    assert sim.time == heavy.time
    assert sim["energy_error"] == 0.0
    np.testing.assert_allclose(sim["velocity"], heavy["velocity"], atol=1e-9)
    angle, rate = sim["hinge.angle"], sim["joint_rate"][list(sim.coordinates).index("hinge.angle")]
    other = started(light, "hinge", angle, rate).start(**given)
    np.testing.assert_allclose(sim["joint_force"], other["joint_force"], rtol=1e-6, atol=1e-4)
    sim.advance(0.2)
    other.advance(0.2)
    np.testing.assert_allclose(sim["position"], other["position"], atol=1e-7)
    assert abs(sim["energy_error"]) < 1e-2


def test_a_state_closes_the_joints_of_other_lengths():
    machine = nivel.load(MECHANISMS / "slider-crank.yaml")
    sim, longer = machine.start(), machine.with_values({"parameters.rod_length": 1.9}).start()
    sim.advance(0.3)
    longer.restore(sim.state)
    assert np.abs(longer["constraint_violation"]).max() < 1e-9
    assert longer["rod.position"] != pytest.approx(sim["rod.position"], abs=1e-3)
    longer.advance(0.2)
    assert abs(longer["energy_error"]) < 1e-5


def test_states_of_another_structure_are_refused_by_name():
    sim = arm().start()
    for other, message in (
        (
            nivel.load(MECHANISMS / "four-bar.yaml").start(),
            "it has the body `crank`, which is not here; it lacks the body",
        ),
        (arm().start(integrator="rk4", step="2 ms"), "its step is 0.002 s, not 0.001 s"),
        (arm().start(integrator="ros2"), "its integrator is ros2, not rk4"),
    ):
        with pytest.raises(ModelError, match=message):
            sim.restore(other.state)
    assert sim.time == 0.0
