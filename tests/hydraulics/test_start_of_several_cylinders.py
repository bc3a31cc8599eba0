"""Start pressures of several cylinders on one load, of which some chambers are given: Σ p A of each is what statics asks for."""

import math
from pathlib import Path

import numpy as np
import pytest

import nivel
from circuits import BAR
from simulating import machine

FAULTS = Path(__file__).parents[1] / "faults"
AIR, TANK, WEIGHT = 101325.0, 2 * BAR, 800 * 9.81


def areas(piston, rod):
    """Of the sides A and B [m²]."""
    whole = math.pi / 4 * piston**2
    return whole, whole - math.pi / 4 * rod**2


def beam(cylinders, *, offset=0.0, joint="planar", force=(0.0, -9.81)):
    """A beam of 800 kg on vertical cylinders at x = where; its centre of mass at x = offset. cylinders : (where, piston, rod, given)."""
    parts = {
        "T": {"type": "tank", "pressure": TANK},
        "line": {"type": "volume", "volume": 1e-3},
        "filter": {"type": "orifice", "ports": {"A": "line", "B": "T"}, "flow": 1e-3, "pressure_drop": BAR},
    }
    for k, (where, piston, rod, given) in enumerate(cylinders):
        parts[f"c{k}"] = {
            "type": "cylinder", "bodies": ["ground", "beam"], "points": [[where, 0, 0], [where, 1, 0]], "piston": piston, "rod": rod,
            "stroke": 0.8, "retracted_length": 0.9, **given,
        }  # fmt: skip
    joints = {"plane": {"type": joint, "bodies": ["ground", "beam"], "point": [0, 1, 0], "axis": [0, 0, 1]}}
    if joint == "translational":
        joints["plane"]["axis"] = [0, 1, 0]
    return machine(
        {
            "gravity": [*force, 0.0],
            "bodies": {"beam": {"position": [offset, 1, 0], "mass": 800, "inertia": [300, 300, 600]}},
            "joints": joints,
            "hydraulics": parts,
            "simulation": {"duration": 0.05, "step": 1e-3},
        }
    )


def pushes(loaded, cylinders):
    """Forces of the cylinders at the start, upwards, and their pressures."""
    pressures = loaded.check().pressures
    out = []
    for k, (_, piston, rod, _) in enumerate(cylinders):
        A, B = areas(piston, rod)
        out.append(
            (pressures[f"hydraulics.c{k}.pressure_A"] - AIR) * A - (pressures[f"hydraulics.c{k}.pressure_B"] - AIR) * B
        )
    return out, pressures


BOTH_B = {"start_B": TANK}
EQUAL = ((-1.0, 0.05, 0.03), (1.0, 0.05, 0.03))
UNEQUAL = ((-1.0, 0.05, 0.03), (0.5, 0.08, 0.04))
CASES = {
    "equal, both rods given": (EQUAL, (BOTH_B, BOTH_B)),
    "equal, one rod given": (EQUAL, (BOTH_B, {})),
    "equal, one rod under pressure": (EQUAL, ({"start_B": 60 * BAR}, {})),
    "equal, one bottom given": (EQUAL, ({"start_A": 50 * BAR}, {})),
    "equal, both bottoms given": (EQUAL, ({"start_A": 50 * BAR}, {"start_A": 30 * BAR})),
    "equal, bottom and rod given": (EQUAL, ({"start_A": 50 * BAR}, {"start_B": 10 * BAR})),
    "unequal, none given": (UNEQUAL, ({}, {})),
    "unequal, both rods given": (UNEQUAL, ({"start_B": 5 * BAR}, {"start_B": 20 * BAR})),
    "unequal, bottom and rod given": (UNEQUAL, ({"start_A": 80 * BAR}, {"start_B": 20 * BAR})),
}


@pytest.mark.parametrize("case", CASES)
def test_two_cylinders_hold_what_statics_asks_for(case):
    sizes, given = CASES[case]
    cylinders = [(*size, own) for size, own in zip(sizes, given, strict=True)]
    (left, right), pressures = pushes(loaded := beam(cylinders), cylinders)
    (x, *_), (z, *_) = sizes
    assert left == pytest.approx(WEIGHT * z / (z - x), rel=1e-7)
    assert right == pytest.approx(WEIGHT * -x / (z - x), rel=1e-7)
    for k, own in enumerate(given):
        for key, value in own.items():
            assert pressures[f"hydraulics.c{k}.pressure_{key[-1]}"] == pytest.approx(value, rel=1e-9)
    result = loaded.simulate(verify=False)
    assert np.max(np.abs(np.asarray(result.array("joint_rate")))) < 1e-6


def test_two_equal_cylinders_with_given_rods_have_equal_bottoms():
    """Each holds 3924 N: p_A = air + (3924 N + 0.98675 bar · B)/A = 21.63 bar."""
    A, B = areas(0.05, 0.03)
    right = AIR + (WEIGHT / 2 + (TANK - AIR) * B) / A
    assert right == pytest.approx(21.63 * BAR, rel=1e-3)
    loaded = nivel.load(FAULTS / "start2.yaml")
    pressures = loaded.check().pressures
    assert [pressures[f"hydraulics.{name}.pressure_A"] for name in ("c1", "c2")] == pytest.approx(
        [right, right], rel=1e-9
    )
    assert np.max(np.abs(np.asarray(loaded.simulate(verify=False).array("joint_rate")))) < 1e-6


