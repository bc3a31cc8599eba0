"""Wheels that roll without slip: steady circles in closed form, a ball on a turntable, the benchmark bicycle, what is refused."""

import csv
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel import ModelError
from simulating import G, machine, simulate, slopes, solid

pytestmark = pytest.mark.covering

EXAMPLES = Path(__file__).parents[3] / "examples"
CASE = Path(__file__).parents[1] / "references" / "bicycle_whipple_linear.csv"


def coin(lean=0.35, turn=2.0, spin=1.0, radius=0.3, rim=0.04, mass=2.0, **more):
    """A coin on the steady circle of O'Reilly (1996) with a rim of Meijaard et al. (2007) added, or with another spin."""
    circle, axial, across = radius - rim, 0.5 * mass * radius**2, 0.25 * mass * radius**2
    s, c = np.sin(lean), np.cos(lean)
    w2 = -turn * c
    wanted = mass * G * circle * s - across * w2**2 * s / c - mass * rim * w2**2 * s / c * (rim + circle * c)
    w3 = spin * wanted / (axial * w2 + mass * w2 * (circle + rim * c) * (circle + rim / c))
    place = [0, 0, circle * c + rim]
    body = solid(
        mass,
        (across, across, axial),
        position=place,
        orientation={"axis": [1, 0, 0], "angle": lean - np.pi / 2},
        velocity=[w2 * rim * s + w3 * (circle + rim * c), 0, 0],
        angular_velocity=[0, w2 * s + w3 * c, -w2 * c + w3 * s],
    )
    rolling = {
        "type": "rolling",
        "bodies": ["ground", "coin"],
        "points": [[0, 0, 0], place],
        "axes": [[0, 0, 1], [0, c, s]],
    }
    return {
        "gravity": [0, 0, -G],
        "bodies": {"coin": body},
        "joints": {"floor": {**rolling, "radius": radius, "rim_radius": rim}},
        **more,
    }


@pytest.mark.parametrize("rim", [0.0, 0.05])
def test_a_leaning_coin_rolls_in_its_steady_circle(rim):
    """Height and normal force stay; the centre goes round at Ω on a circle of radius v/Ω."""
    turn = 2.0
    r = simulate(coin(rim=rim, turn=turn), duration=3, step=1e-3, output_interval=0.1)
    x, y, z = r.array("position")[:, 0].T
    speed = r.array("velocity")[0, 0, 0]
    np.testing.assert_allclose(z, z[0], atol=1e-9)
    np.testing.assert_allclose(x, speed / turn * np.sin(turn * r.time), atol=1e-9)
    np.testing.assert_allclose(y, speed / turn * (1 - np.cos(turn * r.time)), atol=1e-9)
    np.testing.assert_allclose(r.array("joint.floor.normal_force"), 2.0 * G, rtol=1e-9)
    # friction makes the acceleration of the centre: m v Ω towards the middle
    pull = np.hypot(r.array("joint.floor.friction_x"), r.array("joint.floor.friction_y"))
    np.testing.assert_allclose(pull, 2.0 * abs(speed) * turn, rtol=1e-9)
    assert np.abs(r.array("constraint_rate_violation")).max() < 1e-12


METHODS = [
    {"coordinates": "relative"},
    {"coordinates": "independent"},
    {"formulation": "lagrange"},
    {"formulation": "penalty"},
    {"formulation": "augmented-lagrangian"},
    {"stabilisation": "none"},
    {"stabilisation": "baumgarte", "baumgarte": {"alpha": 20, "beta": 20}},
    {"stabilisation": "geometric"},
    {"integrator": "radau", "tolerance": 1e-9},
    {"integrator": "bdf", "tolerance": 1e-10},
    {"integrator": "ros2", "step": 1e-4},
    {"integrator": "generalised-alpha", "step": 2e-4},
]


@pytest.fixture(scope="module")
def swaying():
    return simulate(coin(spin=0.8), duration=0.5, step=5e-4, output_interval=0.1)


