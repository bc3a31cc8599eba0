"""Optimisation and identification against closed forms, known machines and the statistics of least squares."""

import sys
from pathlib import Path

import numpy as np
import pytest

import nivel
from needing import needs
from nivel.analysis.optimise.evaluations import Evaluated, NothingFoundError, nothing_found
from nivel.analysis.sweep.variant_runs import VariantRuns, formulas_for
from nivel.errors import Fault, ModelError, SolveError
from nivel.files import parse_machine

pytestmark = pytest.mark.compiles  # runs on dual numbers, which `nivel warmup` leaves out

OSCILLATOR = """
format: 1
bodies: {block: {mass: 2, inertia: [1, 1, 1], position: [0.1, 0, 0]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}
forces:
  spring: {type: joint-spring-damper, coordinate: rail.displacement, stiffness: 50, damping: 4}
simulation: {duration: 2 s, step: 2 ms, output_interval: 20 ms, integrator: rk4}
"""
STIFFNESS, DAMPING = "forces.spring.stiffness", "forces.spring.damping"


@pytest.fixture(scope="module")
def oscillator():
    return nivel.Machine.from_record(parse_machine(OSCILLATOR.replace("position: [0.1, 0, 0]", "velocity: [1, 0, 0]")))


def test_an_optimum_may_lie_on_a_bound(oscillator):
    """The more a block is damped that is thrown with v₀, the less far it goes: the upper bound is found."""
    found = oscillator.optimise("peak(rail.displacement)", {DAMPING: (1.0, 20.0)})
    assert found.values[DAMPING] == pytest.approx(20.0, rel=1e-6)
    assert found.outputs["objective"] == found.objective
    assert found.machine["forces.spring.damping"] == found.values[DAMPING]


@pytest.mark.parametrize("method", ["SLSQP", "trust-constr", "COBYLA"])
def test_a_constraint_decides_where_the_optimum_lies(oscillator, method):
    """The softest spring whose block stays within 0.15 m: from rest with v₀, without damping, x = v₀ √(m/k), k = m v₀²/x²."""
    free = oscillator.with_values({DAMPING: 0.0})
    found = free.optimise(
        result_stiffness,
        {STIFFNESS: (20.0, 60.0, 300.0)},
        outputs={"reach": "max(rail.displacement)"},
        limits={"reach": (None, 0.15)},
        method=method,
        output_interval="2 ms",
    )
    assert found.kept
    assert found.values[STIFFNESS] == pytest.approx(2.0 / 0.15**2, rel=2e-3)


def result_stiffness(result):
    """Of an undamped block: from its largest displacement x, m v₀²/x²."""
    return 2.0 / result.array("rail.displacement").max() ** 2


def test_several_starts_and_every_variant_are_kept(oscillator):
    found = oscillator.optimise(
        "rms(rail.displacement)", {STIFFNESS: (20.0, 80.0), DAMPING: (1.0, 9.0)}, starts=3, seed=5
    )
    assert found.reached.shape == (3,)
    assert found.objective == pytest.approx(found.reached.min())
    assert found.dataset.sizes["variant"] == found.evaluations
    assert set(found.dataset["start"].values.tolist()) == {0, 1, 2}
    assert found.dataset.objective.values.min() == pytest.approx(found.objective)
    assert found.dataset.attrs["prepared_because"] == "", "stiffness and damping are patched"


def test_exact_slopes_lead_to_the_same_optimum(oscillator):
    given = "rms(rail.displacement)", {STIFFNESS: (20.0, 80.0), DAMPING: (1.0, 9.0)}
    differences, exact = (oscillator.optimise(*given, exact_slopes=each) for each in (False, True))
    assert exact.objective == pytest.approx(differences.objective, rel=1e-7)
    assert exact.evaluations < differences.evaluations
    assert exact.dataset.sizes["variant"] == exact.evaluations


def measured(machine, noise, seed, count=100):
    result = machine.simulate(verify=False)
    times = result.time[1 : count + 1]
    rng = np.random.default_rng(seed)
    return {
        "rail.displacement": (
            times,
            result.array("rail.displacement")[1 : count + 1] + noise * rng.standard_normal(count),
        )
    }


