"""Verified machines with beams: the second run has longer steps, and still tells the error of the first."""

import pytest

from beams import general
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run import attempt as second_run
from nivel.analysis.run.dynamics import RunOutcome
from nivel.judge.after.checks.accuracy import MARGIN, error_from_finer
from simulating import machine

pytestmark = pytest.mark.covering

SECTION = general(EA=2e5, GA=1e5, GJ=100.0, EI=150.0, inertia=(2e-3, 1e-3, 1e-3))


def pendulum(step, **simulation):
    """A beam of 1 m that falls about a hinge at its root; at most 100 frames a second."""
    run = {"duration": 1.0, "step": step, "output_interval": 0.02, "integrator": "generalised-alpha", **simulation}
    hinge = {"type": "revolute", "bodies": ["ground", "arm.start"], "point": [0, 0, 0], "axis": [0, 1, 0]}
    arm = {"from": [0, 0, 0], "to": [1, 0, 0], "section": SECTION, "elements": 4}
    return machine({"gravity": [0, 0, -9.81], "beams": {"arm": arm}, "joints": {"hinge": hinge}, "simulation": run})


def test_longer_steps_tell_the_error_of_the_shorter_ones():
    """Against an eighth of the step, whose error is a 64th: within a factor of two and a half."""
    result = pendulum(2e-3).simulate(verify=True)
    exact = pendulum(2.5e-4).simulate(verify=False)
    error = error_from_finer(result, exact, 0.0).value / MARGIN
    assert "steps of 3.33 ms" in str(result.trust)
    assert 0.4 * error < result.trust.accuracy_estimate < 2.5 * error


def test_run_that_fails_with_longer_steps_is_verified_with_shorter_ones(monkeypatch):
    march, steps = second_run.march, []

    def failing(prepared, settings, *given, **named):
        steps.append(settings.step)
        if settings.step > 2e-3:
            return RunOutcome("failed", failure=("stopped", "", 0.0))
        return march(prepared, settings, *given, **named)

    monkeypatch.setattr(second_run, "march", failing)
    result = pendulum(2e-3).simulate(verify=True)
    assert max(steps) == pytest.approx(2e-3 * 5 / 3)
    assert min(steps) == pytest.approx(2e-3 * 5 / 8)
    assert result.trust.accuracy_estimate is not None
    assert "verified" not in {item.name for item in result.trust.items if item.verdict != "green"}


@pytest.mark.parametrize(
    "given", [{"integrator": "rk4", "step": 1e-5}, {"output_interval": 0.05, "step": 0.025}, {"step_control": "error"}]
)
def test_other_runs_have_shorter_steps_or_a_smaller_tolerance(given):
    """Explicit methods, few frames, chosen steps."""
    plan = plan_run(pendulum(**{"step": 2e-3, **given}).record)
    assert second_run.coarsened(plan) is None
