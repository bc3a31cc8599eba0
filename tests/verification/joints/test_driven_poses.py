"""Markers whose whole pose is driven: where they go, and what it takes, against Newton's and Euler's equations."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import nivel

pytestmark = pytest.mark.covering

MASS, CENTRE, INERTIA = 3.0, np.array([0.1, 0.05, -0.02]), np.diag([0.2, 0.3, 0.4])
GRAVITY = np.array([0.0, 0.0, -9.81])
TIP, SEAT = np.array([0.2, -0.1, 0.3]), np.array([0.5, 0.0, 0.0])
TIP_TURNED, SEAT_TURNED = Rotation.from_euler("ZYX", [0.3, 0.5, -0.2]), Rotation.from_rotvec([0.2, 0.4, 0.5])
POSITION = ("0.3*sin(2*time)", "0.2*time^2", "1 + 0.1*cos(3*time)")
TABLE = np.linspace(0.0, 0.1, 6)
CURVED = Rotation.from_rotvec(np.column_stack([np.sin(3.0 * TABLE), 2.0 + TABLE**2, 0.3 * TABLE]))
# half of them with the other sign, which is the same turn
QUATERNIONS = CURVED.as_quat()[:, [3, 0, 1, 2]] * np.array([1, 1, -1, -1, 1, -1])[:, None]
FORMS = {
    "euler": (
        {"euler": ("1.1 + 0.4*sin(3*time)", "0.3*time", "2 + 0.8*sin(time)"), "sequence": "zyx"},
        lambda t: Rotation.from_euler("ZYX", [1.1 + 0.4 * np.sin(3 * t), 0.3 * t, 2 + 0.8 * np.sin(t)]),
    ),
    "axis": (
        {"axis": (1.0, -2.0, 0.5), "angle": "3 - 2*time^2"},
        lambda t: Rotation.from_rotvec((3 - 2 * t**2) * np.array([1.0, -2.0, 0.5]) / np.sqrt(5.25)),
    ),
    "euler_parameters": (
        {"euler_parameters": ("2 + time", "3*sin(time)", "-1", "time^2")},
        lambda t: Rotation.from_quat([3 * np.sin(t), -1.0, t**2, 2.0 + t]),
    ),
}
MOTIONS = ("x", "y", "z", "about_x", "about_y", "about_z")


def machine(orientation, **simulation):
    """A free body, drawn far from where it is driven."""
    return nivel.Machine(
        "flown",
        bodies=[nivel.Body(name="box", mass=MASS, inertia=(0.2, 0.3, 0.4), centre_of_mass=CENTRE, position=(1, 2, 3))],
        markers=[
            nivel.Marker(name="tip", body="box", position=TIP, orientation={"matrix": TIP_TURNED.as_matrix().tolist()}),
            nivel.Marker(
                name="seat", body="ground", position=SEAT, orientation={"matrix": SEAT_TURNED.as_matrix().tolist()}
            ),
        ],
        drivers=[
            nivel.Driver(name="fly", marker="tip", relative_to="seat", position=POSITION, orientation=orientation)
        ],
        gravity=tuple(GRAVITY),
        simulation={"duration": 0.02, "step": 0.005, "output_interval": 0.001, **simulation},
    )


def pose(t, turned):
    """Origin and axes of the body, and its tip's axes."""
    place = SEAT + SEAT_TURNED.apply([0.3 * np.sin(2 * t), 0.2 * t**2, 1 + 0.1 * np.cos(3 * t)])
    tip = SEAT_TURNED * turned(t)
    body = tip * TIP_TURNED.inv()
    return place - body.apply(TIP), body, tip


def efforts(t, turned, h=1e-3):
    """Force in the axes of the seat and torque in those of the tip: Newton–Euler, with differences of fourth order over h [s]."""

    def centre(t):
        origin, body, _ = pose(t, turned)
        return origin + body.apply(CENTRE)

    def omega(t):
        def step(h):
            return (pose(t + h, turned)[1] * pose(t - h, turned)[1].inv()).as_rotvec() / (2 * h)

        return (4 * step(h) - step(2 * h)) / 3

    def first(f):
        return (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h)

    second = (16 * (centre(t + h) + centre(t - h)) - centre(t + 2 * h) - centre(t - 2 * h) - 30 * centre(t)) / (
        12 * h**2
    )
    origin, body, tip = pose(t, turned)
    force = MASS * (second - GRAVITY)
    inertia = body.as_matrix() @ INERTIA @ body.as_matrix().T
    w = omega(t)
    torque = inertia @ first(omega) + np.cross(w, inertia @ w)
    torque += np.cross(centre(t) - origin - body.apply(TIP), force)
    power = force @ first(lambda t: pose(t, turned)[0] + pose(t, turned)[1].apply(TIP)) + torque @ w
    return np.concatenate([SEAT_TURNED.inv().apply(force), tip.inv().apply(torque)]), power


