"""A loader crane: how its load stands and vibrates on closed valves, and its cycle at a step for real time."""

import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import nivel
from circuits import BAR, density, history
from simulating import machine

FILE = Path(__file__).parents[2] / "examples" / "hydraulics" / "loader-crane.yaml"


def boom_on_closed_valves(**more):
    """Boom, jib, extension and load as one body, on the lift cylinder between two closed orifices, with 6 bar on the rod side."""
    parts = [
        (150.0, 1.23, 0.05, 67.0),
        (160.0, 2.88 + 0.42, 0.10, 90.0),
        (60.0, 2.88 + 1.32, 0.10, 20.0),
        (250.0, 2.88 + 2.12, -0.30, 0.0),
    ]
    mass = sum(part[0] for part in parts)
    x = sum(part[0] * part[1] for part in parts) / mass
    y = sum(part[0] * part[2] for part in parts) / mass
    about_hinge = sum(part[3] + part[0] * (part[1] ** 2 + part[2] ** 2) for part in parts)
    inertia = about_hinge - mass * (x * x + y * y)
    closed = {"type": "orifice", "diameter": "5 mm", "opening": 0}
    sections = {
        "gravity": [0, -9.81, 0],
        "bodies": {
            "boom": {
                "position": [-0.09, 1.426, 0],
                "mass": mass,
                "centre_of_mass": [x, y, 0],
                "inertia": [inertia, inertia, inertia],
                **more,
            }
        },
        "joints": {
            "hinge": {"type": "revolute", "bodies": ["ground", "boom"], "point": [-0.09, 1.426, 0], "axis": [0, 0, 1]}
        },
        "hydraulics": {
            "tank": {"type": "tank"},
            "a": {**closed, "ports": {"A": "lift.A", "B": "tank"}},
            "b": {**closed, "ports": {"A": "lift.B", "B": "tank"}},
            "lift": {
                "type": "cylinder",
                "bodies": ["ground", "boom"],
                "points": [[0.170, 0.386, 0], [0.214, 1.326, 0]],
                "piston": "100 mm",
                "rod": "56 mm",
                "stroke": 0.55,
                "retracted_length": 0.82,
                "dead_volume_A": "0.1 L",
                "dead_volume_B": "0.3 L",
                "start_B": "6 bar",
            },
        },
    }
    return machine(sections), about_hinge


def test_the_load_is_carried_by_the_pressure_of_its_moment():
    """21 724 N m over a lever of 0.3083 m is 70.45 kN: 94.14 bar in A beside 6 bar in B."""
    built, _ = boom_on_closed_valves()
    result = built.simulate(duration=0.01, step=1e-3)
    assert history(result, "hydraulics.lift.pressure_A")[0] == pytest.approx(94.14 * BAR, rel=1e-4)
    assert history(result, "hydraulics.lift.pressure_B")[0] == pytest.approx(6 * BAR, rel=1e-9)
    assert history(result, "hydraulics.lift.force")[0] == pytest.approx(70.45e3, rel=2e-4)


def test_a_boom_on_closed_valves_vibrates_at_its_closed_form():
    """√(k r²/J) with k = 91.37 + 4.75 MN/m, r = 0.3083 m: 31.05 rad/s; the gravity of the load takes 0.03 % of it."""
    built, inertia = boom_on_closed_valves(angular_velocity=[0, 0, 1e-5])
    k, r = 96.12e6, 0.3083
    expected = math.sqrt(k * r * r / inertia)
    assert expected == pytest.approx(31.05, rel=1e-3)
    result = built.simulate(integrator="radau", tolerance=1e-9, duration=1.1, output_interval=1e-4)
    w = np.asarray(result.array("angular_velocity"))[:, 0, 2]
    t = np.asarray(result.time)
    k = np.flatnonzero((w[:-1] < 0) & (w[1:] >= 0))
    zeros = t[k] - w[k] * (t[k + 1] - t[k]) / (w[k + 1] - w[k])
    assert 2 * math.pi / np.mean(np.diff(zeros)) == pytest.approx(31.05, rel=1e-3)


@cache
def cycle(**settings):
    return nivel.load(FILE).simulate(output_interval=4e-3, **dict(settings))


def test_a_loaded_crane_stands_still_without_chatter():
    result = nivel.load(FILE).simulate(duration=0.19, step=1e-3)  # before the first command
    assert np.max(np.abs(result.array("joint_rate"))) < 1e-6
    for name in result.variables:
        if name.startswith("hydraulics.") and ".pressure" in name:
            assert np.ptp(history(result, name)) < 1e4, name


def test_a_loaded_crane_with_closed_valves_drifts_by_the_leakage_only():
    """ṡ = G (p_A - p_line)/A through the counterbalance valve, the oil at the density of chamber A; no pressure chatters at 1 ms."""
    leakage = 1e-12
    changes = {"hydraulics.lift_hold.leakage": leakage, "hydraulics.lift_valve.command": 0}
    result = nivel.load(FILE, changes).simulate(duration=1.0, step=1e-3, output_interval=1e-3)
    high, low = (history(result, f"hydraulics.{name}") for name in ("lift.pressure_A", "lift_line.pressure"))
    position, area = history(result, "hydraulics.lift.position"), 0.25 * math.pi * 0.1**2
    rate = -leakage * (high - low) * 0.5 * (density(high) + density(low)) / density(high) / area
    # beside the vibration of the load, which begins to sink at once
    assert position[-1] - position[0] == pytest.approx(float(np.mean(rate)), rel=5e-3)
    assert np.max(np.abs(result.array("joint_rate")[:, 0])) < 1e-12
    for name in result.variables:
        if name.startswith("hydraulics.") and ".pressure" in name:
            pressure = history(result, name)
            # a vibration of 31 rad/s turns by 1e-3 of itself in a step; what goes to and fro would do so by twice itself
            assert np.max(np.abs(np.diff(pressure, 2)[20:])) < 0.01 * np.ptp(pressure) + 1e2, name


def test_the_cycle_at_one_millisecond_is_that_of_radau():
    fine, real_time = cycle(integrator="radau", tolerance=1e-6), cycle(step=1e-3)
    assert real_time.trust.outcome == "done"
    assert np.max(np.abs(fine.array("joint_coordinate") - real_time.array("joint_coordinate"))) < 2e-4
    items = {item.name: item for item in real_time.trust.items}
    assert items["pressure steps"].verdict == "green"
    worst = 0.0
    for name in fine.variables:
        if name.startswith("hydraulics.") and ".pressure" in name:
            worst = max(worst, float(np.sqrt(np.mean((history(fine, name) - history(real_time, name)) ** 2))))
    assert worst < 1 * BAR


def test_the_crane_lifts_and_lowers():
    angle = cycle(integrator="radau", tolerance=1e-6).array("joint_coordinate")[:, 1]
    assert 0.12 < angle[400] < 0.2
    assert -0.1 < angle[-1] < 0.0