def test_two_cylinders_on_common_lines_hold_a_weight_together():
    """One pressure in both bottoms: it acts on the sum of their areas."""
    lines = {"line": {"type": "volume", "volume": 1e-3}, "back": {"type": "volume", "volume": 1e-3}}
    places = [(-1.0, 0.05, 0.03), (1.0, 0.08, 0.04)]
    parts = {
        f"c{k}": {
            "type": "cylinder", "ports": {"A": "line", "B": "back"}, "bodies": ["ground", "load"], "points": [[x, 0, 0], [x, 1, 0]],
            "piston": piston, "rod": rod, "stroke": 0.8, "retracted_length": 0.9,
        }
        for k, (x, piston, rod) in enumerate(places)
    }  # fmt: skip
    loaded = machine(
        {
            "gravity": [0, -9.81, 0],
            "bodies": {"load": {"mass": 800, "inertia": [1, 1, 1], "position": [0, 1, 0]}},
            "joints": {
                "rail": {"type": "translational", "bodies": ["ground", "load"], "point": [0, 1, 0], "axis": [0, 1, 0]}
            },
            "hydraulics": {**lines, **parts},
        }
    )
    right = AIR + WEIGHT / sum(areas(piston, rod)[0] for _, piston, rod in places)
    pressures = loaded.check().pressures
    assert pressures["hydraulics.line.pressure"] == pytest.approx(right, rel=1e-9)
    assert pressures["hydraulics.back.pressure"] == pytest.approx(AIR, rel=1e-9)


@pytest.mark.parametrize("given", [{}, {"start_B": 2 * BAR}, {"start_B": 30 * BAR}, {"start_A": 40 * BAR}])
def test_three_cylinders_together_hold_the_weight_about_its_middle(given):
    sizes = [(-1.0, 0.05, 0.03), (0.2, 0.06, 0.03), (1.0, 0.08, 0.04)]
    cylinders = [(*size, own) for size, own in zip(sizes, (given, {}, given), strict=True)]
    found, _ = pushes(beam(cylinders), cylinders)
    assert sum(found) == pytest.approx(WEIGHT, rel=1e-7)
    assert sum(push * x for push, (x, *_) in zip(found, sizes, strict=True)) == pytest.approx(0.0, abs=1e-6 * WEIGHT)


def test_a_third_cylinder_takes_what_two_given_ones_leave():
    sizes = [(0.0, 0.05, 0.03), (0.0, 0.06, 0.03), (0.0, 0.08, 0.04)]
    both = [{"start_A": 10 * BAR, "start_B": 2 * BAR}, {"start_A": 5 * BAR, "start_B": 3 * BAR}, {"start_B": 4 * BAR}]
    cylinders = [(*size, own) for size, own in zip(sizes, both, strict=True)]
    found, _ = pushes(beam(cylinders, joint="translational"), cylinders)
    assert sum(found) == pytest.approx(WEIGHT, rel=1e-7)


def test_a_load_that_pulls_is_held_by_the_rods():
    """Gravity upwards: rods hold it where bottoms are given, and the given ones stay."""
    cylinders = [(*size, {"start_A": 3 * BAR}) for size in EQUAL]
    found, pressures = pushes(beam(cylinders, force=(0.0, 9.81)), cylinders)
    assert found == pytest.approx([-WEIGHT / 2, -WEIGHT / 2], rel=1e-7)
    assert pressures["hydraulics.c0.pressure_A"] == pytest.approx(3 * BAR, rel=1e-9)


@pytest.mark.parametrize("torque", [0.0, 900.0, -900.0])
def test_a_charged_closed_loop_starts_at_its_charge_pressure_and_its_load_on_top(torque):
    """p_high - p_low = M/(D i), and nothing flows into the low side but what leaves it, so that its pressure stays for a while; from the
    pressure of the tank the charge pump would raise it by 0.8 bar in 0.1 ms."""
    ratio, displacement, speed = 14.0, 75e-6 / (2 * math.pi), 2000 * 2 * math.pi / 60
    check = {"type": "check-valve", "flow": 80e-3 / 60, "pressure_drop": 3 * BAR}
    loop = machine(
        {
            "bodies": {"wheel": {"mass": 100, "inertia": [20, 20, 20]}},
            "joints": {"axle": {"type": "revolute", "bodies": ["ground", "wheel"], "point": [0, 0, 0], "axis": [0, 0, 1]}},
            "forces": {"load": {"type": "torque", "body": "wheel", "vector": [0, 0, torque]}},
            "hydraulics": {
                "T": {"type": "tank", "pressure": TANK},
                **{name: {"type": "volume", "volume": 0.8e-3} for name in ("a", "b", "feed")},
                "charge": {"type": "pump", "ports": {"A": "T", "B": "feed"}, "speed": speed, "displacement": 18e-6 / (2 * math.pi)},
                "relief": {"type": "relief-valve", "ports": {"P": "feed", "T": "T"}, "opens_at": 24 * BAR, "opening_range": 6 * BAR,
                           "flow": 1e-3, "pressure_drop": 30 * BAR},
                "to_a": {**check, "ports": {"A": "feed", "B": "a"}},
                "to_b": {**check, "ports": {"A": "feed", "B": "b"}},
                "motor": {"type": "hydraulic-motor", "ports": {"A": "a", "B": "b", "L": "T"}, "displacement": displacement,
                          "coordinate": "axle.angle", "ratio": ratio, "case_leakage": 2e-12},
            },
        }
    )  # fmt: skip
    result = loop.simulate(integrator="radau", tolerance=1e-8, duration=1e-4, output_interval=1e-4, verify=False)
    a, b, feed = (result.array(f"hydraulics.{name}.pressure") for name in ("a", "b", "feed"))
    low = np.minimum(a, b)
    assert a[0] - b[0] == pytest.approx(-torque / (displacement * ratio), abs=1.0)
    assert 24 * BAR < low[0] < feed[0] < 30 * BAR
    assert abs(low[-1] - low[0]) < 1e-3 * BAR
    assert abs(feed[-1] - feed[0]) < 1e-3 * BAR
