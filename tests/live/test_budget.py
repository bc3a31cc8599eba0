"""The budget of a machine: what ticks cost, by method and by part."""

import numpy as np
import pytest

import cart
from nivel.files.reader import parse_machine
from nivel.integrate.loop.paced import BIN_WIDTH, BINS, COMPUTING, FIRST_BIN, LONGEST, count_into
from nivel.live.budget import costs, swept
from nivel.live.shared import Sizes, bytes_of, live_in
from nivel.live.timing import PERCENTS, in_a_sentence, timing_of


def test_percentiles_are_those_of_the_durations_within_a_bin():
    durations = np.exp(np.random.default_rng(1).normal(np.log(5e4), 0.7, 20_000))
    live = live_in(bytearray(bytes_of(Sizes(1, 1))), Sizes(1, 1))
    live.histogram[: 2 * BINS] = 0
    live.control[LONGEST] = np.iinfo(np.int64).max
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
    assert set(rk4.parts) == {
        "bodies",
        "constraints",
        "forces, control and inputs",
        "circuit",
        "solve",
        "output",
        "method",
    }
    assert rk4.parts["circuit"] == 0.0
    assert rk4.off < 1e-9  # m: steps of half the length move the cart as far
    assert "chooses its steps" in found["dopri5"].note
    said = in_a_sentence("cart", "rk4", rk4.timing, rk4.parts)
    assert said.startswith("cart at 1 kHz costs ")
    assert said.endswith(f"it would hold {1e-3 / rk4.timing.computing[3]:.3g} kHz")


def test_a_method_that_moved_levers_overthrow_is_not_called_cheap():
    """A spring so stiff that steps of the explicit Euler method are too long for it, and that only a moved lever excites."""
    stiff = parse_machine(
        cart.CART.replace("forces:", "forces:\n  bed: {type: motor, coordinate: rail, effort: -1e7*rail.displacement}")
    )
    (alone,) = costs(stiff, {}, None, ["euler"], compiled_only=False)
    assert alone.note.startswith("with moved levers the run ends at")


def test_levers_are_swept_within_their_ranges_and_rates():
    """The lever reaches both ends of its range; the brake, which stays where it is left, rests."""
    inputs = cart.machine().record.inputs
    values = swept(inputs, 2000, 1e-3)
    assert (values[:, 0].min(), values[:, 0].max()) == (-1.0, 1.0)
    assert np.abs(np.diff(values[:, 0], prepend=0.0)).max() <= 4e-3 * (1.0 + 1e-12)
    assert np.all(values[:, 1] == 1.0)
