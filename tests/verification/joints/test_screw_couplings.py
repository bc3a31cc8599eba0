"""Friction on a rail beside a screw joint: the refusal writes the coupling in place of the joint, whose motion has a closed form."""

import math
import re

import pytest
import yaml

from nivel.errors import ModelError
from simulating import G, simulate, solid

PITCH, MASS, INERTIA, MU, TORQUE = 0.01, 20.0, 0.001, 0.1, 0.2


def feed(bearing=(1, 0, 0), rail=(1, 0, 0), nut=("spindle", "table"), turned=False, **more):
    """A table on its rail, fed by a spindle in its bearing; its joints in any direction and order."""
    bodies = ["table", "ground"] if turned else ["ground", "table"]
    joints = {
        "bearing": {"type": "revolute", "bodies": ["ground", "spindle"], "point": [0, 0, 0], "axis": list(bearing)},
        "rail": {"type": "translational", "bodies": bodies, "point": [0.2, 0, 0], "axis": list(rail)},
        "nut": {"type": "screw", "bodies": list(nut), "point": [0.2, 0, 0], "axis": [1, 0, 0], "pitch": PITCH},
    }
    forces = {
        "rub": {"type": "friction", "coordinate": "rail", "model": "stiction", "coefficient": MU},
        "drive": {"type": "motor", "coordinate": "bearing", "effort": TORQUE},
    }
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"spindle": solid(2.0, INERTIA), "table": solid(MASS, 1.0, position=[0.2, 0, 0])},
        "joints": {name: joint for name, joint in joints.items() if name not in more.get("couplings", {})},
        "forces": forces,
        **more,
    }
    return simulate(sections, duration=0.1, integrator="dopri5")


@pytest.mark.parametrize(
    "kinds",
    [
        {},
        {"rail": (-1, 0, 0)},
        {"bearing": (-1, 0, 0), "nut": ("table", "spindle")},
        {"turned": True, "rail": (-1, 0, 0)},
    ],
    ids=["plain", "rail turned", "bearing turned", "rail from the table"],
)
def test_the_refusal_writes_the_coupling_that_moves_as_the_screw(kinds):
    with pytest.raises(ModelError, match="in place of the joint nut under `couplings`") as refused:
        feed(**kinds)
    line = re.search(r"`(nut: \{type: linear.*?\})`", str(refused.value))[1]
    result = feed(**kinds, couplings=yaml.safe_load(line))
    # (J + m p²) φ̈ = T - μ m g p, and the table goes the way of the thread: x = -p φ about the x axis
    lead = PITCH / (2 * math.pi)
    turn = -1.0 if kinds.get("bearing") else 1.0
    alpha = (TORQUE - MU * MASS * G * lead) / (INERTIA + MASS * lead**2)
    assert result.array("joint_coordinate")[-1, 0] == pytest.approx(0.5 * alpha * 0.01, rel=1e-6)
    assert result.array("table.position.x")[-1] - 0.2 == pytest.approx(-turn * lead * 0.5 * alpha * 0.01, rel=1e-6)
    assert result.array("force.rub.normal_load")[-1] == pytest.approx(MASS * G, rel=1e-6)


@pytest.mark.parametrize(
    "kinds", [{}, {"rail": (-1, 0, 0)}, {"bearing": (-1, 0, 0), "nut": ("table", "spindle")}, {"turned": True}]
)
def test_the_coupling_has_the_sense_of_the_screw_joint(kinds):
    """Without friction the joint itself moves the table, redundant as it is."""
    with pytest.raises(ModelError) as refused:
        feed(**kinds)
    line = re.search(r"`(nut: \{type: linear.*?\})`", str(refused.value))[1]
    drive = {"drive": {"type": "motor", "coordinate": "bearing", "effort": TORQUE}}
    screw, coupled = feed(**kinds, forces=drive), feed(**kinds, forces=drive, couplings=yaml.safe_load(line))
    assert coupled.array("table.position.x")[-1] == pytest.approx(screw.array("table.position.x")[-1], rel=1e-7)
