"""States by their names alone, and the page whose winding warms up."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

from nivel.api import Machine
from nivel.files import parse_machine

PAGE = (Path(__file__).parents[2] / "docs" / "machine-files" / "motors.md").read_text(encoding="utf-8")
(WARM,) = [each for each in re.findall(r"^```yaml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL) if "winding" in each]


def test_a_winding_warms_up_by_its_losses():
    """Steady speed: 80 (20 - ω) = 9 ω. Torque 9 ω/10, copper by its current, iron by the map between its points; then a first-order lag."""
    result = Machine.from_record(parse_machine(WARM)).simulate(verify=False)
    speed = 1600 / 89
    torque = 0.9 * speed
    copper = 0.5 * (torque / 1.2) ** 2
    iron = np.interp(10 * speed, [0, 200], [np.interp(torque, [0, 40], [0, 10]), np.interp(torque, [0, 40], [60, 90])])
    assert np.asarray(result["axle.angle_rate"])[-1] == pytest.approx(speed, rel=1e-9)
    assert np.asarray(result["control.iron"])[-1] == pytest.approx(iron, rel=1e-9)
    time, winding = np.asarray(result.time), np.asarray(result["state.winding"])
    k = np.searchsorted(time, 60.0)
    end = 293 + (copper + iron) / 4
    lag = math.exp(-(time[-1] - time[k]) / 25)
    assert winding[-1] == pytest.approx(end + (winding[k] - end) * lag, abs=1e-5)


def test_a_name_alone_is_the_value_of_a_state():
    alone, written = (
        Machine.from_record(parse_machine(WARM.replace("winding - 293", f"{name} - 293"))).simulate(
            duration=2.0, verify=False
        )
        for name in ("winding", "winding.value")
    )
    assert np.array_equal(np.asarray(alone["state.winding"]), np.asarray(written["state.winding"]))
