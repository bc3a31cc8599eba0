"""Integrators that choose their steps on equations with known solutions: orders, dense output, tolerances, stiffness."""

import numpy as np
import pytest
import toys
from scipy.integrate import solve_ivp

pytestmark = pytest.mark.covering

START = [0.0, 1.0, 0.0, 0.0]


def slope(steps, errors):
    return np.polyfit(np.log(steps), np.log(errors), 1)[0]


@pytest.mark.parametrize(("integrator", "order", "coarsest"), [("dopri5", 5, 0.2), ("dop853", 8, 0.5)])
def test_runge_kutta_methods_have_their_order_at_fixed_steps(integrator, order, coarsest):
    """A tolerance that never rejects, and a largest step: all steps are equal."""
    steps, errors = coarsest / 2.0 ** np.arange(3), []
    for step in steps:
        run = toys.march(integrator, toys.swing, [1.0, 0.5, 0, 0], 8.0, tolerance=1e6, step=step, fixed=True)
        assert np.allclose(np.diff(run.time), step)
        errors.append(np.abs(run.y[:, :2] - swing(run.time)).max())
    assert abs(slope(steps, errors) - order) < 0.5, errors


@pytest.mark.parametrize(("integrator", "order", "coarsest"), [("dopri5", 4, 0.4), ("dop853", 7, 1.2)])
def test_dense_output_of_one_step_errs_by_its_order_and_one(integrator, order, coarsest):
    """Largest error inside the first step of a pendulum with a shaking support."""
    steps, errors, theta = coarsest / 2.0 ** np.arange(4), [], np.linspace(0, 1, 21)
    for step in steps:
        run = toys.march(integrator, toys.swing, [1.0, 0.5, 0, 0], step, tolerance=1e6, step=step, fixed=True)
        assert len(run.inside) == 1
        found = np.array([toys.between(run.inside[0], each) for each in theta])
        errors.append(np.abs(found[:, :2] - swing(theta * step)).max())
    assert slope(steps, errors) > order + 0.6, errors
    np.testing.assert_allclose(found[-1], run.y[-1], rtol=0, atol=1e-15)


def swing(times):
    """(n, 2) angle and rate of `toys.swing` from (1, 1/2), by scipy."""

    def rates(t, y):
        return [y[1], -(1 + 0.5 * np.cos(t)) * np.sin(y[0])]

    return solve_ivp(rates, (0, times[-1]), [1.0, 0.5], "DOP853", rtol=1e-13, atol=1e-14, t_eval=times).y.T


TOLERANCES = np.logspace(-4, -10, 7)


@pytest.mark.parametrize("integrator", ["dopri5", "dop853", "adams", "gear"])
def test_error_follows_the_tolerance(integrator):
    """Ten turns of an oscillator and 20 s of the shaken pendulum: within ten times the tolerance, inside steps too, and falling with it."""
    for equation, start, end in ((toys.oscillator, START, 20 * np.pi), (toys.swing, [1.0, 0.5, 0, 0], 20.0)):
        errors = []
        for tolerance in TOLERANCES:
            run = toys.march(integrator, equation, start, end, tolerance=tolerance)
            times = np.concatenate([run.time[:-1] + 0.37 * np.diff(run.time), run.time[1:]])
            found = np.array([toys.between(each, theta) for theta in (0.37, 1.0) for each in run.inside])
            order = np.argsort(times)
            times, found = times[order], found[order]
            expected = np.sin(times) if equation is toys.oscillator else swing(np.append(0.0, times))[1:, 0]
            errors.append(np.abs(found[:, 0] - expected).max())
            assert errors[-1] < 10 * tolerance
        assert 0.8 < slope(TOLERANCES, errors) < 1.2, errors


@pytest.mark.parametrize("integrator", ["adams", "gear"])
def test_dense_output_of_multistep_methods_passes_through_both_ends(integrator):
    run = toys.march(integrator, toys.swing, [1.0, 0.5, 0, 0], 5.0, tolerance=1e-8)
    ends = np.array([toys.between(each, 1.0) for each in run.inside])
    # with Adams the state goes one order further than the polynomial: by the estimated error of the step
    np.testing.assert_allclose(ends, run.y[1:], rtol=0, atol=1e-9 if integrator == "adams" else 1e-14)


def test_high_orders_are_used_where_much_is_asked_for():
    assert toys.march("adams", toys.oscillator, START, 20 * np.pi, tolerance=1e-10).orders.max() >= 8
    assert toys.march("gear", toys.oscillator, START, 20 * np.pi, tolerance=1e-6).orders.max() == 5


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_gear_with_newton_follows_the_smooth_solution_of_a_stiff_equation(tolerance):
    """λ = -10⁶ over 10 s: an explicit method needs 3·10⁶ steps for its stability alone."""
    run = toys.march("gear", toys.stiff, [1.0, 1.0, 0.0, 0.0], 10.0, tolerance=tolerance, newton=True)
    assert np.abs(run.y[:, 0] - np.cos(run.time)).max() < tolerance
    assert np.abs(run.y[:, 1] - np.cos(run.time)).max() < 10 * tolerance
    assert run.evaluations < 5000
    assert run.rejected < 20


def test_evaluations_of_explicit_methods_are_counted():
    """Six (or eleven) a step, one for the accepted state, one for the first step; dop853 takes four more for its dense output."""
    for integrator, each in (("dopri5", 7), ("dop853", 12 + 4)):
        run = toys.march(integrator, toys.oscillator, START, 5.0, tolerance=1e-6)
        assert run.rejected == 0
        assert run.evaluations == each * len(run.inside) + 1
