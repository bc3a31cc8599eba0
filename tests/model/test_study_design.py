"""Designs of studies: drawn values have the distribution that is asked for, and the same seed draws the same."""

from itertools import combinations

import numpy as np
import pytest
from scipy import stats

from needing import needs
from nivel.analysis.sweep.variants import draw, quantiles
from nivel.errors import ModelError
from nivel.machine.study.parameter import Normal, Range, Tolerance, Triangular, Uniform, Values
from nivel.results.study_statistics import Table, surface

SHARES = np.array([0.001, 0.1, 0.25, 0.5, 0.8, 0.999])


@pytest.mark.parametrize(
    ("parameter", "reference"),
    [
        (Uniform(type="uniform", low="10 cm", high="30 cm"), stats.uniform(0.1, 0.2)),
        (Range(type="range", low=1, high=100, spacing="logarithmic"), stats.loguniform(1, 100)),
        (Normal(type="normal", mean=5, deviation=0.1), stats.norm(5, 0.1)),
        (Normal(type="normal", mean=5, deviation=2, low=4), stats.truncnorm(-0.5, np.inf, 5, 2)),
        (Triangular(type="triangular", low=1, high=5, peak=2), stats.triang(0.25, 1, 4)),
        (Tolerance(type="tolerance", nominal=5, tolerance=[1, 2]), stats.truncnorm(-3, 3, 5.5, 0.5)),
        (Tolerance(type="tolerance", nominal=5, tolerance=1, distribution="uniform"), stats.uniform(4, 2)),
        (Tolerance(type="tolerance", nominal=5, tolerance=1, distribution="triangular"), stats.triang(0.5, 4, 2)),
    ],
    ids=["uniform", "logarithmic", "normal", "bounded", "triangular", "tolerance", "even", "peaked"],
)
def test_quantiles_are_those_of_scipy(parameter, reference):
    np.testing.assert_allclose(quantiles(parameter, SHARES), reference.ppf(SHARES), rtol=1e-12)


def test_values_of_a_list_have_equal_parts_of_the_shares():
    assert quantiles(Values(values=("a", "b", "c", "d")), np.array([0.0, 0.3, 0.5, 0.99, 1.0])) == list("abcdd")


def test_one_sample_lies_in_each_part_of_a_latin_hypercube():
    drawn = draw({"a": Uniform(type="uniform", low=0, high=1), "b": Values(values=(1, 2))}, "latin-hypercube", 8, 1)
    assert sorted(int(8 * each["a"]) for each in drawn.values) == list(range(8))
    assert sorted(each["b"] for each in drawn.values) == [1, 1, 1, 1, 2, 2, 2, 2]


@pytest.mark.parametrize("design", ["random", "latin-hypercube", "sobol", "sobol-indices"])
def test_the_seed_decides_what_is_drawn(design):
    parameters = {"a": Uniform(type="uniform", low=0, high=1), "b": Normal(type="normal", mean=0, deviation=1)}
    first, again, other = (draw(parameters, design, 16, seed).values for seed in (3, 3, 4))
    assert first == again
    assert first != other


def test_samples_for_sobol_indices_differ_in_one_column():
    parameters = {name: Uniform(type="uniform", low=0, high=1) for name in "abc"}
    drawn = np.array([list(each.values()) for each in draw(parameters, "sobol-indices", 8, 0).values])
    first, second, *mixed = drawn.reshape(5, 8, 3)
    for k, each in enumerate(mixed):
        np.testing.assert_array_equal(each[:, k], second[:, k])
        np.testing.assert_array_equal(np.delete(each, k, 1), np.delete(first, k, 1))


def test_a_grid_has_every_value_with_every_other():
    drawn = draw({"a": Range(type="range", low=1, high=3, count=3), "b": Values(values=("x", "y"))}, "grid", None, 0)
    assert drawn.shape == (3, 2)
    assert [tuple(each.values()) for each in drawn.values] == [(a, b) for a in (1.0, 2.0, 3.0) for b in "xy"]


