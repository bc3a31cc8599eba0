"""Kinematic analysis against closed forms of linkages, its own derivatives, and runs; what it refuses, and where machines lock up."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import nivel
from example_files import rigid_example
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Reach
from nivel.results.analyses.mechanism import Range, joint_place
from references import four_bar, one_dof, slider_crank

EXAMPLES = "examples"
LINKAGES = {"slider-crank": (slider_crank, "hinge"), "four-bar": (four_bar, "crank_pivot")}
TURN = 2.0 * np.pi


def crank_angles(name, result):
    """The angle of the reference linkage at every position: that of the crank's centre of mass."""
    x = result.array("crank.position")
    if name == "slider-crank":
        return np.unwrap(np.arctan2(x[:, 1], -x[:, 2]))
    return np.unwrap(np.arctan2(x[:, 1], x[:, 0]))


@pytest.fixture(params=LINKAGES)
def driven(request):
    """(linkage, result of one turn of the crank in 2 s, its angles)."""
    module, joint = LINKAGES[request.param]
    machine = nivel.load(rigid_example(request.param))
    result = machine.kinematics(drive=joint, duration=2, positions=401)
    return module.LINKAGE, result, crank_angles(request.param, result)


def test_positions_are_those_of_the_closed_form(driven):
    linkage, result, angle = driven
    position, rotation = linkage.pose(angle)
    np.testing.assert_allclose(result.array("position"), position, atol=1e-12)
    assert np.abs(result.array("constraint_violation")).max() < 1e-12
    assert rotation.shape == (401, 3, 3, 3)


def test_velocities_and_accelerations_are_those_of_the_closed_form(driven):
    linkage, result, angle = driven
    rate = np.full(len(angle), np.sign(angle[-1] - angle[0]) * TURN / 2.0)
    first, _, second, _ = one_dof.curvature_of(linkage, angle)
    scale = np.abs(first).max() * np.abs(rate[0])
    np.testing.assert_allclose(result.array("velocity"), first * rate[0], atol=1e-11 * scale)
    np.testing.assert_allclose(result.array("acceleration"), second * rate[0] ** 2, atol=1e-10 * scale * abs(rate[0]))


def test_the_effort_of_the_driver_is_that_of_lagranges_equation(driven):
    """m φ̈ + ½ m' φ̇² = Q + τ with φ̈ = 0; the crank's angle in the machine may turn against that of the reference."""
    linkage, result, angle = driven
    rate = np.gradient(angle, result.time).mean()
    _, slope, force = one_dof.scalar_equation(linkage, angle)
    wanted = 0.5 * slope * rate**2 - force
    found = result.array("driver.drive.effort") * np.sign(rate)
    np.testing.assert_allclose(found, wanted, atol=1e-9 * np.abs(wanted).max())


def test_velocities_and_accelerations_are_derivatives_of_positions():
    """Fourth-order differences of 4001 positions: h⁴/30 of the fifth derivative is below 1e-8."""
    machine = nivel.load(f"{EXAMPLES}/mechanisms/watt-six-bar.yaml")
    result = machine.kinematics(duration="60 s/180", positions=4001)
    for lower, upper in (("position", "velocity"), ("velocity", "acceleration")):
        values = result.array(lower).reshape(4001, -1)
        slope = CubicSpline(result.time, values)(result.time, 1)[40:-40]
        wanted = result.array(upper).reshape(4001, -1)[40:-40]
        assert np.abs(slope - wanted).max() < 1e-7 * np.abs(wanted).max()


def test_every_coordinates_give_the_same_positions_and_reactions():
    machine = nivel.load(f"{EXAMPLES}/mechanisms/rssr.yaml")
    results = [machine.kinematics(coordinates=name, positions=31) for name in ("relative", "absolute")]
    for name in ("position", "acceleration", "joint_force", "joint_torque", "driver.motor.effort"):
        first, second = (each.array(name) for each in results)
        np.testing.assert_allclose(first, second, atol=1e-9 * max(1.0, np.abs(second).max()))


def test_long_steps_are_shortened_and_end_in_the_same_positions():
    machine = nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml")
    coarse, fine = (machine.kinematics(drive="hinge", positions=count) for count in (4, 3001))
    np.testing.assert_allclose(coarse.array("position"), fine.array("position")[::1000], atol=1e-11)
    assert coarse.timing["rejected"] > 0


def test_a_run_has_the_multipliers_of_kinematics():
    machine = nivel.load(f"{EXAMPLES}/mechanisms/rssr.yaml")
    run = machine.simulate(duration=0.5, step="0.1 ms", output_interval="0.05 s")
    still = machine.kinematics(duration=0.5, positions=11)
    wanted = still.array("driver.motor.effort")
    np.testing.assert_allclose(run.array("driver.motor.effort"), wanted, atol=1e-9 * np.abs(wanted).max())


