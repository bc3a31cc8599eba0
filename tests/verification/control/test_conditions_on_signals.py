"""Forces that switch with what the machine does: `if`, `sign` and comparisons of measured signals."""

import numpy as np
import pytest

from simulating import simulate

pytestmark = pytest.mark.covering

FORCE, MASS, START = 5.0, 2.0, 0.3
QUARTER = np.sqrt(2.0 * START * MASS / FORCE)


def there_and_back(effort, **settings):
    """A cart that is pushed back to the middle by a force of constant size."""
    return simulate(
        {
            "bodies": {"cart": {"mass": MASS, "inertia": [1, 1, 1]}},
            "joints": {
                "rail": {
                    "type": "translational",
                    "bodies": ["ground", "cart"],
                    "point": [0, 0, 0],
                    "axis": [1, 0, 0],
                    "start": {"displacement": START},
                }
            },
            "sensors": {"gap": {"distance": ["post", "nose"]}},
            "markers": {"post": {"body": "ground", "position": [-10, 0, 0]}, "nose": {"body": "cart"}},
            "forces": {"push": {"type": "motor", "coordinate": "rail", "effort": effort}},
        },
        duration=3.0,
        step=0.01,
        **settings,
    )


def expected(t):
    """Parabolas of the acceleration F/m, which changes its sign every second quarter of the period 4 √(2 x₀ m/F)."""
    a, phase = FORCE / MASS, np.mod(t, 4.0 * QUARTER)
    half = START - 0.5 * a * phase**2, -START + 0.5 * a * (phase - 2 * QUARTER) ** 2
    return np.where(
        phase < QUARTER, half[0], np.where(phase < 3 * QUARTER, half[1], START - 0.5 * a * (4 * QUARTER - phase) ** 2)
    )


@pytest.mark.parametrize(
    "effort",
    ["if(rail.displacement > 0, -5, 5)", "-5*sign(rail.displacement)", "5 - 10*(gap.distance > 10)"],
)
def test_chosen_steps_follow_a_force_that_switches_with_a_signal(effort):
    result = there_and_back(effort, integrator="dopri5")
    np.testing.assert_allclose(result.array("rail.displacement"), expected(result.time), atol=1e-4)
    assert result.trust.verdict == "green"


def test_fixed_steps_that_are_too_long_for_a_switch_are_not_green():
    result = there_and_back("if(rail.displacement > 0, -5, 5)")
    assert np.abs(result.array("rail.displacement") - expected(result.time)).max() > 0.01
    assert result.trust.verdict != "green"