@pytest.mark.parametrize("methods", METHODS, ids=lambda methods: str(next(iter(methods.values()))))
def test_a_swaying_coin_moves_the_same_by_every_method(swaying, methods):
    r = simulate(coin(spin=0.8), **{"duration": 0.5, "step": 1e-3, "output_interval": 0.1, **methods})
    np.testing.assert_allclose(r.array("position"), swaying.array("position"), atol=3e-7)
    assert np.abs(r.array("constraint_rate_violation")).max() < 1e-6
    assert r.trust.degrees_of_freedom == 3
    assert "3 degrees of freedom of velocities, 5 of positions" in str(r.trust)


def test_energy_of_a_swaying_coin_is_kept_to_order_four():
    steps = [8e-3, 4e-3, 2e-3]
    errors = [np.abs(simulate(coin(spin=0.7), duration=0.8, step=step).array("energy_error")).max() for step in steps]
    assert np.all(slopes(steps, errors) > 3.6), errors


def test_a_ball_on_a_turntable_goes_round_at_two_sevenths_of_its_rate():
    """The centre moves on a circle at the rate Ω k/(1 + k), k = 2/5, whatever its start (Milne 1948, §251)."""
    rate, radius, mass, x0, v0 = 3.0, 0.1, 1.5, 0.4, 0.3
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {
            "table": solid(5.0, 1.0, angular_velocity=[0, 0, rate]),
            "ball": solid(mass, 0.4 * mass * radius**2, position=[x0, 0, radius], velocity=[v0, 0, 0]),
        },
        "joints": {
            "axle": {"type": "revolute", "bodies": ["ground", "table"], "point": [0, 0, 0], "axis": [0, 0, 1]},
            "roll": {
                "type": "rolling",
                "bodies": ["table", "ball"],
                "points": [[0, 0, 0], [x0, 0, radius]],
                "axes": [[0, 0, 1], [0, 1, 0]],
                "radius": radius,
                "rim_radius": radius,
            },
        },
        "drivers": {"motor": {"coordinate": "axle", "value": f"{rate}*time"}},
    }
    sections["bodies"]["ball"]["angular_velocity"] = [rate * x0 / radius, v0 / radius, 0]  # no slip
    r = simulate(sections, duration=4.0, step=2e-3, output_interval=0.1)
    w = 2.0 / 7.0 * rate
    x, y, z = r.array("ball.position").T
    start = r.array("ball.velocity")[0]
    expected = x0 + (start[0] * np.sin(w * r.time) - start[1] * (1 - np.cos(w * r.time))) / w
    np.testing.assert_allclose(x, expected, atol=1e-8)
    np.testing.assert_allclose(y, (start[1] * np.sin(w * r.time) + start[0] * (1 - np.cos(w * r.time))) / w, atol=1e-8)
    np.testing.assert_allclose(z, radius, atol=1e-12)


# --- the bicycle ---


def bicycle_eigenvalues(speed, **values):
    bicycle = nivel.load(EXAMPLES / "vehicles" / "bicycle.yaml").with_values(
        {"parameters.speed": f"{speed} m/s", **values}
    )
    return bicycle.linearise(inputs=[], outputs=[])


def published():
    """(speed, four eigenvalues) of the benchmark, computed anew from its M, C1, K0, K2 at 21 speeds."""
    with CASE.open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            yield float(row["v"]), np.array([complex(float(row[f"re{k}"]), float(row[f"im{k}"])) for k in range(1, 5)])


def assert_same_eigenvalues(model, expected, atol=1e-8):
    found = model.eigenvalues[~model.structural]
    assert len(found) == len(expected)
    assert int(model.structural.sum()) == 6
    left = list(found)
    for value in expected:
        nearest = min(left, key=lambda each: abs(each - value))
        assert abs(nearest - value) < atol, (value, nearest)
        left.remove(nearest)


@pytest.mark.parametrize("speed", [0.0, 4.0, 8.0])
def test_the_bicycle_has_the_eigenvalues_of_the_benchmark(speed):
    model = bicycle_eigenvalues(speed)
    assert model.steady
    assert len(model.states) == 10
    assert_same_eigenvalues(model, dict(published())[speed])


@pytest.mark.full
def test_the_bicycle_has_the_eigenvalues_of_the_benchmark_at_all_speeds():
    for speed, expected in published():
        assert_same_eigenvalues(bicycle_eigenvalues(speed), expected)


