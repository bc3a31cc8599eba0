"""No light is green over a wrong answer of ropes, stops, drives, states, blocks and tables of place; made harmless, they stay green."""

import pytest

from deceiving_control import KINDS
from test_deceiving import ROUND_OFF
from test_deceiving_circuits import run

INTEGRATORS = (
    *("rk4", "heun", "abm4", "dopri5", "dop853", "adams"),
    *("radau", "bdf", "ros2", "generalised-alpha", "hht"),
)
# quick to refute, or with a solution in closed form
DEFAULT = {("narrow-state", "dopri5"), ("gust", "radau"), ("quick-filter", "dopri5"), ("humming-input", "rk4")}
CALM = {("quick-filter", "dopri5"), ("humming-input", "rk4")}


def pairs(default):
    """All machines with all methods; those that are not `default` are for --full."""
    return [
        pytest.param(
            kind,
            method,
            id=f"{kind.name}-{method}",
            marks=() if (kind.name, method) in default else pytest.mark.full,
        )
        for kind in KINDS
        for method in INTEGRATORS
    ]


@pytest.mark.parametrize(("kind", "integrator"), pairs(DEFAULT))
def test_no_green_light_stands_over_a_wrong_answer(kind, integrator):
    result = run(kind, integrator, "auto", harmless=False)
    if result is not None and result.trust.verdict == "green":
        assert kind.error(result) <= 10.0 * result.trust.accuracy_estimate + ROUND_OFF * result.trust.size, result


@pytest.mark.parametrize(("kind", "integrator"), pairs(CALM))
def test_harmless_machines_stay_green(kind, integrator):
    result = run(kind, integrator, "auto", harmless=True)
    if result is None:
        return
    if result.trust.verdict != "green":
        assert kind.error(result, harmless=True) > 1e-5 * result.trust.size, result
    else:
        assert (
            kind.error(result, harmless=True) <= 10.0 * result.trust.accuracy_estimate + ROUND_OFF * result.trust.size
        )