def test_parameters_without_noise_are_found_to_round_off(oscillator):
    truth = oscillator.with_values({STIFFNESS: 64.0, DAMPING: 2.5})
    found = oscillator.identify(measured(truth, 0.0, 0), {STIFFNESS: (20, 200), DAMPING: (0, 10)})
    assert found.values[STIFFNESS] == pytest.approx(64.0, rel=1e-7)
    assert found.values[DAMPING] == pytest.approx(2.5, rel=1e-7)


def coverage(oscillator, seeds):
    """How often 2.45 Mahalanobis radii (95 % of two parameters) hold the truth; mean of χ² there."""
    truth, inside, total = oscillator.with_values({STIFFNESS: 64.0, DAMPING: 2.5}), 0, 0.0
    bounds = {STIFFNESS: (40, 90), DAMPING: (0.5, 6)}
    for seed in seeds:
        found = oscillator.identify(measured(truth, 2e-3, seed), bounds)
        error = np.array([found.values[STIFFNESS] - 64.0, found.values[DAMPING] - 2.5])
        chi2 = error @ np.linalg.solve(found.covariance, error)
        inside += chi2 <= 5.99
        total += chi2
    return inside, total / len(seeds)


def test_the_covariance_covers_the_truth(oscillator):
    inside, mean = coverage(oscillator, range(3))
    assert inside >= 2
    assert 0.3 < mean < 5.0


@pytest.mark.full
def test_the_covariance_covers_the_truth_of_100_seeds(oscillator):
    """χ² of two parameters has the mean 2; 95 of 100 are inside on average, and fewer than 90 in one of 70 such tests."""
    inside, mean = coverage(oscillator, range(100))
    assert inside >= 90
    assert mean == pytest.approx(2.0, abs=0.6)


PUSHED = OSCILLATOR.replace("duration: 2 s, step: 2 ms", "duration: 1 s, step: 5 ms").replace(
    "forces:\n",
    "inputs: {push: {range: [-20, 20], units: N}}\n"
    "sensors: {effort: {value: push.value^2, units: N^2}, speed: {coordinate: rail.displacement, quantity: rate}}\n"
    "forces:\n  drive: {type: motor, coordinate: rail, effort: push.value}\n",
)


def test_inputs_over_time_follow_from_exact_slopes_as_from_differences():
    """One run in place of one for each of four corners, twice."""
    machine = nivel.Machine.from_record(parse_machine(PUSHED))
    given = {
        "outputs": {"place": "rail.displacement", "speed": "sensor.speed"},
        "limits": {"place": (0.2, 0.2), "speed": (0.0, 0.0)},
    }
    (tables, exact), (others, differences) = (
        machine.optimal_inputs("mean(sensor.effort)", {"push": 3}, exact_slopes=each, **given) for each in (True, False)
    )
    assert exact.kept
    assert exact.objective == pytest.approx(differences.objective, rel=1e-5)
    np.testing.assert_allclose(tables["push"].values, others["push"].values, atol=1e-2)
    assert exact.evaluations < 0.3 * differences.evaluations


CHAIN = """
format: 1
bodies: {near: {mass: 2, inertia: [1, 1, 1], velocity: [1, 0, 0]}, far: {mass: 1, inertia: [1, 1, 1]}}
joints:
  rail: {type: translational, bodies: [ground, near], point: [0, 0, 0], axis: [1, 0, 0]}
  slide: {type: translational, bodies: [near, far], point: [0, 0, 0], axis: [1, 0, 0]}
forces:
  first: {type: joint-spring-damper, coordinate: rail.displacement, stiffness: 64, damping: 2.5}
  second: {type: joint-spring-damper, coordinate: slide.displacement, stiffness: 120, damping: 1.2}
simulation: {duration: 1.5 s, step: 5 ms, output_interval: 15 ms, integrator: rk4}
"""
FOUR = {
    "first.stiffness": (40, 90),
    "first.damping": (0.5, 6),
    "second.stiffness": (60, 200),
    "second.damping": (0.3, 4),
}


def four_are_covered(seeds):
    """How often 95 % regions of four parameters, χ² below 9.49, hold the truth."""
    machine, rng = nivel.Machine.from_record(parse_machine(CHAIN)), np.random.default_rng(11)
    result, truth = machine.simulate(verify=False), np.array([64.0, 2.5, 120.0, 1.2])
    covered = 0
    for _ in range(seeds):
        data = {
            name: (result.time[1:], result.array(name)[1:] + 2e-3 * rng.standard_normal(len(result.time) - 1))
            for name in ("rail.displacement", "slide.displacement")
        }
        found = machine.identify(data, FOUR)
        error = np.array([*found.values.values()]) - truth
        covered += error @ np.linalg.solve(found.covariance, error) <= 9.49
    return covered


