"""Steps that are chosen end where a condition on the motion changes, so that they lose nothing there: against motions in closed form."""

import numpy as np
import pytest

from simulating import simulate, slide, solid

pytestmark = pytest.mark.covering

CHOSEN = ("dopri5", "dop853", "adams", "gear", "radau", "bdf", "generalised-alpha")
QUARTER = np.sqrt(2.0 * 0.3 * 2.0 / 5.0)


def push(effort, *, mass=2.0, start=0.3, rate=0.0, duration=3.0, more=None, **settings):
    """A cart on a rail under an effort."""
    if settings.get("integrator") == "generalised-alpha":
        settings["step_control"] = "error"
    cart = {
        "bodies": {"cart": solid(mass, 1.0)},
        "joints": {"rail": slide("ground", "cart", start={"displacement": start}, start_rates={"displacement": rate})},
        "forces": {"push": {"type": "motor", "coordinate": "rail", "effort": effort}},
    }
    return simulate({**cart, **(more or {})}, duration=duration, output_interval=0.01, **settings)


def rejected(result):
    return result.timing["rejected"]


def there_and_back(t):
    """Parabolas of the acceleration ∓5/2 m/s², joined where x = 0, every second quarter of the period."""
    a, phase = 2.5, np.mod(t, 4.0 * QUARTER)
    first, second = 0.3 - 0.5 * a * phase**2, -0.3 + 0.5 * a * (phase - 2.0 * QUARTER) ** 2
    third = 0.3 - 0.5 * a * (4.0 * QUARTER - phase) ** 2
    return np.where(phase < QUARTER, first, np.where(phase < 3.0 * QUARTER, second, third))


@pytest.mark.parametrize("integrator", CHOSEN)
def test_parabolas_are_joined_at_the_exact_time(integrator):
    """Parabolas leave no error to the methods, so what is left is that of the location: without it 1e-6 m and sixty rejected steps."""
    result = push("if(rail.displacement > 0, -5, 5)", integrator=integrator)
    np.testing.assert_allclose(result.array("rail.displacement"), there_and_back(result.time), atol=1e-8)
    assert rejected(result) == 0
    assert result.trust.verdict == "green"


@pytest.mark.parametrize("coordinates", ["absolute", "independent"])
@pytest.mark.parametrize(
    "effort",
    [
        "-5*sign(rail.displacement)",
        "5 - 10*(rail.displacement > 0 and (time >= 0 or rail.displacement < -9))",
        "if(not(rail.displacement <= 0), -5, if(rail.displacement > 0.1, 77, 5))",
        "-5*abs(rail.displacement)/rail.displacement",
        "if(above > 0.5, -5, 5)",
    ],
)
def test_however_it_is_said(effort, coordinates):
    """Two switches at one time, conditions put together, one in a branch that is not taken, one on a signal that jumps itself."""
    block = {"control": {"above": {"type": "signal", "value": "if(rail.displacement > 0, 1, 0)"}}}
    more = block if "above" in effort else None
    result = push(effort, integrator="dopri5", coordinates=coordinates, more=more)
    np.testing.assert_allclose(result.array("rail.displacement"), there_and_back(result.time), atol=1e-8)
    assert rejected(result) == 0


def half_sines(t):
    """x of x'' = -w² x with w = 10 above 0 and 5 below, from x = 0.3 at rest."""
    period = np.pi / 10.0 + np.pi / 5.0
    phase = np.mod(t + np.pi / 20.0, period)
    return np.where(phase < np.pi / 10.0, 0.3 * np.sin(10.0 * phase), -0.6 * np.sin(5.0 * (phase - np.pi / 10.0)))


@pytest.mark.parametrize("integrator", ["dopri5", "dop853", "adams", "gear", "radau", "bdf"])
@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
def test_a_spring_of_two_stiffnesses_keeps_its_period(integrator, tolerance):
    """Within ten times the tolerance, as everywhere, of the largest speed's scale."""
    effort = "-if(rail.displacement > 0, 200, 50)*rail.displacement"
    result = push(effort, integrator=integrator, tolerance=tolerance)
    np.testing.assert_allclose(result.array("rail.displacement"), half_sines(result.time), atol=10.0 * tolerance)
    assert result.trust.verdict == "green"


@pytest.mark.parametrize("integrator", CHOSEN)
def test_a_visit_beyond_within_one_step_is_seen(integrator):
    """A throw that would rise 1 cm beyond x = 0.99 m, where 18 N more push back: 0.2 m/s stop within 1 cm/10 and 0.01 s."""
    result = push(
        "-2 - if(rail.displacement > 0.99, 18, 0)", mass=1.0, start=0.0, rate=2.0, duration=1.9, integrator=integrator
    )
    t = result.time
    beyond, after = t - 0.9, t - 0.92
    exact = np.where(
        t < 0.9,
        2.0 * t - t**2,
        np.where(t < 0.92, 0.99 + 0.2 * beyond - 10.0 * beyond**2, 0.99 - 0.2 * after - after**2),
    )
    np.testing.assert_allclose(result.array("rail.displacement"), exact, atol=1e-7)


@pytest.mark.parametrize("integrator", ["dopri5", "radau"])
def test_a_branch_needs_no_value_beyond_its_condition(integrator):
    """x'' = 2 - 10 √x, and 2 below 0: the energy v²/2 + 20/3 x^(3/2) - 2 x stays."""
    effort = "2 - 10*if(rail.displacement > 0, sqrt(rail.displacement), 0)"
    result = push(effort, mass=1.0, rate=-2.5, integrator=integrator)
    x, v = result.array("rail.displacement"), result.array("rail.displacement.rate")
    energy = 0.5 * v**2 + 20.0 / 3.0 * np.maximum(x, 0.0) ** 1.5 - 2.0 * x
    assert x.min() < -0.1
    np.testing.assert_allclose(energy, energy[0], rtol=1e-5)


def test_at_rest_a_condition_costs_next_to_nothing():
    """A damper of two rates ends no step where the speed is round-off: twice the time takes a few long steps more."""
    effort = "-2000*rail.displacement - if(rail.displacement_rate > 0, 40, 10)*rail.displacement_rate"
    short, long = (push(effort, duration=duration, integrator="radau") for duration in (30.0, 60.0))
    assert long.timing["steps"] < short.timing["steps"] + 40


def test_what_is_zero_all_along_stays_so():
    result = push("-3*sign(rail.displacement_rate) + 4*abs(rail.displacement)", start=0.0, integrator="dopri5")
    np.testing.assert_array_equal(result.array("rail.displacement"), 0.0)
    assert result.timing["steps"] < 20
