"""Times of samples: the n-th one is the decimal number that a user writes for it, whatever the step and the method."""

from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.system.signals.control import ratio_of, ticks
from simulating import simulate, slide, solid

COUNT = 12
FAULTS = Path(__file__).parents[2] / "faults"


def written(period: str, n: int) -> str:
    """n periods as a decimal number without round-off."""
    return str(n * Decimal(period))


def steps_of(period: str):
    """Whole parts of a period, with multiples that floating point misses by a unit in the last place."""
    return [f"{period}/{parts} s" for parts in (1, 7, 19)]


def cart(period: str) -> dict:
    """A cart, and for each of the samples a state that notes whether its time has come."""
    return {
        "bodies": {"cart": solid(1.0)},
        "joints": {"rail": slide("ground", "cart")},
        "states": {
            f"note_{n}": {"update": f"1*(time >= {written(period, n)})", "every": f"{period} s"}
            for n in range(1, COUNT + 1)
        },
    }


@pytest.mark.parametrize("period", ["0.3", "0.1", "0.07", "0.013", "0.0009"])
@pytest.mark.parametrize("integrator", ["rk4", "extrapolated-euler", "generalised-alpha", "dopri5"])
def test_a_step_function_of_time_is_read_at_its_sample(period, integrator):
    end = float(written(period, COUNT))
    for step in steps_of(period) if integrator != "dopri5" else [f"{period} s"]:
        settings = {"step": step} if integrator != "dopri5" else {}
        result = simulate(cart(period), integrator=integrator, duration=end, output_interval=f"{period} s", **settings)
        frames = np.arange(COUNT + 1)
        for n in range(1, COUNT + 1):
            noted = result.array(f"state.note_{n}")
            np.testing.assert_array_equal(
                noted, 1.0 * (frames >= n), err_msg=f"sample {n} at {written(period, n)} s, step {step}"
            )


def test_times_of_samples_are_rounded_once():
    for period in ("0.3", "0.007", "0.00011"):
        first, each, rate = ticks(float(written(period, 1)) / 3.0, float(period))
        exact = Fraction(period)
        assert [(first + n * each) / rate for n in range(1000)] == [float(exact / 3 + n * exact) for n in range(1000)]


@pytest.mark.parametrize("interval", [1e300, 2.0**-40 * 1.2345678901, np.pi, 1e-9, 1.0 / 1900.0, 3e-4 / 7.0])
def test_a_ratio_is_the_interval_to_round_off(interval):
    assert float(ratio_of(interval)) == pytest.approx(interval, rel=1e-15)
    first, each, rate = ticks(0.0, interval)
    assert first == 0.0
    assert each / rate == pytest.approx(interval, rel=1e-15)


def test_a_sampled_set_point_does_not_depend_on_the_step():
    """A step of the set-point at the fifth sample: with the end of step 95 of 10/19 ms, or 150 of 1/3 ms, a unit too early."""
    ends = []
    for step in ("10/19 ms", "1/3 ms", "0.5 ms", "0.25 ms"):
        result = nivel.load(FAULTS / "late-sample.yaml").simulate(verify=True, step=step)
        assert result.trust.verdict == "green", step
        ends.append(result.array("hinge.angle"))
    for other in ends[1:]:
        np.testing.assert_allclose(other, ends[0], atol=2e-8)