FOUR_BAR = (0.08, np.hypot(0.23, 0.105), np.hypot(0.03, 0.185), 0.26)  # crank, coupler, rocker, ground of the example


def test_the_transmission_angle_of_a_slider_is_that_against_the_normal_of_its_slide():
    """sin μ = x/l, x the part of the rod of length l along the slide; joints in one place have no line."""
    result = nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml").kinematics(drive="hinge", positions=31)
    rod = result.array("slider.position") - joint_place(result, "pin")
    wanted = np.arcsin(np.abs(rod[:, 0]) / np.linalg.norm(rod, axis=1))
    np.testing.assert_allclose(result.transmission_angle("pin", "wrist", "slide"), wanted, atol=1e-7)
    with pytest.raises(nivel.ModelError, match="in one place"):
        result.transmission_angle("slide", "wrist", "pin")


def test_a_rocker_goes_as_far_as_crank_and_coupler_are_in_line():
    """Dead centres of a crank-rocker: the pin is at a + b and at b - a from the crank's pivot."""
    machine = nivel.load(f"{EXAMPLES}/mechanisms/four-bar-revolutes.yaml")
    found = machine.range_of_motion("rocker_pivot")
    a, b, c, d = FOUR_BAR
    wanted = [np.arccos((c * c + d * d - far * far) / (2.0 * c * d)) for far in (a + b, b - a)]
    # angle of the rocker from the line to the crank's pivot, at the start π - atan2(0.185, -0.03)
    start = np.pi - np.arctan2(0.185, -0.03)
    lows = sorted(start - each for each in wanted)
    np.testing.assert_allclose([found.low, found.high], lows, atol=1e-6)
    assert not found.full_turn
    assert "drive is held by" in found.low_reason
    assert f"rocker_pivot.angle is {found.low:.6g} rad" in found.low_reason
    assert found.trust.light == "green"
    assert "the turning points of the curve of positions" in str(found)
    ends = next(item for item in found.trust.items if item.name == "ends")
    assert ends.fraction < 1e-9


def test_ends_of_a_range_that_are_no_turning_points_are_red():
    """Half a degree before the dead centre."""
    found = Range("pivot.angle", "rad", -1.0, 0.49, False, "", "the machine jams")
    reach = Reach(outcome="done", range=found, ways=(), turning=(-2.0, 0.5))
    assert assess(reach).verdict == "red"
    assert assess(replace(reach, turning=None)).light == "not verified"


def test_a_crank_that_can_turns_right_round():
    found = nivel.load(f"{EXAMPLES}/mechanisms/four-bar-revolutes.yaml").range_of_motion("crank_pivot")
    assert found.full_turn
    assert found.summary()["light"] == "green"


def test_a_locked_machine_keeps_its_positions_and_says_what_holds_it():
    machine = nivel.load(f"{EXAMPLES}/mechanisms/four-bar-revolutes.yaml")
    with pytest.raises(nivel.SolveError) as caught:
        machine.kinematics(drive="rocker_pivot")
    assert "jams" in caught.value.message
    assert "drive is held by crank_pivot" in caught.value.message
    result = caught.value.result
    assert len(result.time) > 10
    assert result.trust.verdict == "red"
    assert np.abs(result.array("constraint_violation")).max() < 1e-12
    assert not any("is passed" in item.text for item in result.trust.items)  # it ends in the singular position


def test_the_transmission_angle_is_that_of_the_cosine_law():
    machine = nivel.load(f"{EXAMPLES}/mechanisms/four-bar-revolutes.yaml")
    result = machine.kinematics(drive="crank_pivot", positions=91)
    found = result.transmission_angle("crank_pin", "rocker_pin", "rocker_pivot")
    a, b, c, d = FOUR_BAR
    turn = np.pi / 2 + result.array("crank_pivot.angle") - result.array("crank_pivot.angle")[0]
    far = a * a + d * d - 2.0 * a * d * np.cos(turn)
    np.testing.assert_allclose(found, np.arccos((b * b + c * c - far) / (2.0 * b * c)), atol=1e-10)


def test_the_curvature_of_a_cranks_pin_is_one_over_its_radius():
    machine = nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml")
    result = machine.kinematics(drive="hinge", positions=37)
    curve = result.coupler_curve("crank", (0.25, 0.0, 0.0))
    np.testing.assert_allclose(curve["curvature"], 2.0, rtol=1e-10)
    assert int(curve["cusp"].sum()) == 0
    rolling = result.coupler_curve("slider")  # a straight line, with a dwell at both dead centres
    assert np.nanmax(np.abs(rolling["curvature"])) < 1e-6


def test_motions_that_nothing_drives_are_named():
    with pytest.raises(nivel.ModelError, match=r"1 motion is not driven.*hinge.angle.*--drive"):
        nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml").kinematics()