@pytest.mark.full
def test_the_bicycle_has_the_critical_speeds_of_the_benchmark():
    """v_weave and v_capsize of Meijaard et al. (2007), where a real part vanishes."""
    weave = bicycle_eigenvalues(4.29238253634111)
    assert np.abs(weave.eigenvalues[weave.eigenvalues.imag != 0].real).max() < 1e-8
    capsize = np.abs(bicycle_eigenvalues(6.02426201538837).eigenvalues)
    assert int(np.sum(capsize < 1e-8)) == 7


def bicycle(speed, heading=0.0, turned=0.0, reverse=False):
    """The bicycle of the example, its wheels turned already and headed elsewhere; reverse: axles and normals point the other way."""
    record = nivel.load(EXAMPLES / "vehicles" / "bicycle.yaml").with_values({"parameters.speed": f"{speed} m/s"}).record
    c, s = np.cos(heading), np.sin(heading)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    sign = -1.0 if reverse else 1.0
    places = {"rear_wheel": [0, 0, 0.3], "frame": [0.3, 0, 0.9], "fork": [0.9, 0, 0.7], "front_wheel": [1.02, 0, 0.35]}
    bodies, joints = {}, {}
    for body in record.bodies:
        wheel = body.name.endswith("wheel")
        radius = places[body.name][2]
        J = body.inertia
        moments = [J.yy, J.xx, J.zz] if wheel else {"xx": J.xx, "yy": J.yy, "zz": J.zz, "xz": J.xz}
        axes = (
            turn
            if not wheel
            else turn @ np.array([[np.cos(turned), 0, np.sin(turned)], [0, 1, 0], [-np.sin(turned), 0, np.cos(turned)]])
        )
        bodies[body.name] = {
            "mass": body.mass,
            "inertia": moments,
            "position": (turn @ places[body.name]).tolist(),
            "orientation": {"matrix": axes.tolist()},
            "velocity": (turn @ [speed, 0, 0]).tolist(),
            "angular_velocity": (turn @ [0, speed / radius if wheel else 0.0, 0]).tolist(),
        }
    hub = {"type": "revolute", "axis": (sign * turn @ [0, 1, 0]).tolist()}
    joints["rear_hub"] = {**hub, "bodies": ["frame", "rear_wheel"], "point": bodies["rear_wheel"]["position"]}
    joints["front_hub"] = {**hub, "bodies": ["front_wheel", "fork"], "point": bodies["front_wheel"]["position"]}
    tilt = np.radians(18)
    joints["steering"] = {
        "type": "revolute",
        "bodies": ["frame", "fork"],
        "point": (turn @ [1.1, 0, 0]).tolist(),
        "axis": (turn @ [-np.sin(tilt), 0, np.cos(tilt)]).tolist(),
    }
    for wheel in ("rear_wheel", "front_wheel"):
        joints[f"{wheel}_tyre"] = {
            "type": "rolling",
            "bodies": ["ground", wheel],
            "points": [[5, 7, 0], bodies[wheel]["position"]],
            "axes": [[0, 0, 1], (sign * turn @ [0, 1, 0]).tolist()],
            "radius": places[wheel][2],
        }
    return machine({"gravity": [0, 0, -9.81], "bodies": bodies, "joints": joints})


@pytest.mark.parametrize(("heading", "turned", "reverse"), [(0.9, 2.2, False), (-2.0, 0.6, True)])
def test_phases_and_signs_of_the_wheels_do_not_change_the_eigenvalues(heading, turned, reverse):
    model = bicycle(4.0, heading, turned, reverse).linearise(inputs=[], outputs=[])
    assert model.steady
    assert_same_eigenvalues(model, dict(published())[4.0])


