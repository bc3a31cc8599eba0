"""What `nivel check` finds out, against what is known of the machines."""

import numpy as np
import pytest

import machines
from checking import check
from nivel import Body, MachineRecord, SimulationSettings
from nivel.analysis.plan.choice import _absolute_cost, _relative_cost, choose_coordinates
from nivel.analysis.plan.settings import complete
from nivel.elements.joints import JOINTS
from nivel.errors import ModelError
from nivel.files import parse_machine


def test_facts_of_the_slider_crank():
    facts = check(machines.slider_crank())
    assert facts.degrees_of_freedom == 1
    assert facts.constraint_rows == 17
    assert facts.redundant_rows == ()
    hinge = facts.joints[0]
    assert (hinge.first, hinge.second, hinge.free) == ("crank", "ground", 1)
    np.testing.assert_allclose(hinge.axis, (1, 0, 0), atol=1e-12)
    assert hinge.rows == ("hinge.s.x", "hinge.s.y", "hinge.s.z", "hinge.d1.xz", "hinge.d1.yz")
    text = str(facts)
    for word in (
        "1 degree of freedom",
        "crank → ground",
        "right-handed",
        "closed as given",
        "every reaction is unique",
    ):
        assert word in text


def test_redundancy_is_said_with_names():
    text = str(check(machines.four_bar(second="revolute", third="revolute")))
    assert "redundant: " in text
    assert (
        "reactions are not unique in: hinge, pin, pivot, sleeve" in text
        or "reactions are not unique in: hinge, pin, sleeve, pivot" in text
    )


def test_velocities_that_do_not_fit_are_corrected_and_said():
    from nivel import Joint

    machine = MachineRecord(
        name="m",
        bodies=(Body(name="a", mass=1, inertia=(1, 1, 1), velocity=(1, 0, 0)),),
        joints=(Joint(name="j", type="spherical", bodies=("ground", "a"), point=(0, 0, 0)),),
    )
    facts = check(machine)
    assert facts.velocity_change == (("a", pytest.approx(1.0), pytest.approx(0.0, abs=1e-12)),)
    assert "velocity of a changed by 1 m/s" in str(facts)


@pytest.mark.parametrize("kind", JOINTS)
def test_every_joint_states_its_convention(kind):
    convention = JOINTS[kind].composition.convention
    if not JOINTS[kind].composition.coordinates:
        assert convention == "no joint coordinate"
    for coordinate in JOINTS[kind].composition.coordinates:
        assert f"{coordinate.name}:" in convention


@pytest.mark.parametrize(
    ("duration", "step", "interval", "steps", "every"),
    [
        (1.0, 1e-3, None, 1000, 1),
        (8.0, 1e-3, 1e-2, 8000, 10),
        (8.0, 1e-3, None, 8000, 8),
        (0.25, 0.03, None, 9, 1),
        (1.0, 0.1, 0.3, 10, 3),
    ],
)
def test_steps_and_frames_of_a_run(duration, step, interval, steps, every):
    settings = complete(SimulationSettings(duration=duration, step=step, output_interval=interval))
    assert (settings.steps, settings.every) == (steps, every)


def test_output_interval_between_two_multiples_is_refused_with_both():
    with pytest.raises(ModelError, match=r"0\.009 or 0\.012"):
        complete(SimulationSettings(duration=1.0, step=3e-3, output_interval=0.01))


@pytest.mark.parametrize(("duration", "step"), [(1.0, 1e-300), (1e300, 1e-3), (1e300, 1e-300), (1.0, 1e-18)])
def test_more_steps_than_a_machine_can_take_are_refused(duration, step):
    with pytest.raises(ModelError, match="steps"):
        complete(SimulationSettings(duration=duration, step=step))


def test_orientation_is_shown_in_degrees():
    body = Body(name="a", mass=1, inertia=(1, 1, 1), orientation={"axis": [0, 0, 1], "angle": "30 deg"})
    assert "turned 30 deg about (0, 0, 1)" in str(check(MachineRecord(name="m", bodies=(body,))))


def test_couplings_drivers_forces_and_sensors_are_said_in_words():
    text = """
format: 1
bodies:
  a: {mass: 1, inertia: [1, 1, 1]}
  b: {mass: 1, inertia: [1, 1, 1], position: [1, 0, 0]}
markers: {tip: {body: b, position: [0, 0.1, 0]}}
joints:
  left: {type: revolute, bodies: [ground, a], point: [0, 0, 0], axis: [0, 0, 1]}
  right: {type: revolute, bodies: [ground, b], point: [1, 0, 0], axis: [0, 0, 1]}
couplings: {pair: {type: gear, joints: [left, right], teeth: [20, 50]}}
drivers: {crank: {coordinate: left, value: 3*time}}
forces: {coil: {type: joint-spring-damper, coordinate: right, stiffness: 2 N*m/rad}}
sensors: {speed: {marker: tip, quantity: velocity}}
"""
    said = str(check(parse_machine(text)))
    assert "pair: gear, left.angle + 2.5 right.angle keeps its value" in said
    assert "crank: left.angle = 3.0*time" in said
    assert "coil: joint-spring-damper on right.angle" in said
    assert "speed: velocity of tip" in said
    assert "0 degrees of freedom" in said


def with_cut(machine, *names, **settings):
    return machine.replace(simulation=machine.simulation.replace(cut=names, **settings))


def test_joints_that_are_to_be_cut_make_the_coordinates_relative():
    """Also where absolute ones then cost less, as for the four-bar cut at its first joint."""
    machine = machines.four_bar()
    name = machine.joints[0].name
    assert _absolute_cost(with_cut(machine, name)) < _relative_cost(with_cut(machine, name))
    facts = check(with_cut(machine, name))
    assert (facts.settings.coordinates, facts.cut) == ("relative", (name,))
    assert choose_coordinates(with_cut(machine, name, formulation="lagrange")) == "absolute"
    assert choose_coordinates(with_cut(machine, name, coordinates="absolute")) == "absolute"


def test_a_joint_is_cut_once():
    with pytest.raises(ModelError, match="`pin`, `rod` stands here more than once") as caught:
        SimulationSettings(cut=("pin", "rod", "hinge", "rod", "pin"))
    assert caught.value.faults[0].path == "cut"
