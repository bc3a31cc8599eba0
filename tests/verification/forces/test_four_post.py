"""Four-post rig: body and wheels of a shaken car against the linear quarter car."""

from pathlib import Path

import numpy as np
import pytest

import nivel

CAR = nivel.load(Path(__file__).parents[3] / "examples/vehicles/four-post.yaml")
SPRING, DAMPER, TYRE, LOSS, WHEEL = 20e3, 1.5e3, 200e3, 100.0, 40.0


def responses(frequency, mass):
    """Complex amplitudes of the body and of the wheel by that of the road, of a quarter car with this mass on its spring."""
    s = 2j * np.pi * frequency
    above, below = SPRING + DAMPER * s, TYRE + LOSS * s
    matrix = [[mass * s * s + above, -above], [-above, WHEEL * s * s + above + below]]
    return np.linalg.solve(matrix, [0.0, below])


def amplitude(time, z, frequency):
    """Complex amplitude of the vibration by sin 2πft after it has settled."""
    late = time > 4.0
    angle = 2.0 * np.pi * frequency * time[late]
    terms = np.stack([np.sin(angle), np.cos(angle), np.ones_like(angle)], axis=1)
    a, b, _ = np.linalg.lstsq(terms, z[late], rcond=None)[0]
    return a + 1j * b


@pytest.mark.parametrize("frequency", [1.25, 5.0, 11.0])
def test_a_shaken_car_moves_as_the_linear_quarter_car(frequency):
    found = CAR.with_values({"parameters.frequency": frequency}).simulate(verify=False)
    names = [each.name for each in CAR.record.bodies]
    for name, expected in zip(("car", "fl"), responses(frequency, 300.0), strict=True):
        z = found.array("position")[:, names.index(name), 2]
        assert amplitude(found.time, z, frequency) == pytest.approx(5e-3 * expected, rel=1e-4)
