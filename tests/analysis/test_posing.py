"""Machines moved by hand: joints stay closed, coordinates take the values that are wished, what is free is found."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import nivel
from example_files import rigid_example
from nivel.analysis.interactive import posing
from nivel.analysis.interactive.handles import nearest_angles, rates_of_angles
from nivel.analysis.interactive.posing import Posing

pytestmark = pytest.mark.covering

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
OPEN = 1e-9
CLOSED_LOOPS = ("slider-crank", "four-bar", "andrews-squeezer", "rssr", "watt-six-bar", "cam", "gear-train")


@pytest.fixture(autouse=True)
def patience(monkeypatch):
    """On a busy machine too all ranges are explored."""
    monkeypatch.setattr(posing, "EXPLORING", 100.0)


def posed(name) -> Posing:
    return nivel.load(rigid_example(name), allow_code=True).posed()


def gaps(machine: Posing) -> float:
    """Largest violation of a joint, coupling or driver in the present position, by its scale."""
    system = machine._motion.system
    rows = slice(0, system.machine_rows)
    return float(np.max(np.abs(system.record.constraints.C[rows]) / system.record.constraints.scale[rows], initial=0.0))


@pytest.mark.parametrize("name", CLOSED_LOOPS)
def test_every_movement_within_its_range_keeps_all_joints_closed(name):
    machine = posed(name)
    moving = [each for each in machine.movements if each.free]
    assert moving
    for each in moving:
        machine.reset()
        for value in np.linspace(each.low, each.high, 9):
            problem = machine.move(each.name, float(value))
            assert gaps(machine) < OPEN
            at = [m.name for m in machine.movements].index(each.name)
            if not problem:
                assert machine.values()[at] == pytest.approx(value, abs=1e-8)


def test_a_crank_goes_all_round_and_its_rocker_does_not():
    by_name = {each.name: each for each in posed("four-bar").movements}
    crank, rocker = by_name["crank_pivot.angle"], by_name["rocker_pivot.angle"]
    assert crank.high - crank.low == pytest.approx(2 * np.pi)
    # crank 0.4, coupler 1.0, rocker 0.8, ground 0.9 or whatever the file says: less than half a turn by Grashof
    assert 0.1 < rocker.high - rocker.low < np.pi


def test_other_freedoms_of_an_open_chain_stay():
    import runpy

    machine = runpy.run_path(str(EXAMPLES / "mechanisms" / "double_pendulum.py"))["machine"].posed()
    machine.move("elbow.angle", 0.4)
    machine.move("shoulder.angle", -0.9)
    values = dict(zip([each.name for each in machine.movements], machine.values(), strict=True))
    assert values == pytest.approx({"shoulder.angle": -0.9, "elbow.angle": 0.4}, abs=1e-9)


def test_what_cannot_be_reached_leaves_the_machine_as_it_was():
    machine = posed("four-bar")
    before = machine.pose()
    assert "cannot go there" in machine.move("rocker_pivot.angle", 100.0)
    assert "no coordinate" in machine.move("nothing.angle", 0.0)
    np.testing.assert_array_equal(machine.pose()[0], before[0])


def test_driven_machines_move_with_the_time():
    machine = posed("rssr")
    (time,) = [each for each in machine.movements if each.free]
    assert time.name == "time"
    assert machine.move("time", 0.5 * time.high) == ""
    assert gaps(machine) < OPEN
    machine.reset()
    assert machine.values()[-1] == 0.0


def test_a_body_that_nothing_holds_has_six_numbers():
    ball = nivel.Machine("ball", bodies=[nivel.Body(name="ball", mass=1, inertia=(1, 1, 1), position=(1, 2, 3))])
    machine = ball.posed()
    np.testing.assert_array_equal(machine.pose()[0], [[1, 2, 3]])
    assert [each.name for each in machine.movements if each.free] == [
        f"ball.{name}" for name in ("x", "y", "z", "angle_x", "angle_y", "angle_z")
    ]
    wanted = {"ball.y": -0.5, "ball.angle_z": 2.9, "ball.angle_y": -2.6, "ball.angle_x": 1.1, "ball.z": 3.5}
    for name, value in wanted.items():
        assert machine.move(name, value) == ""
    position, parameters = machine.pose()
    np.testing.assert_allclose(position, [[1.0, -0.5, 3.5]], atol=1e-9)
    expected = Rotation.from_euler("XYZ", [1.1, -2.6, 2.9])
    turned = Rotation.from_quat(parameters[0], scalar_first=True)
    assert (expected.inv() * turned).magnitude() < 1e-9


def on_a_ball(bodies=("ground", "bob")):
    body = nivel.Body(name="bob", mass=1, inertia=(0.1, 0.1, 0.1), position=(0, 0, -1))
    joint = nivel.Joint(name="ball", type="spherical", bodies=bodies, point=(0, 0, 0))
    return nivel.Machine("ball", bodies=[body], joints=[joint])


def test_a_spherical_joint_has_three_angles_that_go_all_round():
    machine = on_a_ball().posed()
    assert [each.name for each in machine.movements] == ["ball.angle_x", "ball.angle_y", "ball.angle_z"]
    for each in machine.movements:
        assert (each.low, each.high) == pytest.approx((-np.pi, np.pi))
    angles = [0.0, 0.0, 0.0]
    for axis, value in ((1, 0.4), (0, -1.2), (1, 0.5 * np.pi), (1, 2.4), (2, 3.0), (0, 2.0)):
        assert machine.move(machine.movements[axis].name, value) == ""
        angles[axis] = value
        assert machine.values() == pytest.approx(angles, abs=1e-9)
        expected = Rotation.from_euler("XYZ", angles)
        np.testing.assert_allclose(machine.pose()[0][0], expected.apply([0, 0, -1]), atol=1e-9)
        assert gaps(machine) < OPEN


def test_a_ball_between_ground_and_body_turns_the_same_whichever_is_named_first():
    poses = []
    for each in (on_a_ball(), on_a_ball(("bob", "ground"))):
        machine = each.posed()
        assert machine.move("ball.angle_x", 0.7) == ""
        poses.append(machine.pose()[0])
    np.testing.assert_allclose(*poses, atol=1e-9)


def test_numbers_of_balls_and_coordinates_stay_while_another_moves():
    link = {"mass": 1, "inertia": (0.1, 0.1, 0.1)}
    bodies = [nivel.Body(name=f"link_{k}", position=(0, 0, -0.5 - k), **link) for k in range(3)]
    joints = [
        nivel.Joint(name="top", type="spherical", bodies=("ground", "link_0"), point=(0, 0, 0)),
        nivel.Joint(name="knee", type="revolute", bodies=("link_0", "link_1"), point=(0, 0, -1), axis=(0, 1, 0)),
        nivel.Joint(name="low", type="spherical", bodies=("link_1", "link_2"), point=(0, 0, -2)),
    ]
    machine = nivel.Machine("chain", bodies=bodies, joints=joints).posed()
    wanted = {"top.angle_x": 0.3, "low.angle_z": -1.0, "knee.angle": 0.8, "low.angle_x": 0.2, "top.angle_y": 1.3}
    for name, value in wanted.items():
        assert machine.move(name, value) == ""
    values = dict(zip([each.name for each in machine.movements], machine.values(), strict=True))
    assert values == pytest.approx({"top.angle_z": 0.0, "low.angle_y": 0.0} | wanted, abs=1e-8)
    machine.reset()
    assert machine.values() == pytest.approx([0.0] * 7, abs=1e-12)


def test_a_rod_between_two_balls_gets_one_angle_for_its_spin():
    bodies = [
        nivel.Body(name="crank", mass=1, inertia=(0.1, 0.1, 0.1), position=(0, 0, 0)),
        nivel.Body(name="rod", mass=1, inertia=(0.1, 0.1, 0.1), position=(1.0, 0.5, 0)),
        nivel.Body(name="slider", mass=1, inertia=(0.1, 0.1, 0.1), position=(2.0, 0, 0)),
    ]
    joints = [
        nivel.Joint(name="pin", type="revolute", bodies=("ground", "crank"), point=(0, 0, 0), axis=(0, 0, 1)),
        nivel.Joint(name="near", type="spherical", bodies=("crank", "rod"), point=(0, 1, 0)),
        nivel.Joint(name="far", type="spherical", bodies=("rod", "slider"), point=(2, 0, 0)),
        nivel.Joint(name="rail", type="translational", bodies=("ground", "slider"), point=(2, 0, 0), axis=(1, 0, 0)),
    ]
    machine = nivel.Machine("crank", bodies=bodies, joints=joints).posed()
    names = [each.name for each in machine.movements if each.free]
    assert names[:2] == ["pin.angle", "rail.displacement"]
    (spin,) = names[2:]
    assert spin.startswith("near.angle_")
    before = dict(zip([each.name for each in machine.movements], machine.values(), strict=True))
    assert machine.move(spin, 0.5) == ""
    after = dict(zip([each.name for each in machine.movements], machine.values(), strict=True))
    assert after[spin] == pytest.approx(0.5, abs=1e-9)
    assert after["pin.angle"] == pytest.approx(before["pin.angle"], abs=1e-8)
    assert gaps(machine) < OPEN


def cardan(angles):
    return Rotation.from_euler("XYZ", angles).as_matrix()


@given(st.tuples(*[st.floats(-3.1, 3.1)] * 3))
def test_angles_are_those_that_the_turn_was_made_of(angles):
    R = cardan(angles)
    found = nearest_angles(R, np.array(angles))
    np.testing.assert_allclose(cardan(found), R, atol=1e-9)
    if abs(np.cos(angles[1])) > 1e-3:
        np.testing.assert_allclose(found, angles, atol=1e-9)


def test_rates_of_angles_are_their_derivatives():
    angles, h = np.array([0.3, -0.7, 1.9]), 1e-6
    for k in range(3):
        step = h * np.eye(3)[k]
        spin = (cardan(angles + step) - cardan(angles - step)) @ cardan(angles).T / (2 * h)
        omega = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
        np.testing.assert_allclose(rates_of_angles(angles) @ omega, np.eye(3)[k], atol=1e-8)


@pytest.mark.parametrize("value", [1e6, -1e300, np.nan, np.inf])
def test_values_far_beyond_the_range_are_refused_at_once(value):
    machine = on_a_ball().posed()
    before = machine.pose()
    assert "it goes from -3.142 to 3.142 rad" in machine.move("ball.angle_x", value)
    np.testing.assert_array_equal(machine.pose()[0], before[0])


BEAM = """
format: 1
bodies:
  weight: {position: [1, 0, 0], shape: {type: sphere, radius: 5 cm}, mass: 1}
beams:
  boom:
    from: [0, 0, 0]
    to: [1, 0, 0]
    section: {type: rectangle, width: 2 cm, height: 4 cm}
    material: {youngs_modulus: 70 GPa, poisson_ratio: 0.3, density: 2700 kg/m^3}
    elements: 6
joints:
  hinge: {type: revolute, bodies: [ground, boom.start], point: [0, 0, 0], axis: [0, 1, 0]}
  tip: {type: fixed, bodies: [boom.end, weight], point: [1, 0, 0]}
"""


def test_beams_go_along_without_bending(tmp_path):
    (tmp_path / "beam.yaml").write_text(BEAM, encoding="utf-8")
    machine = nivel.load(tmp_path / "beam.yaml").posed()
    assert [each.name for each in machine.movements if each.free] == ["hinge.angle"]
    assert [joint["name"] for joint in machine.scene["joints"]] == ["hinge", "tip"]
    before, _ = machine.pose()
    assert machine.move("hinge.angle", 0.5) == ""
    after, _ = machine.pose()
    np.testing.assert_allclose(after, Rotation.from_euler("y", 0.5).apply(before), atol=1e-9)
