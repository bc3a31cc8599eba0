"""Statistics of studies: indices, surfaces, shares and capabilities are their closed forms, and the page has them."""

import json

import numpy as np
import pytest
import xarray
from scipy import stats

from nivel.analysis.sweep.variants import draw
from nivel.machine.study.parameter import Uniform
from nivel.report.study_page import study_html
from nivel.results.study_statistics import Share, Table, capability, effects, share_within, sobol_indices, surface
from nivel.results.trust import Trust

SAMPLES = 2048
PARAMETERS = {name: Uniform(type="uniform", low=-np.pi, high=np.pi) for name in ("a", "b", "c")}


def ishigami(a, b, c):
    """Ishigami & Homma 1990."""
    return np.sin(a) + 7 * np.sin(b) ** 2 + 0.1 * c**4 * np.sin(a)


def study(design="sobol-indices", samples=SAMPLES, lost=(), **outputs):
    drawn = draw(PARAMETERS, design, samples, 0)
    x = {name: np.array(values) for name, (_, values) in drawn.coordinates.items()}
    outcome = np.array(["failed" if k in lost else "done" for k in range(len(drawn.values))])
    data = {"outcome": ("variant", outcome), "reason": ("variant", np.where(outcome == "done", "", "it broke"))}
    for name, (function, limits) in outputs.items():
        values = np.where(outcome == "done", function(*x.values()), np.nan)
        data[name] = ("variant", values, {"units": "N", **limits})
    attributes = {
        "machine": "ishigami",
        "outcomes": "",
        "analysis": "run",
        "design": design,
        "samples": samples,
        "seed": 0,
        "trust": Trust("amber", "done").to_json(),
        "parameters": json.dumps(list(x)),
        "outputs": json.dumps(list(outputs)),
    }
    coords = {name: ("variant", values, {"units": "m"}) for name, values in x.items()}
    return xarray.Dataset(data, coords=coords, attrs=attributes)


def test_sobol_indices_are_those_of_scipy_and_near_the_closed_form():
    table = Table.of(study(y=(ishigami, {})))
    found = sobol_indices(table, "y")
    blocks = table.outputs["y"].reshape(5, SAMPLES)
    reference = stats.sobol_indices(func={"f_A": blocks[:1], "f_B": blocks[1:2], "f_AB": blocks[2:, None]}, n=SAMPLES)
    np.testing.assert_allclose(found.first, reference.first_order, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(found.total, reference.total_order, rtol=1e-9, atol=1e-12)
    # V = 1/2 + a²/8 + b π⁴/5 + b² π⁸/18 with a = 7, b = 0.1
    variance = 0.5 + 49 / 8 + 0.1 * np.pi**4 / 5 + 0.01 * np.pi**8 / 18
    first = np.array([0.5 * (1 + 0.1 * np.pi**4 / 5) ** 2, 49 / 8, 0.0]) / variance
    total = first + np.array([1, 0, 1]) * 0.01 * np.pi**8 * (1 / 18 - 1 / 50) / variance
    assert (np.abs(found.first - first) < 3 * found.first_error + 1e-3).all()
    assert (np.abs(found.total - total) < 3 * found.total_error + 1e-3).all()


def test_base_samples_with_a_variant_that_failed_are_left_out_of_the_indices():
    lost = sobol_indices(Table.of(study(samples=256, lost=(3, 256 + 5, 2 * 256 + 3), y=(ishigami, {}))), "y")
    assert (lost.used, lost.samples) == (254, 256)
    assert np.isfinite(lost.first).all()


def test_a_quadratic_output_is_its_response_surface():
    """f = 2 + a b - c²: at the medians, near zero, only c has an effect of its own."""
    table = Table.of(study("latin-hypercube", 64, y=(lambda a, b, c: 2 + a * b - c**2 + 3 * c, {})))
    found = surface(table, "y")
    assert found.predicted == pytest.approx(1.0, abs=1e-12)
    points = np.random.default_rng(0).uniform(-1, 1, (5, 3))
    a, b, c = (0.5 * (found.high + found.low) + 0.5 * (found.high - found.low) * points).T
    np.testing.assert_allclose(found.at(points), 2 + a * b - c**2 + 3 * c, rtol=1e-10)
    (largest, *_) = effects(table, "y", found)
    assert largest.parameter == "c"
    assert largest.at_high - largest.at_low == pytest.approx(
        3 * (largest.high - largest.low) - (largest.high**2 - largest.low**2), abs=0.2
    )


def test_noise_is_not_predicted_by_its_response_surface():
    """Ten coefficients explain a part of twenty random numbers, and predict none."""
    noise = np.random.default_rng(1).normal(size=20)
    found = surface(Table.of(study("latin-hypercube", 20, y=(lambda *_: noise, {}))), "y")
    assert found.determined > 0.2
    assert found.predicted < 0.1


def test_shares_have_the_interval_of_wilson():
    reference = stats.binomtest(37, 50).proportion_ci(0.95, "wilson")
    assert Share(37, 50).interval == pytest.approx((reference.low, reference.high), rel=1e-12)
    assert Share(0, 50).interval[0] == 0.0
    assert Share(50, 50).interval[1] == 1.0


def test_the_yield_counts_what_failed_as_outside():
    limits = {"at_least": -1.0, "at_most": 2.0}
    table = Table.of(
        study("latin-hypercube", 100, lost=(0, 1), y=(lambda a, b, c: a, limits), z=(lambda a, b, c: b, {}))
    )
    y = table.outputs["y"][2:]
    assert share_within(table) == Share(int(np.sum((y >= -1) & (y <= 2))), 100)
    mean, deviation = y.mean(), y.std(ddof=1)
    assert capability(table, "y") == pytest.approx(min(mean + 1, 2 - mean) / (3 * deviation), rel=1e-12)


def test_the_page_has_every_part_and_needs_no_network():
    page = study_html(study(samples=64, lost=(7,), y=(ishigami, {"at_most": 8.0})))
    data = json.loads(page.split('id="data">')[1].split("</script>")[0])
    assert [each["name"] for each in data["parameters"]] == ["a", "b", "c"]
    (output,) = data["outputs"]
    assert len(output["values"]) == 64 * 5 - 1
    assert output["sobol"]["used"] == 63
    assert output["surface"]["parameters"] == ["a", "b", "c"]
    for part in ("parallel", "tornado", "sobol", "surface", "matrix", "histogram", "Yield", "it broke"):
        assert part in page
    assert "http" not in page.replace("http://www.w3.org/2000/svg", "").replace("http-equiv", "")
