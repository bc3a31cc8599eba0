"""The budget of a machine: what ticks cost, by method and by part."""

import numpy as np
import pytest

import cart
from nivel.integrate.paced import BIN_WIDTH, BINS, COMPUTING, FIRST_BIN, count_into
from nivel.live.budget import costs
from nivel.live.shared import Sizes, bytes_of, live_in
from nivel.live.timing import PERCENTS, in_words, timing_of


def test_percentiles_are_those_of_the_durations_within_a_bin():
    durations = np.exp(np.random.default_rng(1).normal(np.log(5e4), 0.7, 20_000))
    live = live_in(bytearray(bytes_of(Sizes(1, 1))), Sizes(1, 1))
    live.histogram[: 2 * BINS] = 0
    for each in durations:
        count_into.py_func(live.histogram, COMPUTING, float(each))
    found = np.array(timing_of(live).computing[:4])
    want = 1e-9 * np.quantile(durations, np.array(PERCENTS) / 100.0, method="inverted_cdf")
    assert np.all(found >= want)
    assert np.all(found <= want * np.exp(BIN_WIDTH) * (1.0 + 1e-9))
    assert durations.min() > FIRST_BIN


def test_the_cost_of_methods_is_measured_and_shared_out():
    found = {
        each.integrator: each for each in costs(cart.machine().record, {}, None, ["rk4", "dopri5"], compiled_only=False)
    }
    rk4 = found["rk4"]
    assert rk4.timing.ticks == 2000
    assert 1e-7 < rk4.timing.computing[0] < 1e-3
    assert sum(rk4.parts.values()) == pytest.approx(1.0)
    assert all(share >= 0.0 for share in rk4.parts.values())
    assert "chooses its steps" in found["dopri5"].problem
    assert any("would hold" in line or "it would hold" in line for line in in_words(rk4.timing))