@pytest.mark.parametrize(("seeds", "least"), [(2, 1), pytest.param(100, 90, marks=pytest.mark.full)])
def test_the_covariance_of_four_parameters_covers_the_truth(seeds, least):
    assert four_are_covered(seeds) >= least


def test_what_the_measurements_do_not_tell_apart_is_named(oscillator):
    """Mass, stiffness and damping of a free vibration: only their ratios act."""
    truth = oscillator.with_values({STIFFNESS: 64.0, DAMPING: 2.5})
    bounds = {STIFFNESS: (40, 90), DAMPING: (1, 6), "bodies.block.mass": (1, 3)}
    found = oscillator.identify(measured(truth, 1e-4, 1), bounds)
    assert found.undetermined
    assert np.isinf(found.deviations["bodies.block.mass"])
    assert found.values[STIFFNESS] / found.values["bodies.block.mass"] == pytest.approx(32.0, rel=1e-2)


def test_measurements_come_from_a_file_with_units(oscillator, tmp_path):
    truth = oscillator.with_values({STIFFNESS: 64.0, DAMPING: 2.5})
    times, values = measured(truth, 0.0, 0)["rail.displacement"]
    rows = [f"{1e3 * t:.6f},{1e3 * x:.9f}" for t, x in zip(times, values, strict=True)]
    path = tmp_path / "bench.csv"
    path.write_text("\n".join(["time [ms],rail.displacement [mm]", *rows]))
    found = oscillator.identify(path, {STIFFNESS: (20, 200), DAMPING: (0, 10)}, deviations={"rail.displacement": 1e-3})
    assert found.values[STIFFNESS] == pytest.approx(64.0, rel=1e-5)
    assert found.residuals["rail.displacement"].shape == times.shape


@pytest.mark.parametrize(("outcome", "kind"), [("failed", SolveError), ("refused", NothingFoundError)])
def test_a_search_without_a_result_says_whether_runs_failed(outcome, kind):
    made = [Evaluated(np.zeros(1), np.full(1, np.nan), outcome, "the step is too long", 0)]
    table = object()
    told = nothing_found(made, Fault("", 0, 0, "objective", "no start has one"), "", table)
    assert type(told) is kind
    assert str(told) == "objective: no start has one: the step is too long"
    assert told.result is table


def test_runs_that_take_too_long_are_ended_and_all_variants_are_kept(oscillator):
    """Of 1e12 N/m the vibration has a million turns: minutes of steps, chosen by the method that comes in place of the usual one."""
    stiff = oscillator.with_values({STIFFNESS: 1e12}).with_settings({"integrator": "radau"})
    with pytest.raises(SolveError, match="it took longer than the time limit of 50 ms") as told:
        stiff.optimise("max(rail.displacement)", {STIFFNESS: (1e11, 1e12)}, time_limit=0.05)
    assert set(told.value.result["outcome"].values) == {"timed out"}
    assert told.value.result[STIFFNESS].values[0] == 1e12
    long = oscillator.with_settings({"duration": 2e4, "output_interval": 100.0})
    rows = [{STIFFNESS: 20.0 + k} for k in range(3)]
    ran = VariantRuns(long, formulas_for(long, rows)[0], time_limit=0.01).run(rows[0])
    assert (ran.outcome, ran.result) == ("timed out", None)
    with pytest.raises(ModelError, match="exact slopes have no time limit"):
        oscillator.optimise("max(rail.displacement)", {STIFFNESS: (1, 2)}, exact_slopes=True, time_limit=1.0)


