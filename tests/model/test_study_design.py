"""Designs of studies: drawn values have the distribution that is asked for, and the same seed draws the same."""

import numpy as np
import pytest
from scipy import stats

from nivel.analysis.sweep.variants import draw, quantiles
from nivel.errors import ModelError
from nivel.machine.study import Normal, Range, Tolerance, Triangular, Uniform, Values

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
