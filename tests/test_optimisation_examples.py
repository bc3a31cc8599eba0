"""Examples of optimisation: what they find is known, or bounded by theory."""

import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm, solve_continuous_are
from scipy.optimize import linprog

import nivel

FOLDER = Path(__file__).parents[1] / "examples" / "optimisation"
sys.path.insert(0, str(FOLDER))

from controller_gains import ANGLE, FORCE, PLACE, best_in_theory, linear  # noqa: E402
from controller_gains import tuned as tuned_gains  # noqa: E402
from counterbalance import VALVE, tuned  # noqa: E402
from coupler_curve import LENGTHS, synthesised  # noqa: E402
from friction_and_damping import identified  # noqa: E402
from swing_free import fastest, swing_free  # noqa: E402

pytestmark = pytest.mark.compiles  # runs on dual numbers, which `nivel warmup` leaves out


def reached_the_linkage(starts, seed, **given):
    machine, found = synthesised(starts, seed, **given)
    for path in LENGTHS:
        assert found.values[path] == pytest.approx(machine.parameters[path.partition(".")[2]], rel=1e-6)
    return int((found.reached < 1e-12).sum()), found.evaluations


def test_a_linkage_is_found_from_its_coupler_curve():
    """With exact slopes one run gives outputs and slopes, where differences of five parameters take eleven."""
    reached, evaluations = reached_the_linkage(1, 0)
    assert reached == 1
    reached, by_differences = reached_the_linkage(1, 0, exact_slopes=False)
    assert reached == 1
    assert evaluations <= 0.1 * by_differences


@pytest.mark.full
def test_a_linkage_is_found_from_eight_of_ten_starts():
    assert reached_the_linkage(10, 1)[0] >= 8


def chi_square(seed):
    """(p̂ - p)ᵀ cov⁻¹ (p̂ - p)"""
    machine, found = identified(seed)
    error = np.array([value - machine.parameters[path.partition(".")[2]] for path, value in found.values.items()])
    return error @ np.linalg.solve(found.covariance, error)


def test_the_covariance_of_friction_and_damping_covers_the_truth():
    """95 % of two parameters are within χ² = 5.99; three outside of four seeds come once in ten thousand such tests."""
    assert sum(chi_square(seed) <= 5.99 for seed in range(4)) >= 2


@pytest.mark.full
def test_the_covariance_covers_the_truth_of_100_records():
    assert sum(chi_square(seed) <= 5.99 for seed in range(100)) >= 90


def linear_trolley():
    """A, B and C of the trolley about its start: place, angle and their rates."""
    model = nivel.load(FOLDER / "trolley.yaml").linearise(
        inputs=["motor"], outputs=["rail.displacement", "rod.angle", "rail.displacement.rate", "rod.angle.rate"]
    )
    return model.A, model.B, model.C


def reaches(duration, pieces=100):
    """Whether the linear trolley can come to rest three metres away with steps of forces within ±400 N: a linear programme."""
    A, B, C = linear_trolley()
    step, n = duration / pieces, len(A)
    whole = expm(step * np.block([[A, B], [np.zeros((1, n + 1))]]))
    columns, power = [], np.eye(n)
    for _ in range(pieces):
        columns.append(C @ power @ whole[:n, n])
        power = power @ whole[:n, :n]
    found = linprog(np.zeros(pieces), A_eq=np.array(columns).T, b_eq=[3.0, 0.0, 0.0, 0.0], bounds=(-400.0, 400.0))
    return found.status == 0


@pytest.mark.full
def test_the_fastest_motion_is_about_that_of_a_linear_programme():
    """The programme has more freedom, 100 steps for 16 straight lines; angles stay below 0.2 rad."""
    low, high = 3.0, 5.0
    while high - low > 0.01:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if reaches(middle) else (middle, high)
    machine, duration, tables = fastest()
    result = machine.simulate(inputs=tables, duration=duration, verify=False)
    assert result.array("rail.displacement")[-1] == pytest.approx(3.0, abs=1e-5)
    assert abs(result.array("rod.angle")[-1]) < 1e-6
    assert high - 0.05 < duration < 1.05 * high + 0.05


def test_a_load_hangs_at_rest_and_costs_no_more_than_theory_allows():
    """The least effort of the linear model is ΔᵀW⁻¹Δ with the Gramian W = ∫ e^{At} B Bᵀ e^{Aᵀt} dt (Kalman 1960); eight pieces are near."""
    machine, tables, found = swing_free(8)
    assert found.kept
    result = machine.simulate(inputs=tables, verify=False)
    assert result.array("rail.displacement")[-1] == pytest.approx(3.0, abs=1e-6)
    for name in ("rod.angle", "sensor.speed", "sensor.swing_speed"):
        assert abs(result.array(name)[-1]) < 1e-6
    A, B, C = linear_trolley()
    times = np.linspace(0.0, 5.0, 2001)
    columns = np.array([expm(A * t) @ B for t in times])
    gramian = np.trapezoid(np.einsum("tik,tjk->tij", columns, columns), times, axis=0)
    target = np.linalg.solve(C, [3.0, 0.0, 0.0, 0.0])
    least = target @ np.linalg.solve(gramian, target) / 5.0
    assert 0.97 * least < found.objective < 1.1 * least


def cost_in_theory(machine):
    """x₀ᵀ P x₀ from 1 deg, with P of Riccati's equation (Kalman 1960)."""
    A = linear(machine)
    B = (linear(machine, 1.0) - A)[:, :1]
    return (
        np.radians(1.0) ** 2
        * solve_continuous_are(A, B, np.diag([PLACE**-2, ANGLE**-2, 0.0, 0.0]), np.array([[FORCE**-2]]))[1, 1]
    )


def test_at_the_gains_of_theory_the_cost_is_that_of_theory_and_its_slopes_vanish():
    """Of those gains, in shares: at the gains of the file they are a hundred times as large."""
    machine = nivel.load(FOLDER / "balanced-pole.yaml")
    theory = best_in_theory(machine)
    slopes = []
    for values in (theory, {}):
        found = machine.with_values(values).gradient(["integral(sensor.cost)"], list(theory), check=False)
        cost = float(found["integral(sensor.cost)"])
        slopes.append(
            [gain / cost * float(found[f"d(integral(sensor.cost))/d({path})"]) for path, gain in theory.items()]
        )
        if values:
            assert cost == pytest.approx(cost_in_theory(machine), rel=2e-3)
    assert np.abs(slopes[0]).max() < 1e-2 * np.abs(slopes[1]).max()


@pytest.mark.full
def test_gains_that_are_found_are_about_those_of_theory():
    machine, found = tuned_gains()
    assert found.objective == pytest.approx(cost_in_theory(machine), rel=2e-3)
    for path, gain in best_in_theory(machine).items():
        assert found.values[path] == pytest.approx(gain, rel=0.02)


@pytest.mark.full
def test_a_tuned_valve_shakes_the_load_less_within_its_limits():
    """Both numbers come from runs of their own."""
    found = tuned(25)
    assert found.kept
    machine = nivel.load(FOLDER.parent / "hydraulics" / "loader-crane.yaml")
    before, after = (
        np.sqrt(np.mean(each.simulate(verify=False).array("load.acceleration.z") ** 2))
        for each in (machine, machine.with_values({path: found.values[path] for path in VALVE}))
    )
    assert after < 0.99 * before
