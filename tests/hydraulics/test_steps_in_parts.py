"""Steps over circuits that cannot be trusted are made in parts: small volumes on which valves open, with rigid and flexible bodies."""

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import nivel
from circuits import BAR, circuit, history

pytestmark = pytest.mark.covering

FILE = Path(__file__).parents[2] / "examples" / "hydraulics" / "loader-crane.yaml"


@cache
def flexible_crane(step):
    """Up to where the counterbalance valve has opened onto 5 cm³ and the load moves."""
    return nivel.load(FILE, {"include": "booms/flexible.yaml"}).simulate(duration=0.6, step=step, output_interval=4e-3)


def timing(result, name):
    return json.loads(result.attributes["timing"])[name]


def test_a_flexible_crane_at_one_millisecond_is_that_of_short_steps():
    """Four modes from 115 Hz on: the difference is the error of order two of these vibrations, and nothing cavitates."""
    coarse, fine = flexible_crane(1e-3), flexible_crane(1.25e-4)
    assert 0 < timing(coarse, "rejected") < 32
    assert np.max(np.abs(coarse.array("joint_coordinate") - fine.array("joint_coordinate"))) < 5e-4
    for name in ("lift_line", "lift_gap"):
        pressure = history(coarse, f"hydraulics.{name}.pressure")
        assert np.min(pressure) > 1 * BAR
        assert np.sqrt(np.mean((pressure - history(fine, f"hydraulics.{name}.pressure")) ** 2)) < 2 * BAR


# A tank at 100 bar feeds 1 cm³ through a valve that opens at 10 ms, and from there 1 L: pressures jump within a step.
SUDDEN = {
    "supply": {"type": "tank", "pressure": 100 * BAR},
    "small": {"type": "volume", "volume": 1e-6, "start": 2 * BAR},
    "large": {"type": "volume", "volume": 1e-3, "start": 2 * BAR},
    "valve": {
        "type": "directional-valve", "ways": "2/2", "ports": {"P": "supply", "A": "small"}, "flow": "40 L/min",
        "pressure_drop": "7 bar", "command": "step(time, 0.01, 0, 0.0101, 1)",
    },
    "behind": {"type": "orifice", "ports": {"A": "small", "B": "large"}, "flow": "40 L/min", "pressure_drop": "7 bar"},
}  # fmt: skip


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_a_valve_that_opens_at_once_onto_a_small_volume_is_followed(coordinates):
    """Both with derivatives by hand and with all tangents."""
    settings = {
        "integrator": "extrapolated-euler",
        "coordinates": coordinates,
        "duration": 0.03,
        "output_interval": 1e-3,
    }
    coarse = circuit(SUDDEN).simulate(step=1e-3, **settings)
    exact = circuit(SUDDEN).simulate(integrator="radau", tolerance=1e-8, duration=0.03, output_interval=1e-3)
    assert timing(coarse, "rejected") > 0
    for name in ("small", "large"):
        difference = history(coarse, f"hydraulics.{name}.pressure") - history(exact, f"hydraulics.{name}.pressure")
        assert np.max(np.abs(difference)) < 2.5 * BAR
