"""The machines of a newcomer's first day: each does what its first line says."""

import numpy as np
import pytest

import nivel
from example_files import rigid_example

MACHINES = (
    "backhoe-swing",
    "conveyor",
    "differential",
    "double-wishbone",
    "excavator",
    "flywheel-press",
    "geneva-drive",
    "gripper",
    "mobile-crane",
    "robot-arm",
    "rope-crane",
    "rough-ground",
    "stewart-platform",
    "washing-machine",
    "wedge-press",
)
FORCES = ("normal_force", "normal_z", "friction_z")


def simulated(name, **settings):
    return nivel.load(rigid_example(name)).simulate(**settings)


def way(t, begin, end, length):
    """The quintic between two times."""
    s = np.clip((t - begin) / (end - begin), 0, 1)
    return length * (10 * s**3 - 15 * s**4 + 6 * s**5)


@pytest.mark.parametrize("name", MACHINES)
def test_a_machine_takes_at_most_forty_lines(name):
    assert len((rigid_example(name)).read_text(encoding="utf-8").splitlines()) <= 40


def test_cylinders_of_the_excavator_move_by_their_strokes():
    result = simulated("excavator")
    t = result.time
    strokes = {
        "boom_ram": way(t, 0.5, 3, 0.35),
        "stick_ram": way(t, 2, 4.5, -0.30),
        "bucket_ram": way(t, 4, 5.5, 0.25) - way(t, 6, 7.5, 0.25),
    }
    for name, stroke in strokes.items():
        length = result.array(f"{name}.distance")
        np.testing.assert_allclose(length - length[0], stroke, atol=1e-9)


def test_the_work_of_the_excavators_cylinders_is_the_weight_times_its_rise():
    """At rest again: the bucket ends as it began, boom and stick are higher."""
    result = simulated("excavator")
    masses = {"boom": 1400, "stick": 700, "bucket": 500}
    risen = sum(
        mass
        * 9.81
        * np.ptp(result.array(f"{name}.position")[[0, -1], 2])
        * np.sign(result.array(f"{name}.position")[-1, 2] - result.array(f"{name}.position")[0, 2])
        for name, mass in masses.items()
    )
    assert result.array("external_work")[-1] == pytest.approx(risen, rel=1e-6)


def test_legs_of_the_platform_have_the_lengths_that_are_driven():
    result = simulated("stewart-platform")
    t, grown = result.time, way(result.time, 0, 1.5, 0.1)
    for k, phase in enumerate((0, 0.5, 2, 2.5, 4, 4.5)):
        length = result.array(f"leg_{k + 1}.distance")
        assert length[0] == pytest.approx(np.sqrt(1.2**2 + 0.7**2 - 2 * 1.2 * 0.7 * 0.5 + 1.1**2), abs=1e-12)
        np.testing.assert_allclose(length - length[0], grown * np.sin(2.5 * t + phase), atol=1e-9)


def test_the_arm_follows_its_trajectory_and_comes_to_rest():
    result = simulated("robot-arm")
    for k in range(1, 7):
        assert np.degrees(np.abs(result.array(f"force.drive_{k}.error")).max()) < 3.0
        assert abs(result.array(f"j{k}.angle.rate")[-1]) < 0.02
    halfway = np.searchsorted(result.time, 1.5)
    assert np.degrees(result.array("j1.angle")[halfway]) == pytest.approx(60, abs=1.0)


def test_the_geneva_wheel_stands_after_every_quarter_turn():
    result = simulated("geneva-drive")
    angle = np.degrees(result.array("pivot.angle"))
    for time, expected in ((0.6, 0), (1.6, -90), (2.4, -90), (3.6, -180), (4.4, -180), (5.6, -270)):
        assert angle[np.searchsorted(result.time, time)] == pytest.approx(expected, abs=0.02)
    # in between it follows the geometry: tan of its angle is sin α / (√2 - cos α), α of the crank from the line of centres
    t = np.array([0.85, 0.95, 1.1, 1.2])
    alpha = np.pi * (t - 1)
    exact = -45 - np.degrees(np.arctan2(np.sin(alpha), np.sqrt(2) - np.cos(alpha)))
    found = np.interp(t, result.time, angle)
    np.testing.assert_allclose(found, exact, atol=0.3)