@pytest.mark.parametrize(
    "methods",
    [
        {"coordinates": "absolute"},
        {"coordinates": "relative"},
        pytest.param({"coordinates": "independent"}, marks=pytest.mark.full),
        pytest.param({"formulation": "lagrange"}, marks=pytest.mark.full),
        pytest.param({"formulation": "augmented-lagrangian"}, marks=pytest.mark.full),
        pytest.param({"integrator": "newmark", "step": 0.001}, marks=pytest.mark.full),
        pytest.param({"integrator": "radau"}, marks=pytest.mark.full),
    ],
    ids=lambda each: next(iter(each.values())),
)
@pytest.mark.parametrize("form", FORMS)
def test_a_driven_pose_takes_what_newton_and_euler_say(form, methods):
    orientation, turned = FORMS[form]
    result = machine(orientation, **methods).simulate()
    for k, t in enumerate(result.time):
        origin, body, _ = pose(t, turned)
        np.testing.assert_allclose(result.array("box.position")[k], origin, atol=1e-9)
        theta = Rotation.from_quat(result.array("box.orientation")[k][[1, 2, 3, 0]])
        assert (theta * body.inv()).magnitude() < 1e-9
        wanted, power = efforts(t, turned)
        got = [result.array(f"driver.fly.{motion}.effort")[k] for motion in MOTIONS]
        np.testing.assert_allclose(got, wanted, atol=2e-6)
        given = sum(result.array(f"driver.fly.{motion}.power")[k] for motion in MOTIONS)
        assert given == pytest.approx(power, abs=2e-6)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_a_pose_seen_from_a_tumbling_body_holds_by_its_accelerations_alone(coordinates):
    """Without stabilisation it drifts by the error of the steps only, and two bodies in space keep their momenta."""
    orientation, turned = FORMS["euler"]
    inertia = {"a": np.diag([0.5, 0.6, 0.7]), "b": np.diag([0.2, 0.3, 0.4])}
    result = nivel.Machine(
        "tumbling",
        bodies=[
            nivel.Body(name="a", mass=4, inertia=(0.5, 0.6, 0.7), angular_velocity=(1.0, -2.0, 0.5)),
            nivel.Body(name="b", mass=2, inertia=(0.2, 0.3, 0.4), position=(0, 0, 1)),
        ],
        markers=[nivel.Marker(name="seat", body="a", position=SEAT), nivel.Marker(name="tip", body="b")],
        drivers=[
            nivel.Driver(name="fly", marker="tip", relative_to="seat", position=POSITION, orientation=orientation)
        ],
        simulation={"duration": 0.1, "step": 0.001, "output_interval": 0.05, "stabilisation": "none"},
    ).simulate(coordinates=coordinates)
    momenta = []
    for k, t in enumerate(result.time):
        r, v, w = (
            {name: result.array(f"{name}.{word}")[k] for name in "ab"}
            for word in ("position", "velocity", "angular_velocity")
        )
        A = {name: Rotation.from_quat(result.array(f"{name}.orientation")[k][[1, 2, 3, 0]]) for name in "ab"}
        place = SEAT + np.array([0.3 * np.sin(2 * t), 0.2 * t**2, 1 + 0.1 * np.cos(3 * t)])
        np.testing.assert_allclose(A["a"].inv().apply(r["b"] - r["a"]), place, atol=1e-9)
        assert (A["a"].inv() * A["b"] * turned(t).inv()).magnitude() < 1e-9
        spin = {name: A[name].apply(inertia[name] @ A[name].inv().apply(w[name])) for name in "ab"}
        momenta.append(
            [4 * v["a"] + 2 * v["b"], sum(spin.values()) + np.cross(r["a"], 4 * v["a"]) + np.cross(r["b"], 2 * v["b"])]
        )
    np.testing.assert_allclose(momenta, [momenta[0]] * len(momenta), atol=1e-8)
    assert result.trust.verdict == "green"


