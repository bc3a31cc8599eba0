"""Variants in lanes: each has the motion that it has alone, and what its lane cannot do is done singly."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.progress.log import Listener
from nivel.analysis.sweep.patched import PatchedRuns, UnsuitedError, learn, read_values
from nivel.analysis.sweep.variant_runs import WORTH_COMPILING, LaneRuns
from nivel.analysis.sweep.variants import rows_of
from nivel.files import parse_machine
from nivel.native.processor import lane_count

pytestmark = pytest.mark.compiles
EXAMPLES = Path(__file__).parents[2] / "examples"
LANES = lane_count()
# machine, what varies, between which shares of its own value
MACHINES = {
    "mechanisms/slider-crank.yaml": ("bodies.rod.mass", 0.7, 1.4),
    "mechanisms/four-bar.yaml": ("bodies.crank.mass", 0.8, 1.2),
    "mechanisms/rssr.yaml": ("gravity.2", 0.5, 1.5),
    "mechanisms/simple-pendulum.yaml": ("gravity.2", 0.5, 1.5),
    "control/cart-pole.yaml": ("bodies.cart.mass", 0.9, 1.2),
    "control/robot-arm.yaml": ("bodies.hand.mass", 0.5, 2.0),
}
CART = """
format: 1
bodies: {cart: {mass: 2, inertia: [1, 1, 1]}}
joints:
  rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 0.1}}
forces:
  spring: {type: joint-spring-damper, coordinate: rail, stiffness: 50}
  push: {type: force, body: cart, vector: [8, 0, 0]}
simulation: {duration: 1 s, step: 1 ms, integrator: rk4, output_interval: 10 ms}
"""


def runs_of(machine, rows):
    runs = PatchedRuns(learn(machine, rows))
    return runs, LaneRuns(runs, WORTH_COMPILING, Listener())


@pytest.mark.parametrize("file", MACHINES, ids=lambda file: Path(file).stem)
@pytest.mark.parametrize("integrator", ["rk4", pytest.param("heun", marks=pytest.mark.full)])
def test_each_lane_has_the_motion_of_its_machine_alone(file, integrator):
    path, low, high = MACHINES[file]
    machine = nivel.load(EXAMPLES / file)
    machine = machine.with_settings({"duration": 0.3, "integrator": integrator, "step": 1e-3, "output_interval": 1e-2})
    rows = rows_of({path: np.linspace(low, high, 2 * LANES) * machine[path]})
    runs, lanes = runs_of(machine, rows)
    for first in (0, LANES):
        some = rows[first : first + LANES]
        found = lanes.run([read_values(row) for row in some])
        for row, result in zip(some, found, strict=True):
            alone = runs.result(runs.run(read_values(row)))
            assert result is not None
            np.testing.assert_array_equal(result.time, alone.time)
            for name in alone.variables:
                wanted = alone.array(name)
                np.testing.assert_allclose(
                    result.array(name), wanted, rtol=0.0, atol=1e-12 * np.abs(wanted).max(initial=1e-300), err_msg=name
                )


def test_a_variant_that_fails_fails_alone_and_the_share_in_lanes_is_told():
    """x = F/k (1 - cos ωt) + x₀ cos ωt; a spring too stiff for the step lets the numbers grow until they are none."""
    machine, count = nivel.Machine.from_record(parse_machine(CART)), 8 * LANES
    stiffness, failed = np.linspace(20.0, 200.0, count), np.arange(count) == LANES + 1
    runs_of(machine, rows_of({"forces.spring.stiffness": stiffness[:2]}))  # compiles what is needed
    stiffness[failed] = 1e13
    found = machine.batch({"forces.spring.stiffness": stiffness}, save="rail.displacement", threads=2)
    assert (found.outcome.values == np.where(failed, "failed", "done")).all()
    assert found.attrs["in_lanes"] == pytest.approx(1.0 - 1.0 / count)
    assert found.attrs["not_in_lanes"] == ""
    k, t = stiffness[~failed, None], found.time.values
    cosine = np.cos(np.sqrt(k / 2.0) * t)
    np.testing.assert_allclose(
        found["rail.displacement"].values[~failed], 8.0 / k * (1.0 - cosine) + 0.1 * cosine, atol=1e-8
    )


def test_a_lane_that_ends_by_an_event_is_run_singly():
    """½ (F/m) t² = 1 - x₀."""
    text = CART.replace("  spring: {type: joint-spring-damper, coordinate: rail, stiffness: 50}\n", "")
    machine = nivel.Machine.from_record(
        parse_machine(text + "events: {far: {when: rail.displacement - 1, direction: rising, stop: true}}\n")
    )
    masses = np.linspace(2.0, 40.0, 40)
    runs_of(machine, rows_of({"bodies.cart.mass": masses[:2]}))
    found = machine.batch({"bodies.cart.mass": masses}, save="rail.displacement")
    expected = np.sqrt(2.0 * 0.9 * masses / 8.0)
    np.testing.assert_allclose(found.end_time.values, np.minimum(expected, 1.0), rtol=1e-9)
    assert (found.outcome.values == np.where(expected < 1.0, "stopped", "done")).all()
    assert 0.0 < found.attrs["in_lanes"] < 1.0


def test_a_study_in_lanes_has_the_numbers_of_a_batch(tmp_path):
    (tmp_path / "cart.yaml").write_text(CART)
    (tmp_path / "study.yaml").write_text(
        """
format: 1
machine: cart.yaml
parameters: {bodies.cart.mass: {type: range, from: 1 kg, to: 3 kg, count: 26}}
save: [rail.displacement]
judge: false
"""
    )
    machine = nivel.load(tmp_path / "cart.yaml")
    values = {"bodies.cart.mass": np.linspace(1.0, 3.0, 26)}
    runs_of(machine, rows_of({path: each[:2] for path, each in values.items()}))
    studied = nivel.load_study(tmp_path / "study.yaml").sweep(workers=2)
    batch = machine.batch(values, save="rail.displacement")
    wanted = batch["rail.displacement"].values
    np.testing.assert_allclose(studied["rail.displacement"].values, wanted, rtol=0.0, atol=1e-14)
    assert studied.attrs["in_lanes"] > 0.9
    assert batch.attrs["in_lanes"] == 1.0


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ({"integrator": "am2"}, "explicit"),
        ({"integrator": "dopri5"}, "chosen"),
        ({"coordinates": "absolute"}, "relative"),
    ],
)
def test_what_cannot_go_in_lanes_says_why(given, why):
    machine = nivel.Machine.from_record(parse_machine(CART)).with_settings(given)
    with pytest.raises(UnsuitedError, match=why):
        runs_of(machine, rows_of({"bodies.cart.mass": [1.0, 2.0]}))


def test_few_and_short_runs_are_not_worth_compiling(monkeypatch):
    machine = nivel.Machine.from_record(parse_machine(CART))
    runs = PatchedRuns(learn(machine, rows_of({"bodies.cart.mass": [1.0, 2.0]})))
    monkeypatch.setattr("nivel.analysis.sweep.variant_runs.missing", list)
    with pytest.raises(UnsuitedError, match="worth compiling"):
        LaneRuns(runs, 0.5 * WORTH_COMPILING, Listener())
