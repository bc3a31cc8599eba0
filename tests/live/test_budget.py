"""The budget of a machine: what ticks cost, by method and by part."""

from itertools import combinations, product

import numpy as np
import pytest
from click.testing import CliRunner

import cart
from nivel import Input
from nivel.analysis.progress.log import Listener
from nivel.cli.budget import budget
from nivel.files.reader import parse_machine
from nivel.integrate.loop.paced import BIN_WIDTH, BINS, COMPUTING, FIRST_BIN, LONGEST, count_into
from nivel.live.budget import Cost, Held, costs, ends, swept
from nivel.live.shared import Sizes, bytes_of, live_in
from nivel.live.timing import PERCENTS, Timing, in_a_sentence, timing_of


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
    assert rk4.timing.computing[0] > 0.0
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


def test_a_budget_that_takes_minutes_says_which_method_it_measures():
    heard = []
    listener = Listener(lambda text, _total: heard.append(text))
    assert len([*costs(cart.machine().record, {}, None, ["rk4", "euler"], compiled_only=False, listener=listener)]) == 2
    assert [each for each in heard if each.startswith("measuring")] == ["measuring rk4", "measuring euler"]


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


def test_inputs_are_held_at_both_ends_alone_and_levers_in_all_combinations():
    """The lever at -1 and 1; the brake, which rests at 1, at 0 and 2. Three levers also in their eight combinations."""
    assert ends(cart.machine().record.inputs) == [{"lever": -1.0}, {"lever": 1.0}, {"brake": 0.0}, {"brake": 2.0}]
    levers = [Input(name=name, range=(-1.0, 2.0)) for name in "abc"]
    held = ends(levers)
    assert held[:6] == [{name: end} for name in "abc" for end in (-1.0, 2.0)]
    assert {tuple(each.values()) for each in held[6:]} == set(product((-1.0, 2.0), repeat=3))


@pytest.mark.parametrize("count", [5, 7, 8, 12])
def test_of_many_levers_any_two_are_held_in_all_their_combinations(count):
    """With far fewer rows than 2ⁿ."""
    levers = [Input(name=f"l{k}", range=(-1.0, 1.0)) for k in range(count)]
    rows = [each for each in ends(levers) if len(each) > 1]
    assert len(rows) <= 16
    for one, other in combinations(range(count), 2):
        assert {(each[f"l{one}"], each[f"l{other}"]) for each in rows} == set(product((-1.0, 1.0), repeat=2))


def test_a_lever_is_held_until_the_machine_is_at_its_end_and_what_fails_there_is_told(tmp_path):
    """At 8 m a square root ends the run: m v̇ = F - d v from rest, with the lever at 1 after 0.25 s. Levers that go to and fro stay far
    from it. With the brake alone the machine stands still, and is left after three seconds."""
    text = cart.CART.replace("effort: 20.0*lever.value", "effort: 20.0*lever.value + 0*sqrt(8 - rail.displacement)")
    (found,) = costs(parse_machine(text), {}, None, ["rk4"], compiled_only=False)
    assert found.note == ""
    assert [each.values for each in found.held] == ends(cart.machine().record.inputs)
    assert found.combinations == 4
    left, right, *brake = found.held
    assert np.isnan(left.ended)
    assert left.timing.ticks == 15_000
    assert [each.timing.ticks for each in brake] == [3000, 3000]
    t = np.arange(0.0, 3.0, 1e-4)
    v = np.zeros_like(t)
    for k in range(len(t) - 1):
        v[k + 1] = v[k] + 1e-4 * (cart.FORCE * min(4.0 * t[k], 1.0) - cart.DAMPING * v[k]) / cart.MASS
    assert right.ended == pytest.approx(t[np.argmax(np.cumsum(v) * 1e-4 > 8.0)], abs=5e-3)
    assert found.rate_held == pytest.approx(1.0 / max(found.timing.computing[3], found.worst.cost))
    path = tmp_path / "cart.yaml"
    path.write_text(text)
    said = CliRunner().invoke(budget, [str(path), "--integrators", "rk4", "--quiet"]).output
    assert f"  with lever at 1 the run ends at {right.ended:.4g} s" in said
    assert "inputs held at their ends (4 combinations): dearest with " in said


def test_the_dearest_inputs_decide_what_rate_a_machine_holds():
    """A median that is cheap, and an end at which ticks cost eight times as much."""

    def timing(high):
        return Timing(1000, 1e-3, (2e-5, 5e-5, 8e-5, high, 2.0 * high), (0.0,) * 5, 0, 0, 0.0)

    cheap, dear = Held({"lever": -1.0}, timing(1.0e-4)), Held({"lever": 1.0, "other": 0.5}, timing(8.0e-4))
    cost = Cost("rk4", timing(1.1e-4), {}, held=[cheap, dear], combinations=2)
    assert cost.worst is dear
    assert str(cost.worst) == "lever at 1, other at 0.5"
    assert cost.rate_held == pytest.approx(1250.0)
    assert Cost("rk4", timing(1.0e-4), {}).rate_held == pytest.approx(1e4)