def test_an_objective_that_raises_leaves_the_table_of_all_variants(oscillator):
    """Of soft springs; the best of the others is the softest of them, since x = v₀ √(m/k) without damping."""

    def reach(result):
        found = result.array("rail.displacement").max()
        if found > 0.2:
            raise ValueError("beyond the wall")
        return -found

    found = oscillator.with_values({DAMPING: 0.0}).optimise(
        reach,
        {STIFFNESS: (20.0, 90.0)},
        outputs={"reach": "max(rail.displacement)"},
        method="differential-evolution",
        iterations=2,
        output_interval="2 ms",
    )
    table = found.dataset
    failed = table["outcome"].values == "failed"
    assert 0 < failed.sum() < len(failed)
    assert set(table["reason"].values[failed]) == {"objective: ValueError: beyond the wall"}
    np.testing.assert_array_equal(failed, np.isnan(table["objective"]))
    np.testing.assert_allclose(table["reach"], np.sqrt(2.0 / table[STIFFNESS]), rtol=1e-3)
    assert found.values[STIFFNESS] == table[STIFFNESS].values[~failed].min()


def test_an_objective_that_always_raises_is_told_with_the_table(oscillator):
    def nothing(result):
        raise KeyError("nothing")

    with pytest.raises(SolveError, match="objective: no start has one: objective: KeyError: 'nothing'") as told:
        oscillator.optimise(nothing, {DAMPING: (1.0, 20.0)}, starts=2)
    assert set(told.value.result["outcome"].values) == {"failed"}
    with pytest.raises(ModelError, match="did you mean"):
        oscillator.optimise("max(rail.displacment)", {DAMPING: (1.0, 20.0)})


def test_a_parameter_that_would_go_beyond_its_bound_has_no_deviation(oscillator):
    """The others have that of a fit in which it is held there."""
    truth = oscillator.with_values({STIFFNESS: 64.0, DAMPING: 2.5})
    data = measured(truth, 1e-3, 3)
    found = oscillator.identify(data, {STIFFNESS: (20, 200), DAMPING: (3.0, 10.0)})
    held = oscillator.with_values({DAMPING: 3.0}).identify(data, {STIFFNESS: (20, 200)})
    assert found.on_bounds == (DAMPING,)
    assert found.values[DAMPING] == 3.0
    assert np.isnan(found.deviations[DAMPING])
    assert found.values[STIFFNESS] == pytest.approx(held.values[STIFFNESS], rel=1e-6)
    assert found.deviations[STIFFNESS] == pytest.approx(held.deviations[STIFFNESS], rel=1e-3)
    assert held.on_bounds == ()


@pytest.mark.parametrize(("method", "module", "near"), [("CMA-ES", "cma", 1e-4), ("TPE", "optuna", 0.05)])
@pytest.mark.filterwarnings("ignore::Warning:(optuna|cma)")
def test_methods_of_further_libraries_find_the_same_within_limits(oscillator, method, module, near):
    needs(module)
    given = "rms(rail.displacement.rate)", {STIFFNESS: (20.0, 200.0), DAMPING: (0.5, 10.0)}
    within = {"outputs": {"reach": "max(rail.displacement)"}, "limits": {"reach": (None, 0.12)}}
    known = oscillator.optimise(*given, **within)
    found = oscillator.optimise(*given, **within, method=method, iterations=25, accuracy=1e-7)
    assert found.kept
    assert known.objective * (1 - 1e-4) <= found.objective <= known.objective * (1 + near)


@pytest.mark.filterwarnings("ignore::Warning:cma")
def test_cma_searches_a_single_parameter(oscillator):
    needs("cma")
    given = "peak(rail.displacement)", {DAMPING: (1.0, 4.0)}
    found = oscillator.optimise(*given, method="CMA-ES", iterations=10)
    assert found.values[DAMPING] == pytest.approx(4.0, rel=1e-2)


def test_cobyla_does_not_end_in_the_first_corner(oscillator):
    """The speed of a damped block is least within the bounds, below that at the stiffest spring."""
    given = "rms(rail.displacement.rate)", {STIFFNESS: (20.0, 200.0)}
    known = oscillator.optimise(*given, method="differential-evolution")
    found = oscillator.optimise(*given, method="COBYLA")
    assert found.objective == pytest.approx(known.objective, rel=1e-3)


@pytest.mark.parametrize(("method", "package", "module"), [("CMA-ES", "pycma", "cma"), ("TPE", "Optuna", "optuna")])
def test_a_missing_library_is_told_before_anything_runs(oscillator, monkeypatch, method, package, module):
    monkeypatch.setitem(sys.modules, module, None)
    message = rf"the method `{method}` needs {package}: pip install 'nivel\[search\]'"
    with pytest.raises(ModelError, match=message):
        oscillator.optimise("max(rail.displacement)", {STIFFNESS: (1, 2)}, method=method)