def test_two_drivers_of_one_motion_are_refused():
    machine = nivel.load(f"{EXAMPLES}/mechanisms/rssr.yaml")
    with pytest.raises(nivel.ModelError, match="driven by motor already"):
        machine.kinematics(drive="shaft.angle")


def test_drivers_that_repeat_each_other_are_refused():
    """Two drivers at rest where they are: consistent, and one too many."""
    record = nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml").record
    drivers = tuple(nivel.Driver(name=n, coordinate=c, value="0 * time") for n, c in (("a", "hinge"), ("b", "slide")))
    machine = nivel.Machine.from_record(record.replace(drivers=drivers))
    with pytest.raises(nivel.ModelError, match="more motions than there are"):
        machine.kinematics()


def test_bodies_that_bend_are_refused():
    with pytest.raises(nivel.ModelError, match="drivers alone do not determine the motion of a beam"):
        nivel.load(f"{EXAMPLES}/beams/slider-crank.yaml").kinematics()


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"drive": "henge.angle"}, "did you mean `hinge`"),
        ({"positions": 1}, "a whole number from 2"),
        ({"positions": "many"}, "a whole number from 2"),
        ({"end": "1 rad"}, "name it with `drive`"),
        ({"drive": "slide"}, "say to which one it is driven"),
        ({"drive": "hinge", "end": "5 kg"}, "an angle"),
        ({"drive": "hinge", "duration": 0}, "greater than zero"),
        ({"drive": "hinge", "coordinates": "polar"}, "absolute, relative"),
    ],
)
def test_bad_options_are_explained(given, said):
    with pytest.raises(nivel.ModelError, match=said):
        nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml").kinematics(**given)


# --- singular positions ---


def parallelogram():
    """Crank and rocker of 1 m, two metres apart, at 60 degrees: at 180 and 360 degrees all bars lie flat, and it may become crossed."""
    x, y = np.cos(np.pi / 3), np.sin(np.pi / 3)
    places = {"crank": (x / 2, y / 2, 0), "coupler": (x + 1, y, 0), "rocker": (2 + x / 2, y / 2, 0)}
    bodies = [nivel.Body(name=n, mass=1.0, inertia=(0.1, 0.1, 0.1), position=p) for n, p in places.items()]
    kinds = (
        ("p", "revolute", ("ground", "crank"), (0, 0, 0)),
        ("a", "spherical", ("crank", "coupler"), (x, y, 0)),
        ("b", "cylindrical", ("coupler", "rocker"), (2 + x, y, 0)),
        ("q", "revolute", ("rocker", "ground"), (2, 0, 0)),
    )
    joints = [
        nivel.Joint(name=n, type=kind, bodies=ends, point=at, **({} if kind == "spherical" else {"axis": (0, 0, 1)}))
        for n, kind, ends, at in kinds
    ]
    return nivel.Machine("parallelogram", bodies=bodies, joints=joints)


def test_positions_behind_a_flat_parallelogram_are_said_to_be_one_of_several():
    """It is flat at 1/3 and 5/6 of the turn; the coupler goes on without turning, which is the branch that it is on."""
    result = parallelogram().kinematics(drive="p", positions=50)
    (item,) = [each for each in result.trust.items if each.name == "branches"]
    assert item.verdict == "amber"
    assert "passed between 0.32" in item.text
    assert "0.81" in item.text
    np.testing.assert_allclose(result.array("coupler.orientation")[-1], [1.0, 0.0, 0.0, 0.0], atol=1e-12)


def test_a_frame_on_a_singular_position_is_told():
    with pytest.raises(nivel.SolveError) as caught:
        parallelogram().kinematics(drive="p", positions=37)
    assert "t = 0.333333 s is singular" in caught.value.message
    assert "another number of positions" in caught.value.advice


def test_ordinary_machines_stay_on_one_branch():
    result = nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml").kinematics(drive="hinge", positions=19)
    assert [each.verdict for each in result.trust.items if each.name == "branches"] == ["green"]


def test_a_constant_speed_asks_for_no_more_positions():
    """The rate of the driver is constant but for round-off, which no further positions would show better."""
    result = nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml").kinematics(drive="hinge", duration=2)
    assert len(result.time) == 361
    assert np.ptp(result.array("hinge.angle.rate")) < 1e-12
    assert "between_frames" not in [each.name for each in result.trust.items]


def test_states_that_keep_their_start_are_told():
    """A controller moves on in a run, but not here: what its motor does is not what it would do."""
    machine = nivel.load(f"{EXAMPLES}/control/servo-axis.yaml")
    result = machine.kinematics(drive="guide", end="10 cm", positions=11)
    assert result.trust.verdict == "amber"
    assert any(item.name == "states" and "keep their initial values" in item.text for item in result.trust.items)
    found = machine.inverse(actuators="guide", motion=result)
    assert any("keep their initial values" in each for each in found.statements())