def test_a_fast_drum_turns_about_its_centre_of_mass():
    """Far above its resonances a suspended rotor shakes by m r / M; near them by more."""
    result = simulated("washing-machine")
    x, t = result.array("sensor.shake.x"), result.time
    fast, slow = np.ptp(x[t > 9]), np.ptp(x[(t > 2.5) & (t < 3.5)])
    assert fast == pytest.approx(2 * 1.0 * 0.2 / 48, rel=0.25)
    assert slow > 1.7 * fast


def test_the_wheel_rises_over_the_bump_and_its_camber_turns_inwards():
    result = simulated("double-wishbone")
    rise = result.array("knuckle.position")[:, 2] - result.array("knuckle.position")[0, 2]
    camber = np.degrees(result.array("sensor.camber_and_toe.first"))
    top = int(np.argmax(rise))
    assert 0.045 < rise[top] < 0.08
    assert camber[top] - camber[0] > 0.5  # of a left wheel: about +x, its top leans towards the car
    assert rise[-1] == pytest.approx(0.0, abs=1e-4)


def test_the_rope_carries_the_load_and_shortens_by_what_the_winch_hauls_in():
    """The tension is the force that the motion of the load needs, |m (a - g) + c v|, and equals m g at the start."""
    result = simulated("rope-crane")
    tension, across = result.array("force.rope.magnitude"), np.array([80.0, 80.0, 0.0])
    needed = 800 * (result.array("load.acceleration") - np.array([0, 0, -9.81])) + across * result.array(
        "load.velocity"
    )
    np.testing.assert_allclose(tension, np.linalg.norm(needed, axis=1), rtol=1e-9)
    assert tension[0] == pytest.approx(800 * 9.81, rel=1e-9)
    length = result.array("state.rope.length")
    assert length[-1] - length[0] == pytest.approx(-2.0, abs=1e-9)
    assert np.degrees(result.array("slewing.angle")[-1]) == pytest.approx(90, abs=0.1)


def test_the_wedge_is_pushed_with_the_force_of_its_slope_and_friction():
    """F = W (tan α + μ)/(1 - μ tan α) where the speed is largest and the block does not accelerate; W its load and weight."""
    result = simulated("wedge-press")
    k = int(np.argmin(np.abs(result.time - 0.5)))
    slope, mu = 0.25, 0.15
    section = 0.05 * (0.06 + (0.06 - 0.05 * slope)) / 2
    weight = 2000 + 9.81 * 7850 * 0.04 * section
    force = weight * (slope + mu) / (1 - mu * slope)
    assert -result.array("driver.push.effort")[k] == pytest.approx(force, rel=1e-5)
    sunk = result.array("force.faces.depth")[-1] * np.sqrt(1 + slope**2)
    np.testing.assert_allclose(result.array("guide.displacement")[-1], 0.08 * slope - sunk, atol=1e-8)


def test_four_falls_raise_the_hook_by_a_quarter_of_what_the_drum_winds_up():
    """At rest again each fall has a quarter of the weight, by which the rope is stretched."""
    machine = nivel.load(rigid_example("mobile-crane"), {"drivers.turn.value": "0*time", "simulation.duration": 9})
    result = machine.simulate()
    tension = (3000 + 120) * 9.81 / 4
    assert result.array("force.rope.magnitude")[-1] == pytest.approx(tension, rel=1e-5)
    rise = np.ptp(result.array("block.position.z")[[0, -1]])
    assert rise == pytest.approx((4.0 - tension / 600e3) / 4, abs=1e-6)


