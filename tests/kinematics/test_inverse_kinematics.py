"""Inverse kinematics against the closed form of two links, on a redundant arm, with limits, out of reach, and with closed loops."""

import numpy as np
import pytest
import stewart_platform

import nivel

LENGTHS = (1.0, 0.8, 0.6)


def arm(count):
    """Links in a row in the XY plane, drawn along x; a marker `tip` at the end."""
    bodies, joints, x = [], [], 0.0
    for k, length in enumerate(LENGTHS[:count], 1):
        bodies.append(nivel.Body(name=f"link_{k}", mass=1.0, inertia=(0.1, 0.1, 0.1), position=(x + length / 2, 0, 0)))
        pair = ("ground" if k == 1 else f"link_{k - 1}", f"link_{k}")
        joints.append(nivel.Joint(name=f"j{k}", type="revolute", bodies=pair, point=(x, 0, 0), axis=(0, 0, 1)))
        x += length
    tip = nivel.Marker(name="tip", body=f"link_{count}", position=(LENGTHS[count - 1] / 2, 0, 0))
    # a little bent, since a straight arm is a singular position
    joints[1] = joints[1].replace(start={"angle": 0.5})
    return nivel.Machine("arm", bodies=bodies, joints=joints, markers=[tip])


def circle(centre, radius, count=9):
    turn = np.linspace(0.0, 2.0 * np.pi, count)
    return np.column_stack([centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn), np.zeros(count)])


def planar(machine, places, **options):
    """The path without its third row, which a planar arm cannot change: wanted is where it is already."""
    return machine.inverse_kinematics("tip", places, **options)


def test_two_links_follow_their_closed_form():
    """cos q₂ = (x² + y² - l₁² - l₂²)/(2 l₁ l₂) on the branch that it starts on."""
    places = circle((0.9, 0.6), 0.3)
    found = planar(arm(2), places)
    assert found.reached.all()
    a, b = LENGTHS[:2]
    wanted = np.arccos((np.sum(places**2, axis=1) - a * a - b * b) / (2.0 * a * b))
    np.testing.assert_allclose(found["j2.angle"], wanted, atol=1e-8)
    assert found.trust.light == found.to_xarray().attrs["verdict"] == "green"
    assert "verified by the place of the point in every posture" in str(found)


def test_a_redundant_arm_comes_near_the_preferred_posture():
    """On the path, and of all postures there the one nearest to the wish: the gradient has no part that leaves the tip in place."""
    machine = arm(3)
    places = np.tile([1.2, 0.9, 0.0], (12, 1))
    wish = {"j1": 0.1, "j2": 0.8, "j3": 0.4}
    found = planar(machine, places, posture=wish)
    assert found.reached.all()
    q = found.values[-1]
    J = machine.mechanics().jacobian("tip", q)[:2]
    _, _, every = np.linalg.svd(J)
    assert abs(every[2] @ (np.array([0.1, 0.8, 0.4]) - q)) < 1e-5


def test_limits_are_kept_by_going_another_way():
    machine = arm(3)
    free = planar(machine, [[0.8, 1.2, 0.0]], posture={"j1": 1.5})
    assert abs(np.angle(np.exp(1j * free["j1.angle"][0]))) > np.radians(40.0)
    kept = planar(machine, [[0.8, 1.2, 0.0]], posture={"j1": 1.5}, limits={"j1": ("-40 deg", "40 deg")})
    assert kept.reached.all()
    assert abs(kept["j1.angle"][0]) <= np.radians(40.0) + 1e-12


def test_a_place_that_only_limits_put_out_of_reach_is_told_with_them():
    """One link free, the other held at 30 degrees: the nearest point of the circle of the held elbow."""
    found = planar(arm(2), [[0.3, 0.4, 0.0]], limits={"j2": ("10 deg", "30 deg")})
    a, b = LENGTHS[:2]
    near = np.sqrt(a * a + b * b + 2.0 * a * b * np.cos(np.radians(30.0)))
    assert not found.reached[0]
    assert found.error[0, 0] == pytest.approx(near - 0.5, abs=1e-6)
    assert found.limits[0] == ("j2.angle",)
    assert found.trust.verdict == "red"
    assert "0 of 1 are reached" in found.trust.items[1].text
    assert "at their limits: j2.angle" in found.statements()[0]


def test_out_of_reach_ends_stretched_towards_the_place_and_is_told():
    """The nearest point of the disc of radius 1.8 is on the ray to the place."""
    found = planar(arm(2), [[3.0, 4.0, 0.0]])
    assert not found.reached[0]
    assert found.error[0, 0] == pytest.approx(5.0 - 1.8, abs=1e-6)
    assert "not reached" in found.statements()[0]


def test_closed_loops_stay_closed_and_a_whole_pose_is_reached():
    """The plate of a Stewart platform, turned by 5 degrees about z and moved: legs are as long as its corners are apart."""
    record = stewart_platform.machine().record
    machine = nivel.Machine.from_record(record.replace(drivers=()))
    turn, shift = np.radians(5.0), np.array([0.05, -0.03, 0.08])
    theta = [np.cos(turn / 2), 0.0, 0.0, np.sin(turn / 2)]
    found = machine.inverse_kinematics("plate", [np.array([0.0, 0.0, 1.2]) + shift], orientations=[theta])
    assert found.reached.all()
    base, top = stewart_platform.corners()
    A = np.array([[np.cos(turn), -np.sin(turn), 0.0], [np.sin(turn), np.cos(turn), 0.0], [0.0, 0.0, 1.0]])
    centre = np.array([0.0, 0.0, stewart_platform.HEIGHT])
    moved = (top - centre) @ A.T + centre + shift
    wanted = np.linalg.norm(moved - base, axis=1) - np.linalg.norm(top - base, axis=1)
    legs = [found[f"leg_{k}.displacement"][0] for k in range(1, 7) if f"leg_{k}.displacement" in found.coordinates]
    assert legs
    np.testing.assert_allclose(legs, wanted[: len(legs)], atol=1e-8)


def test_a_path_becomes_a_trajectory_whose_efforts_are_found(tmp_path):
    machine = arm(2)
    places = circle((0.9, 0.6), 0.3, 13)
    path = planar(machine, places, times=np.linspace(0.0, 2.0, 13))
    table = path.save_csv(tmp_path / "way.csv")
    efforts = machine.inverse(actuators=["j1", "j2"], trajectory=table, positions=25)
    assert efforts.complete


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"point": "tipp"}, "no marker or body `tipp`"),
        ({"places": [[1.0, 2.0]]}, "rows of 3 numbers"),
        ({"orientations": [[1.0, 0.0, 0.0]]}, "rows of 4 numbers"),
        ({"limits": {"j9": (0, 1)}}, "no independent coordinate `j9`"),
        ({"limits": {"j1": (1, 0)}}, "must be below"),
        ({"limits": {"j1": 3}}, "low and high"),
        ({"posture": {"j1": "3 kg"}}, "angle"),
        ({"times": [1.0, 2.0]}, "1 ascending times"),
    ],
)
def test_bad_arguments_are_explained(given, said):
    arguments = {"point": "tip", "places": [[1.0, 0.5, 0.0]], **given}
    with pytest.raises(nivel.ModelError, match=said):
        arm(2).inverse_kinematics(arguments.pop("point"), arguments.pop("places"), **arguments)