def test_kinematics_of_a_driven_pose_finds_the_same_efforts():
    orientation, turned = FORMS["euler"]
    result = machine(orientation).kinematics(positions=3)
    got = [result.array(f"driver.fly.{motion}.effort")[-1] for motion in MOTIONS]
    np.testing.assert_allclose(got, efforts(result.time[-1], turned)[0], atol=2e-6)


def test_a_table_of_quaternions_is_passed_through_at_its_points_whatever_their_signs():
    table = {"times": TABLE.tolist(), "values": QUATERNIONS.tolist()}
    ball = nivel.Machine(
        "ball",
        bodies=[nivel.Body(name="b", mass=2, inertia=(0.1, 0.2, 0.25), centre_of_mass=(0.1, 0, 0))],
        markers=[nivel.Marker(name="e", body="b")],
        joints=[nivel.Joint(name="j", type="spherical", bodies=("ground", "b"), point=(0, 0, 0))],
        drivers=[nivel.Driver(name="d", marker="e", orientation={"euler_parameters": table})],
        simulation={"duration": 0.1, "step": 0.001, "integrator": "rk4"},
    )
    result = ball.simulate(coordinates="relative")
    frames = result.array("b.orientation")[:: round(0.02 / 0.001)]
    apart = Rotation.from_quat(frames[:, [1, 2, 3, 0]]) * CURVED.inv()
    assert apart.magnitude().max() < 1e-9
    assert result.trust.verdict == "green"


def test_the_driven_poses_of_a_platform_give_the_lengths_of_its_legs():
    feet = [(np.cos(a), np.sin(a), 0.0) for a in (0.0, 2.0, 2.3, 4.1, 4.3, 6.1)]
    heads = [(0.5 * np.cos(a), 0.5 * np.sin(a), 1.0) for a in (0.8, 1.4, 2.9, 3.4, 5.0, 5.6)]
    platform = nivel.Machine(
        "platform",
        bodies=[nivel.Body(name="top", mass=10, inertia=(1, 1, 2), position=(0, 0, 1))],
        markers=[nivel.Marker(name="centre", body="top")],
        joints=[
            nivel.Joint(name=f"leg_{k}", type="variable-distance", bodies=("ground", "top"), points=ends)
            for k, ends in enumerate(zip(feet, heads, strict=True))
        ],
        drivers=[
            nivel.Driver(
                name="move",
                marker="centre",
                position=("0.1*time", 0, "1 + 0.2*time"),
                orientation={"euler": ("0.3*time", 0, "0.2*time"), "sequence": "zyx"},
            )
        ],
    )
    result = platform.kinematics(duration=1.0, positions=5)
    for k, t in enumerate(result.time):
        A = Rotation.from_euler("ZYX", [0.3 * t, 0.0, 0.2 * t])
        for n, (foot, head) in enumerate(zip(feet, heads, strict=True)):
            moved = np.array([0.1 * t, 0, 1 + 0.2 * t]) + A.apply(np.subtract(head, [0, 0, 1]))
            length = np.linalg.norm(moved - foot)
            assert result.array(f"leg_{n}.distance")[k] == pytest.approx(length, abs=1e-9)


@pytest.mark.parametrize(
    ("driver", "message"),
    [
        ({"position": ("time", 0, 0), "along": "x"}, "`along` must not be given with `position`"),
        ({"orientation": {"euler": ("time", 0, 0)}}, "`euler` and `sequence` belong together"),
        ({"orientation": {}}, "one of euler, axis, euler_parameters"),
        ({"orientation": {"axis": (0, 0, 0), "angle": "time"}}, "has no direction"),
        ({"orientation": {"euler_parameters": (1, 1, 0, 0)}}, "their length at 0 s is 1.414, not 1"),
        ({"orientation": {"euler_parameters": {"times": [0, 1], "values": [[1, 0], [0, 1]]}}}, "four numbers a row"),
        ({"orientation": {"axis": (0, 0, 1), "angle": "abs(time)"}}, "a driver must be smooth"),
        ({}, "or a whole `position` or `orientation`"),
    ],
)
def test_what_is_wrong_with_a_pose_is_told(driver, message):
    with pytest.raises(nivel.ModelError, match=message):
        nivel.Driver(name="fly", marker="tip", **driver)