def test_too_many_variants_are_refused_before_they_are_made():
    parameters = {name: Range(type="range", low=0, high=1, count=1000) for name in "abcdef"}
    with pytest.raises(ModelError, match="at most 1000000"):
        draw(parameters, "grid", None, 0)


def planned(design, count):
    """Levels (variants, count) between -1 and 1."""
    given = {f"p{k}": Uniform(type="uniform", low=-1, high=1) for k in range(count)}
    return np.array([[*each.values()] for each in draw(given, design, None, 0).values])


@pytest.mark.parametrize(("count", "runs"), [(2, 4), (3, 8), (4, 8), (5, 16), (6, 16), (8, 16), (9, 32)])
def test_main_effects_of_a_fraction_of_all_corners_are_clear_of_effects_of_pairs(count, runs):
    """Columns of resolution IV are orthogonal to each other and to the products of two others; 2^(8-4) is the largest in 16 runs."""
    needs("pyDOE3")
    levels = planned("fractional-factorial", count)
    assert len(levels) == runs
    np.testing.assert_array_equal(np.abs(levels), 1.0)
    np.testing.assert_array_equal(levels.T @ levels, runs * np.eye(count))
    for a, b in combinations(range(count), 2):
        np.testing.assert_array_equal(levels.T @ (levels[:, a] * levels[:, b]), 0.0)


@pytest.mark.parametrize(("count", "runs"), [(3, 13), (4, 25), (5, 41)])
def test_designs_of_box_and_behnken_are_middles_of_edges(count, runs):
    """4 for each pair of parameters, the others in the middle, and the middle (Box & Behnken 1960)."""
    needs("pyDOE3")
    levels = planned("box-behnken", count)
    assert len(levels) == runs
    assert {*np.abs(levels).sum(axis=1)} == {0.0, 2.0}
    assert {*levels.ravel()} == {-1.0, 0.0, 1.0}


@pytest.mark.parametrize("count", [2, 3, 4])
def test_a_central_composite_design_is_rotatable_within_the_bounds(count):
    """Σ x⁴ = 3 Σ x² y² makes the variance of the fit one of the distance from the middle alone (Box & Hunter 1957)."""
    needs("pyDOE3")
    levels = planned("central-composite", count)
    assert len(levels) == 2**count + 2 * count + 1
    assert np.abs(levels).max() == 1.0
    squares = levels**2
    assert np.sum(squares[:, 0] ** 2) == pytest.approx(3.0 * np.sum(squares[:, 0] * squares[:, 1]), rel=1e-12)


@pytest.mark.parametrize(("design", "count"), [("box-behnken", 3), ("central-composite", 3)])
def test_the_response_surface_of_a_planned_design_is_the_quadratic_that_was_there(design, count):
    needs("pyDOE3")
    x = planned(design, count)
    y = 2.0 + x @ [1.0, -3.0, 0.5] + 0.7 * x[:, 0] ** 2 - 1.5 * x[:, 0] * x[:, 1]
    done = np.ones(len(x), dtype=bool)
    names = {f"p{k}": x[:, k] for k in range(count)}
    table = Table(names, {"y": y}, {}, {"y": (None, None)}, done, ("done",) * len(x), ("",) * len(x))
    found = surface(table, "y")
    assert found.predicted == pytest.approx(1.0, abs=1e-10)
    random = np.random.default_rng(0).uniform(-1.0, 1.0, (20, 3))
    wanted = 2.0 + random @ [1.0, -3.0, 0.5] + 0.7 * random[:, 0] ** 2 - 1.5 * random[:, 0] * random[:, 1]
    assert found.at(random) == pytest.approx(wanted, abs=1e-10)


@pytest.mark.parametrize(
    ("design", "given", "message"),
    [
        ("box-behnken", {"a": Uniform(type="uniform", low=0, high=1)}, "needs 3 parameters"),
        ("fractional-factorial", {"a": Normal(type="normal", mean=0, deviation=1)}, "two bounds"),
    ],
)
def test_planned_designs_need_bounds_and_enough_parameters(design, given, message):
    needs("pyDOE3")
    with pytest.raises(ModelError, match=message):
        draw(given, design, None, 0)