def test_the_conveyor_carries_its_boxes_and_is_green_by_default():
    """Each is at rest on the belt at the end, which has given it m v², but for what it was pushed while the belt started."""
    result = simulated("conveyor")
    assert result.trust.verdict == "green"
    for name in ("first", "second", "third"):
        assert result.array(f"{name}.velocity.x")[-1] == pytest.approx(0.8, abs=1e-9)
        assert result.array(f"force.carry_{name}.sticks")[-1] == 1.0
    assert np.abs(result.array("energy_error")).max() < 1e-4 * result.array("external_work")[-1]


def test_the_gripper_lifts_its_box_and_is_green_by_default():
    """The pads carry the weight by friction; the box has risen with the hand."""
    result = simulated("gripper")
    assert result.trust.verdict == "green"
    rise = np.ptp(result.array("hand.position.z"))
    assert result.array("box.position.z")[-1] - result.array("box.position.z")[0] == pytest.approx(rise, abs=1e-4)
    pads = [f"force.{side}_pad" for side in ("left", "right")]
    out = {name: np.array([result.array(f"{pad}.{name}")[-1] for pad in pads]) for name in FORCES}
    lifts = -np.sum(out["normal_force"] * out["normal_z"] + out["friction_z"])
    assert lifts == pytest.approx(900 * 0.06 * 0.06 * 0.08 * 9.81, rel=1e-3)
    assert result.array("force.stand.normal_force")[-1] == 0.0


def test_the_differential_gives_one_wheel_what_it_takes_from_the_other():
    """ω_left + ω_right = 2 ω_cage; straight on both turn alike, with the left one braked the right one turns twice as fast."""
    result = simulated("differential")
    assert result.trust.verdict == "green"
    left, right, cage = (result.array(name) for name in ("left.angle", "right.angle", "cage.angle"))
    np.testing.assert_allclose(left + right, 2 * cage, atol=1e-9)
    rates = result.array("joint_rate")[:, [0, 1, 3]]
    straight = np.searchsorted(result.time, 1.9)
    np.testing.assert_allclose(rates[straight], 2.0, rtol=1e-4)
    np.testing.assert_allclose(rates[-1], [0.0, 4.0, 2.0], atol=1e-4)


def test_the_press_takes_its_work_from_the_flywheel_and_stops_at_the_top():
    """The flywheel gives the work; released in time, the crank stands at the top again, held by its brake."""
    result = simulated("flywheel-press")
    assert result.trust.verdict == "green"
    assert result.array("bearing.angle")[-1] / (2 * np.pi) == pytest.approx(1.0, abs=0.01)
    assert np.ptp(result.array("bearing.angle")[result.time > 1.3]) < 1e-9
    # the clutch is locked, slips while the blow asks for more than its capacity, and locks again
    slip = np.abs(result.array("force.clutch.slip"))
    assert slip[(result.time > 0.6) & (result.time < 0.72)].max() < 1e-7 * slip.max()  # ten times the tolerance
    assert slip.max() > 1.0
    assert slip[(result.time > 1.05) & (result.time < 1.16)].max() < 1e-7 * slip.max()
    assert np.abs(result.array("force.workpiece.magnitude")).max() > 4e5
    assert np.abs(result.array("energy_error")).max() < 1e-3 * result.array("kinetic_energy").max()


def test_the_chain_of_the_backhoe_pulls_with_one_strand_and_its_cam_repeats():
    result = simulated("backhoe-swing")
    assert result.trust.verdict == "green"
    motor, swing = result.array("motor.angle"), result.array("swing.angle")
    assert result.array("force.chain.second_tension").max() == 0.0
    # the rims differ by the slack and the stretch of the strand that pulls
    stretch = result.array("force.chain.first_tension")[-1] / 2e6
    assert 0.08 * motor[-1] - 0.24 * swing[-1] == pytest.approx(0.002 + stretch, abs=2e-5)
    from scipy.interpolate import CubicSpline

    points = np.radians([0, 30, 60, 90, 180, 270, 300, 330, 360])
    lift = CubicSpline(points, [0, 0, 0.008, 0.02, 0.024, 0.02, 0.008, 0, 0], bc_type="periodic")
    np.testing.assert_allclose(result.array("bore.displacement"), lift(swing), atol=1e-9)
