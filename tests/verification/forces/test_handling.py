"""Driver and manoeuvres against the linear single track, closed forms of second order, and geometry."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from nivel.cli import main
from nivel.cli.vehicles import drive
from nivel.errors import ModelError
from nivel.report.vehicle_pages import Manoeuvre, braking_numbers, lane_numbers, slope_numbers, step_numbers
from simulating import machine
from test_tyres import ACROSS, TYRE, C, P, R, W, curve

SIDE, FRONT, REAR, YAW, WHEELBASE = 800.0, 1.2, -1.5, 1000.0, 2.7  # kg, m, m, kg m², m
RACK = 4e4  # N m/rad
CAR = Path(__file__).parents[3] / "examples" / "vehicles" / "lane-change.yaml"


def single_track(speed, driver, **simulation):
    """A body in the plane on two wheels under P, of which a motor turns the front one as the driver says."""
    sag = P / C
    r, at = R - (1 - 0.375) * sag, R - sag
    bodies = {"body": {"mass": SIDE, "inertia": [1500.0, 1500.0, YAW], "position": [0, 0, at], "velocity": [speed, 0, 0]},
              "knuckle": {"mass": 1e-3, "inertia": [0.01] * 3, "position": [FRONT, 0, at], "velocity": [speed, 0, 0]}}  # fmt: skip
    joints = {"plane": {"type": "planar", "bodies": ["ground", "body"], "point": [0, 0, at], "axis": [0, 0, 1]},
              "king": {"type": "revolute", "bodies": ["body", "knuckle"], "point": [FRONT, 0, at], "axis": [0, 0, 1]}}  # fmt: skip
    markers = {"road": {"body": "ground"}, "nose": {"body": "body"}, "tail": {"body": "body", "position": [REAR, 0, 0]}}
    rack = f"{RACK}*(driver - king.angle) - 100*king.angle_rate"
    forces: dict[str, dict[str, object]] = {
        "rack": {"type": "motor", "coordinate": "king", "effort": rack},
        "drive": {"type": "motor", "coordinate": "rear", "effort": "1000*(driver.throttle - driver.brake)"},
    }
    for name, x, on in (("front", FRONT, "knuckle"), ("rear", REAR, "body")):
        bodies[f"{name}_wheel"] = {"mass": 1e-3, "inertia": [1.0] * 3, "position": [x, 0.0, at], "velocity": [speed, 0, 0],
                                   "angular_velocity": [0, speed / r, 0]}  # fmt: skip
        joints[name] = {"type": "revolute", "bodies": [on, f"{name}_wheel"], "point": [x, 0.0, at], "axis": [0, 1, 0]}
        markers[f"{name}_axle"] = {"body": f"{name}_wheel", "axis": [0, 1, 0]}
        forces[name] = {**TYRE, "wheel": f"{name}_axle", "rolling_resistance": 0.0}
    own = {
        "type": "vehicle-driver",
        "target": speed,
        "speed": "body.vx*cos(yaw.angle) + body.vy*sin(yaw.angle)",
        **driver,
    }
    if "course" in driver:
        own = {"x": "tail.x", "y": "tail.y", "heading": "yaw.angle", "wheelbase": WHEELBASE, **own}
    return machine({"bodies": bodies, "joints": joints, "markers": markers, "forces": forces, "control": {"driver": own},
                    "sensors": {"yaw": {"angle": ["road", "nose"]}}, "simulation": {"step": 1e-3, **simulation}})  # fmt: skip


def understeer():
    """[rad s²/m] of the linear single track: F = -K s/v across at the trail n behind each axle, and of the bore at the lever (L + b)/6."""
    length = 2.0 * math.sqrt(R * P / C)
    trail, lever, slope, v = 0.178 * length, (length + W) / 6.0, curve(ACROSS)[0], 20.0
    # unknown v_y and the steering angle for a yaw rate of 1 rad/s
    A, b = np.zeros((2, 2)), np.array([SIDE * v, 0.0])
    for x, steered in ((FRONT, 1.0), (REAR, 0.0)):
        across = -slope / v * np.array([1.0, -steered * v, x - trail])  # by v_y, angle, yaw rate
        A += np.outer([1.0, x - trail], across[:2])
        b -= np.array([1.0, x - trail]) * across[2]
        b[1] += slope / v * lever**2
    drift, angle = np.linalg.solve(A, b)
    # the rack gives way under the moment of the front wheel
    force = -slope / v * (drift + FRONT - trail - angle * v)
    given = (trail * force + slope / v * lever**2) / RACK
    return (angle + given) / v - WHEELBASE / v**2


def test_small_turns_have_the_understeer_gradient_of_the_linear_single_track():
    course = [[k * 10.0, 0.0] for k in range(4)]
    made = single_track(20.0, {"course": course}, duration=1.0, output_interval=0.05)
    _, numbers, _ = drive(made, "circle", verify=False)
    found = math.radians(numbers["understeer gradient"][0]) / 9.80665
    assert found == pytest.approx(understeer(), rel=2e-3)


@pytest.mark.parametrize("sampled", [{}, {"sample_time": 0.01}])
def test_a_slow_vehicle_follows_a_circle_at_the_angle_of_its_radius(sampled):
    """Its rear axle, without slip, goes along the circle through where it is and what it sees: the course itself."""
    radius = 30.0
    turns = np.linspace(0.0, 1.2, 40)
    course = [[REAR + radius * math.sin(t), radius * (1.0 - math.cos(t))] for t in turns]
    made = single_track(3.0, {"course": course, "preview": 1.0, **sampled}, duration=8.0, output_interval=0.1)
    run = made.simulate(verify=False)
    assert abs(run.array("control.driver.deviation")[-1]) < 0.02
    assert run.array("control.driver")[-1] == pytest.approx(
        WHEELBASE / radius + understeer() * 3.0**2 / radius, rel=0.01
    )
    assert run.array("control.driver.station")[-1] == pytest.approx(24.0, rel=0.01)
    assert np.hypot(*run.array("velocity")[-1, 0, :2]) == pytest.approx(3.0, rel=0.02)


def history(**given):
    t = given["time"]
    return Manoeuvre("test", **{name: given.get(name, np.zeros_like(t)) for name in
                                ("time", "steering", "vx", "vy", "ax", "ay", "yaw", "yaw_rate", "roll", "x", "y")})  # fmt: skip


def test_a_step_response_of_second_order_has_its_overshoot_and_times():
    """Peak at π/(ω √(1 - ζ²)), overshoot e^(-π ζ/√(1 - ζ²)); steering is a ramp of 1 ms."""
    zeta, omega = 0.4, 6.0
    t = np.linspace(0.0, 6.0, 6001)
    root = math.sqrt(1.0 - zeta**2)
    s = np.maximum(t - 1.0, 0.0)
    r = 1.0 - np.exp(-zeta * omega * s) * (np.cos(omega * root * s) + zeta / root * np.sin(omega * root * s))
    steering = np.clip((t - 0.9995) / 1e-3, 0.0, 1.0) * 0.02
    found = step_numbers(history(time=t, steering=steering, yaw_rate=0.1 * r))
    assert found["overshoot of the yaw rate"][0] == pytest.approx(100 * math.exp(-math.pi * zeta / root), rel=1e-3)
    assert found["peak response time"][0] == pytest.approx(math.pi / (omega * root), abs=2e-3)
    assert found["yaw rate gain"][0] == pytest.approx(5.0, rel=1e-3)
    assert np.interp(1.0 + found["response time of the yaw rate"][0], t, r) == pytest.approx(0.9, abs=1e-3)


def test_braking_lane_and_slope_are_measured_as_they_were_made():
    t = np.linspace(0.0, 6.0, 6001)
    v = np.where(t < 1.0, 20.0, np.maximum(20.0 - 5.0 * (t - 1.0), 0.0))
    x = np.concatenate([[0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(t))])
    found = braking_numbers(history(time=t, vx=v, x=x), 1.0)
    assert found["mean deceleration"][0] == pytest.approx(5.0, rel=1e-3)
    assert found["way"][0] == pytest.approx(20.0**2 / (2 * 5.0), rel=1e-3)
    gates = [(10.0, 20.0, -1.0, 1.0), (40.0, 50.0, 0.0, 3.0)]
    lane = history(time=t, vx=v, x=x, y=np.where(x > 30.0, 1.2, 0.1))
    assert lane_numbers(lane, gates, 1.6)["room left in the gates"][0] == pytest.approx(0.1)
    assert lane_numbers(lane, gates, 2.6)["beyond the gates"][0] == pytest.approx(0.4)
    back = history(time=t, vx=np.ones_like(t), x=np.where(t < 1.0, -0.3 * t, -0.3 + 2.0 * (t - 1.0)))
    assert slope_numbers(back)["rolls back"][0] == pytest.approx(0.3, rel=1e-3)
    assert slope_numbers(back)["time to 5 m"][0] == pytest.approx(1.0 + 5.3 / 2.0, abs=2e-3)


def test_the_command_drives_the_example_and_writes_a_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = CliRunner().invoke(
        main, ["handling", str(CAR), "--only", "slope,split-grip", "--no-verify", "--json", "--quiet"]
    )
    assert told.exit_code == 0, told.output
    found = json.loads(told.stdout)
    assert found["slope"]["rolls back"] < 0.05
    assert found["slope"]["trust"] == "green, not verified"
    assert found["split-grip"]["mean deceleration"] > 2.0
    page = (tmp_path / "lane-change-handling.html").read_text()
    assert "g-g diagram" in page
    assert "rolls back [m]" in page


@pytest.mark.parametrize(
    ("driver", "said"),
    [
        ({}, "a driver needs a `course`"),
        ({"course": [[0, 0], [1, 0]]}, "3 or more points"),
        ({"course": [[0, 0], [0, 0], [1, 0]]}, "the same"),
        ({"course": [[0, 0], [1, 0], [2, 0]], "heading": "yaw.angel"}, "did you mean `yaw.angle`"),
        ({"steering": 0.1, "x": "body.x"}, "`x` belongs to a `course`"),
    ],
)
def test_what_is_missing_of_a_driver_is_said(driver, said):
    with pytest.raises(ModelError) as error:
        single_track(3.0, driver)
    assert said in str(error.value)
