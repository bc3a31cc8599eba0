"""No light is green over an answer that is wrong by more than ten times what the headline says; harmless machines stay green."""

import numpy as np
import pytest

from deceiving import KINDS
from nivel import ModelError, SolveError
from nivel.api import Machine

# of the size, what the headline may be short of
ROUND_OFF = 1e-10
DEFAULT = (("rk4", "absolute"), ("dopri5", "relative"))
INTEGRATORS = (
    "rk4",
    "heun",
    "ab4",
    "abm4",
    "am3",
    "gear2",
    "dopri5",
    "dop853",
    "adams",
    "gear",
    "radau",
    "bdf",
    "ros2",
)
RESIDUAL = ("generalised-alpha", "hht", "newmark", "energy-momentum")
GRID = [
    (integrator, coordinates)
    for coordinates in ("absolute", "relative", "independent")
    for integrator in (*INTEGRATORS, *RESIDUAL)
]
# stiff: explicit methods that choose their steps take a hundred thousand
SLOW = {("vibrating-tip", "dopri5"), ("chaos", "rk4")}


def pair(kind, method):
    default = method in DEFAULT and (kind.name, method[0]) not in SLOW
    return pytest.param(kind, *method, id=f"{kind.name}-{'-'.join(method)}", marks=() if default else pytest.mark.full)


PAIRS = [pair(kind, method) for kind in KINDS for method in GRID]


@pytest.mark.parametrize(("kind", "integrator", "coordinates"), PAIRS)
def test_no_green_light_stands_over_a_wrong_answer(kind, integrator, coordinates):
    try:
        result = Machine.from_record(kind.machine(False)).simulate(
            integrator=integrator, coordinates=coordinates, verify=True
        )
    except (ModelError, SolveError):
        return  # refused, or failed and said so
    if result.trust.verdict == "green":
        assert kind.error(result) <= 10.0 * result.trust.accuracy_estimate + ROUND_OFF * result.trust.size, result


@pytest.mark.parametrize(("kind", "integrator", "coordinates"), PAIRS)
def test_harmless_machines_stay_green(kind, integrator, coordinates):
    try:
        result = Machine.from_record(kind.machine(True)).simulate(
            integrator=integrator, coordinates=coordinates, verify=True
        )
    except ModelError:
        return  # methods that do not go together
    error = kind.error(result, harmless=True)
    assert error <= 10.0 * result.trust.accuracy_estimate + ROUND_OFF * result.trust.size, result
    lights = {item.name: item.verdict for item in result.trust.items if item.verdict != "green"}
    # a method of low order is not exact enough with these steps, and says so
    if error < 1e-5 * result.trust.size:
        assert not lights, result


def test_what_was_missed_is_named_with_its_time_scale():
    """A push of 20 µs between steps of 1 ms: the function, when, how fast it changes, and the step that would see it."""
    kind = next(each for each in KINDS if each.name == "pulse-of-2e-05-s")
    trust = Machine.from_record(kind.machine(False)).simulate(integrator="rk4").trust
    line = next(item for item in trust.items if item.name == "loads")
    assert line.verdict == "red"
    assert line.row == "push.vector.x"
    assert line.time == pytest.approx(0.7, abs=1e-3)
    assert "within 1e-5 s, with steps of 0.001 s; use steps of 1e-6 s" in line.text


def test_turns_that_cannot_be_counted_are_red_without_a_second_run():
    kind = next(each for each in KINDS if each.name == "flywheel-5000")
    trust = Machine.from_record(kind.machine(False)).simulate(coordinates="absolute", integrator="rk4").trust
    line = next(item for item in trust.items if item.name == "turn")
    assert (line.verdict, line.row) == ("red", "wheel")
    assert line.fraction == pytest.approx(5.0, rel=1e-3)


def test_chaos_is_called_by_its_name_and_time():
    kind = next(each for each in KINDS if each.name == "chaos")
    trust = Machine.from_record(kind.machine(False)).simulate(integrator="dopri5", verify=True).trust
    line = next(item for item in trust.items if item.name == "sensitivity")
    assert line.verdict == "amber"
    assert 1.0 < line.time < 25.0


def test_every_number_of_a_verified_run_has_its_own_estimate():
    """Of a pendulum beside a flywheel: the angle, against its exact value, within a factor of three above."""
    kind = next(each for each in KINDS if each.name == "pendulum-beside-flywheel")
    result = Machine.from_record(kind.machine(False)).simulate(verify=True)
    error = np.abs(result.array("pin.angle") - kind.exact(result.time, False))
    estimate = result.estimated_error("pin.angle")
    assert estimate.shape == error.shape
    assert (np.diff(estimate[np.isfinite(estimate)]) >= 0.0).all()
    assert error.max() <= np.nanmax(estimate) <= 4.0 * error.max()
    own = next(item for item in result.trust.items if item.name == "accuracy")
    assert own.row == "bob"


def test_a_load_that_is_as_good_as_nothing_stops_no_step():
    """Squares of its errors underflow: a Gaussian pulse of 10 ms is 1e-300 N before it begins. It leaves a speed of one metre a second."""
    kind = next(each for each in KINDS if each.name == "gaussian-of-0.01-s")
    result = Machine.from_record(kind.machine(False)).simulate(integrator="dop853", coordinates="independent")
    assert result.timing["steps"] < 10_000
    assert kind.error(result) < 1e-6
