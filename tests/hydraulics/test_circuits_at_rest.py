"""Equilibria of machines whose fluid is shut in: motors on closed lines, loads behind closed valves."""

import math
from pathlib import Path

import numpy as np
import pytest

import nivel
from circuits import BAR, density, history
from simulating import hinge, machine

FILE = Path(__file__).parents[2] / "examples" / "hydraulics" / "loader-crane.yaml"
GEAR, DISPLACEMENT, ROOM = 30.0, 160e-6 / (2.0 * math.pi), 0.3e-3
FLEXIBLE = {"include": "booms/flexible.yaml", "simulation.start": "equilibrium"}


def leaning_column(angle):
    """A mast on a motor between two closed volumes at 50 bar, whose axis leans by an angle."""
    return machine(
        {
            "gravity": [0, -9.81 * math.sin(angle), -9.81 * math.cos(angle)],
            "bodies": {"column": {"mass": 300, "position": [2, 0, 0], "inertia": [80, 80, 40]}},
            "joints": {"slewing": hinge("ground", "column")},
            "hydraulics": {
                "a": {"type": "volume", "volume": ROOM, "start": 50 * BAR},
                "b": {"type": "volume", "volume": ROOM, "start": 50 * BAR},
                "motor": {
                    "type": "hydraulic-motor", "ports": {"A": "a", "B": "b"}, "displacement": DISPLACEMENT,
                    "coordinate": "slewing.angle", "ratio": GEAR,
                },
            },
        }
    )  # fmt: skip


def test_a_motor_on_closed_lines_is_a_spring():
    """It turns by θ until D i (p_A - p_B) is the load; ρ D i θ of fluid leaves one side and comes into the other."""
    rest = leaning_column(0.02).statics()
    assert rest.outcome == "done"
    angle = float(np.ravel(rest.array("joint_coordinate"))[-1])
    load = 300 * 9.81 * math.sin(0.02) * 2.0 * math.cos(angle)
    a, b = (float(history(rest, f"hydraulics.{name}.pressure")[-1]) for name in "ab")
    assert DISPLACEMENT * GEAR * (a - b) == pytest.approx(load, rel=1e-6)
    full, begin = density(50 * BAR), ROOM * density(50 * BAR)
    assert ROOM * (density(a) + density(b)) == pytest.approx(2.0 * begin, rel=1e-12)
    assert begin - ROOM * density(a) == pytest.approx(DISPLACEMENT * GEAR * angle * full, rel=1e-2)
    assert {item.name: item for item in rest.trust.items}["stability"].verdict == "green"


@pytest.mark.parametrize("include", ["booms/rigid.yaml", "booms/flexible.yaml"])
def test_a_crane_rests_on_what_its_valves_shut_in(include):
    rest = nivel.load(FILE, {"include": include}).statics()
    assert rest.outcome == "done"
    angles = np.asarray(rest.array("joint_coordinate"))[-1]
    assert np.max(np.abs(angles)) < 1e-3  # the pressures of the start carry the load; a boom sags
    assert rest.trust.verdict == "green"


def test_a_flexible_crane_from_equilibrium_stands_still():
    result = nivel.load(FILE, FLEXIBLE).simulate(duration=0.19, step=1e-3)  # before the first command
    assert np.max(np.abs(result.array("joint_rate"))) < 1e-9
    for name in result.variables:
        if name.startswith("hydraulics.") and ".pressure" in name:
            assert np.ptp(history(result, name)) < 1e3, name