def test_a_rolling_bicycle_sways_back_as_its_linear_equations_say():
    """A small rate of roll at 4.6 m/s: the lean of a run and of the matrix exponential differ by the second order of its size."""
    from scipy.linalg import expm

    size, t = 1e-4, 0.6
    values = {"parameters.speed": "4.6 m/s", "parameters.roll": f"{size} rad/s"}
    r = (
        nivel.load(EXAMPLES / "vehicles" / "bicycle.yaml")
        .with_values(values)
        .simulate(duration=t, step="2 ms", output_interval=t)
    )
    model = bicycle_eigenvalues(4.6)
    x = np.zeros(len(model.states))
    x[model.states.index("frame.turn_x.rate")] = size
    # roll moves no other independent rate: the frame's own y follows by no slip
    state = expm(model.A * t) @ x
    assert r.array("steering.angle")[-1] == pytest.approx(state[model.states.index("steering.angle")], abs=30 * size**2)


# --- what a user is told ---


def test_freedoms_of_positions_and_of_velocities_are_counted_apart():
    check = nivel.load(EXAMPLES / "vehicles" / "bicycle.yaml").check()
    assert (check.degrees_of_freedom, check.position_freedoms) == (3, 7)
    assert "3 degrees of freedom, 7 of positions" in str(check)


def test_a_wheel_that_would_have_to_be_pulled_down_is_told():
    """A force lifts the coin with more than its weight from 0.5 s on."""
    sections = coin(
        lean=0.0, turn=0.0001, forces={"up": {"type": "force", "body": "coin", "vector": [0, 0, "60*time"]}}
    )
    sections["joints"]["floor"]["radius"] = 0.3
    r = simulate(sections, duration=0.5, step=1e-3)
    item = next(item for item in r.trust.items if item.name == "rolling")
    assert item.verdict == "amber"
    assert "lifts off, from t = 0.328 s" in item.text


@pytest.mark.parametrize(
    "settings",
    [
        {"integrator": "generalised-alpha", "stabilisation": "none"},
        {"integrator": "energy-momentum"},
    ],
)
def test_methods_that_close_positions_alone_are_refused(settings):
    with pytest.raises(ModelError, match="without slip constrains velocities"):
        simulate(coin(), duration=0.1, **settings)


def test_kinematics_and_inverse_dynamics_are_refused():
    with pytest.raises(ModelError, match="the position of a wheel depends on its path"):
        machine(coin()).kinematics(drive="floor.x", end=1.0)
    with pytest.raises(ModelError, match="drive the wheels with `nivel run`"):
        machine(coin()).inverse(actuators="floor.x")


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"rim_radius": 0.5}, "`rim_radius` is 0.5 m, more than the `radius`"),
        ({"rim_radius": -0.1}, "less than zero"),
        ({"radius": None}, "`radius` is missing: a rolling joint needs one"),
        ({"axes": [[0, 0, 1], [0, 0, -1]]}, "the wheel lies flat"),
        ({"axis": [0, 0, 1]}, "a rolling joint has no `axis`; write `axes`"),
    ],
)
def test_faults_of_a_wheel_are_named(changes, said):
    sections = coin()
    floor = {**sections["joints"]["floor"], **changes}
    sections["joints"]["floor"] = {key: value for key, value in floor.items() if value is not None}
    with pytest.raises(ModelError, match=said):
        machine(sections)


def test_an_unbalanced_ball_rests_with_its_centre_of_mass_lowest():
    """Statics rolls it there: the contact moves by radius times the turn."""
    radius, off, turned = 0.1, 0.02, 1.0
    body = solid(1.0, 0.004, position=[0, 0, radius], centre_of_mass=[off * np.sin(turned), 0, -off * np.cos(turned)])
    rolling = {
        "type": "rolling",
        "bodies": ["ground", "ball"],
        "points": [[0, 0, 0], [0, 0, radius]],
        "axes": [[0, 0, 1], [0, 1, 0]],
    }
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"ball": body},
        "joints": {
            "floor": {**rolling, "radius": radius, "rim_radius": radius},
            "no_spin": {
                "type": "generic",
                "bodies": ["ground", "ball"],
                "point": [0, 0, 0],
                "axis": [0, 0, 1],
                "locked": ["rz"],
            },
        },
    }
    r = machine(sections).statics()
    x, y, z = r.array("ball.position")[-1]
    np.testing.assert_allclose([x, y, z], [radius * turned, 0, radius], atol=1e-9)
    np.testing.assert_allclose(r.array("joint.floor.normal_force")[-1], G, rtol=1e-9)