@pytest.mark.parametrize(
    ("heading", "message"),
    [
        ("time [s],rail.displacement [deg]", "`1 deg` is an angle .rad.; the number is in m"),
        ("time [kg],rail.displacement [mm]", "bench.csv:1:1: time: `1 kg` is a mass"),
    ],
)
def test_measurements_in_another_unit_are_refused(oscillator, tmp_path, heading, message):
    path = tmp_path / "bench.csv"
    path.write_text(f"{heading}\n0,1\n0.1,1\n0.2,1\n")
    with pytest.raises(ModelError, match=message):
        oscillator.identify(path, {STIFFNESS: (20, 200)})


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda m: m.optimise("maxx(rail.displacement)", {STIFFNESS: (1, 2)}), "did you mean `max`"),
        (lambda m: m.optimise("max(rail.displacement)", {STIFFNESS: (2, 1)}), "bounds were expected"),
        (lambda m: m.optimise("max(rail.displacement)", {}), "nothing varies"),
        (lambda m: m.optimise(result_stiffness, {STIFFNESS: (1, 2)}, exact_slopes=True), "not of functions"),
        (lambda m: m.optimise("block.position", {STIFFNESS: (1, 2)}), "has 3 numbers; write one"),
        (lambda m: m.optimise("block.position.x at soon", {STIFFNESS: (1, 2)}), "a time was expected after `at`"),
        (lambda m: m.optimise("max(rail.displacement)", {STIFFNESS: (1, 2)}, method="SLQP"), "did you mean `SLSQP`"),
        (
            lambda m: m.optimise("max(rail.displacement)", {STIFFNESS: ("1 kg", "2 kg")}),
            "a stiffness .N/m. was expected",
        ),
        (lambda m: m.optimise("max(rail.displacement)", {STIFFNESS: (1, 2)}, starts=0), "starts of at least 1"),
        (lambda m: m.optimise("time(lift)", {STIFFNESS: (1, 2)}), "the event `lift` is not known"),
        (lambda m: m.optimise("rail.displacement at 9 s", {STIFFNESS: (1, 2)}), "its time is outside the run"),
        (lambda m: m.optimise("rail.displacement", {STIFFNESS: (1, 2)}, limits={"objective": (2, 1)}), "2 and 1"),
        (lambda m: m.optimise("rail.displacement", {STIFFNESS: (1, 2)}, limits={"objective": (np.nan, 1)}), "nan"),
        (lambda m: m.optimise("rail.displacement", {STIFFNESS: (1, 2)}, limits={"objective": (None, "1 m")}), "in SI"),
        (
            lambda m: m.optimise("max(rail.displacement)", {STIFFNESS: (1, 2)}, limits={"reach": (None, 1)}),
            "the output `reach` is not known",
        ),
        (
            lambda m: m.identify({"rail.displacement": ([0.1, 0.2], [1.0])}, {STIFFNESS: (1, 2)}),
            "as many numbers as times",
        ),
        (lambda m: m.identify({"rail.displacement": ([0.1], [1.0])}, {STIFFNESS: (1, 2)}), "do not determine"),
        (
            lambda m: m.identify({"rail.displacement": ([0.1, 5.0], [1.0, 1.0])}, {STIFFNESS: (1, 2)}),
            "no start has results at all measurements: the run ends before",
        ),
        (
            lambda m: m.identify({"rail.displacement": ([-1.0, 0.1], [1.0, 1.0])}, {STIFFNESS: (1, 2)}),
            "begins after them: they last from -1 to 0.1 s",
        ),
        (lambda m: m.identify({"rail.displacement": ([0.1, 0.2], [1, np.inf])}, {STIFFNESS: (1, 2)}), "not finite"),
        (
            lambda m: m.identify(
                {"rail.displacement": ([0.1, 0.2], [1, 1])},
                {STIFFNESS: (1, 2)},
                deviations={"rail.displacement": "1 mm"},
            ),
            "a number above zero in SI units",
        ),
        (lambda m: m.identify(Path(__file__).parent / "nothing.csv", {STIFFNESS: (1, 2)}), "nothing.csv"),
    ],
)
def test_faults_say_what_to_write(oscillator, call, message):
    with pytest.raises(ModelError, match=message):
        call(oscillator)
