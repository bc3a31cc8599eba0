"""What the assembly has to respect: values marked fixed, weights, start values of joint coordinates, the largest gap."""

import numpy as np
import pytest

import machines
from nivel import AssemblySettings, Body, Driver, Joint, MachineRecord, Marker
from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.equations import equations
from nivel.errors import ModelError
from nivel.machine.laws.time_function import Expression
from running import run

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])


def two_points(**options):
    """Two free bodies 0.2 m apart whose origins are pinned together; `options` of the second."""
    return MachineRecord(
        name="two",
        bodies=(
            Body(name="a", mass=1, inertia=(1, 1, 1)),
            Body(name="b", mass=1, inertia=(1, 1, 1), position=(0.2, 0, 0), **options),
        ),
        joints=(Joint(name="pin", type="spherical", markers=(Marker(body="a"), Marker(body="b"))),),
        assembly=AssemblySettings(largest_gap=0.3),
    )


def assembled_places(machine):
    motion = equations(machine, "newton-euler")
    count = len(machine.bodies)
    return assemble(machine, motion).y[: 7 * count].reshape(count, 7)[:, :3]


def test_a_held_body_stays_where_it_is():
    places = assembled_places(two_points(hold=True))
    np.testing.assert_allclose(places[1], [0.2, 0, 0], atol=0)
    np.testing.assert_allclose(places[0], [0.2, 0, 0], atol=1e-12)


def test_weights_share_the_way_by_their_squares():
    """min w_a² x_a² + w_b² x_b² with x_a + x_b = 0.2: x_a/x_b = w_b²/w_a²."""
    places = assembled_places(two_points(assembly_weight=3.0))
    np.testing.assert_allclose(places[0], [0.18, 0, 0], atol=1e-12)


@FORMULATIONS
def test_start_values_and_rates_of_joint_coordinates_are_held(formulation):
    """The four-bar's crank at its own angle and speed; the loop closes around them."""
    machine = machines.four_bar()
    crank = machine.joints[0]
    moved = machine.replace(
        joints=(crank.replace(start={"angle": 0.7}, start_rates={"angle": -3.0}), *machine.joints[1:])
    )
    result = run(moved, formulation=formulation, duration=1e-3)
    names = list(result.prepared.motion.system.layout.coordinates["joint_coordinate"])
    at = names.index(f"{crank.name}.angle")
    assert result.joint_coordinate[0, at] == pytest.approx(0.7, abs=1e-10)
    assert result.joint_rate[0, at] == pytest.approx(-3.0, abs=1e-9)
    assert np.abs(result.constraint_violation[0]).max() < 1e-11
    assert np.abs(result.constraint_rate_violation[0]).max() < 1e-10


def test_start_angle_of_several_turns():
    body = Body(name="wheel", mass=1, inertia=(1, 1, 1))
    hub = Joint(
        name="hub", type="revolute", bodies=("ground", "wheel"), point=(0, 0, 0), axis=(0, 0, 1), start={"angle": 20.0}
    )
    result = run(MachineRecord(name="m", bodies=(body,), joints=(hub,)), duration=1e-3)
    assert result.joint_coordinate[0, 0] == pytest.approx(20.0, abs=1e-10)


def test_start_far_away_is_reached():
    """A free joint has no end: a thousand times the machine's size."""
    body = Body(name="cart", mass=1, inertia=(1, 1, 1))
    rail = Joint(
        name="rail",
        type="translational",
        bodies=("ground", "cart"),
        point=(0, 0, 0),
        axis=(1, 0, 0),
        start={"displacement": 1000.0},
    )
    result = run(MachineRecord(name="m", bodies=(body,), joints=(rail,)), duration=1e-3)
    assert result.joint_coordinate[0, 0] == pytest.approx(1000.0, abs=1e-8)


def test_start_values_that_cannot_be_had_are_named():
    """The rocker of a crank-rocker does not get this far; the message says how near it comes."""
    machine = machines.four_bar()
    rocker = machine.joints[-1]
    impossible = machine.replace(joints=(*machine.joints[:-1], rocker.replace(start={"angle": 3.0})))
    with pytest.raises(ModelError, match=r"start value 3 of .* cannot be reached|cannot be closed") as caught:
        assemble(impossible, equations(impossible, "newton-euler"))
    assert caught.value.faults


def test_rates_that_contradict_each_other_are_named():
    body = Body(name="wheel", mass=1, inertia=(1, 1, 1))
    hub = Joint(name="hub", type="revolute", bodies=("ground", "wheel"), point=(0, 0, 0), axis=(0, 0, 1))
    other = hub.replace(name="other", start_rates={"angle": 2.0})
    drive = Driver(name="drive", coordinate="hub.angle", value=Expression("0.1*time"))
    machine = MachineRecord(name="m", bodies=(body,), joints=(hub, other), drivers=(drive,))
    with pytest.raises(ModelError, match=r"cannot be reached|contradict"):
        assemble(machine, equations(machine, "newton-euler"))


def test_gap_beyond_the_stated_distance_is_refused_and_one_within_is_closed():
    machine = two_points()
    assert np.ptp(assembled_places(machine), axis=0).max() < 1e-12
    for settings in (AssemblySettings(largest_gap=0.15), AssemblySettings()):
        with pytest.raises(ModelError, match=r"pin\.s\.x is open by 0\.2 m") as caught:
            assembled_places(machine.replace(assembly=settings))
        assert caught.value.faults[0].path == "joints.pin"


def test_driver_moves_the_assembly_to_its_value_at_the_start():
    body = Body(name="wheel", mass=1, inertia=(1, 1, 1))
    hub = Joint(name="hub", type="revolute", bodies=("ground", "wheel"), point=(0, 0, 0), axis=(0, 0, 1))
    drive = Driver(name="drive", coordinate="hub.angle", value=Expression("10 + 2*time"))
    machine = MachineRecord(name="m", bodies=(body,), joints=(hub,), drivers=(drive,))
    result = run(machine, duration=0.5, step=1e-3)
    np.testing.assert_allclose(result.joint_coordinate[:, 0], 10 + 2 * result.time, atol=1e-10)
    assert result.prepared.redundancy.degrees_of_freedom == 0
