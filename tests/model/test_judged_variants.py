"""Variants that are patched and judged: their numbers and trust reports are those of variants that are prepared."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.sweep.outputs import Task
from nivel.analysis.sweep.patched import WORTH_FORMULAS, UnsuitedError, learn, sample_of
from nivel.analysis.sweep.variant import run_variant
from nivel.analysis.sweep.variant_runs import JudgedRuns, formulas_for
from nivel.files import parse_machine

EXAMPLES = Path(__file__).parents[2] / "examples"
VARIED = {
    "mechanisms/slider-crank.yaml": "bodies.rod.mass",
    "mechanisms/four-bar.yaml": "gravity.1",
    "control/cart-pole.yaml": "bodies.cart.mass",
    "optimisation/sliding-block.yaml": "parameters.friction",
}
SPRING = """
format: 1
bodies: {block: {mass: 1, inertia: [1, 1, 1]}}
joints:
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 10 cm}}
forces:
  spring: {type: joint-spring-damper, coordinate: rail.displacement, stiffness: 100 N/m}
  pull: {type: motor, coordinate: rail, effort: 0 N}
events: {middle: {when: rail.displacement, direction: falling, stop: true}}
simulation: {duration: 0.4, step: 1 ms}
"""


def spring(**settings):
    return nivel.Machine.from_record(parse_machine(SPRING)).with_settings(settings)


def rows_of(path, values):
    return [{path: float(value)} for value in values]


def both(machine, rows, which):
    """Runs of some of the variants: patched, and prepared."""
    patched = Task(machine, sample=sample_of(rows))
    assert learn(machine, patched.sample, judged=True)
    prepared = Task(machine)
    return [[run_variant(task, rows[k]) for k in which] for task in (patched, prepared)]


def check_alike(patched, prepared):
    for a, b in zip(patched, prepared, strict=True):
        for fact in ("outcome", "reason", "verdict", "verified", "headline"):
            assert getattr(a, fact) == getattr(b, fact)
        assert a.end_time == pytest.approx(b.end_time, rel=1e-12)
        for name, saved in b.saved.items():
            size = np.abs(saved.values).max()
            np.testing.assert_allclose(a.saved[name].values, saved.values, rtol=0.0, atol=1e-9 * size)


@pytest.mark.parametrize("file", VARIED, ids=lambda file: Path(file).stem)
def test_patched_variants_have_the_trust_reports_of_prepared_ones(file):
    machine, path = nivel.load(EXAMPLES / file).with_settings({"duration": 0.2}), VARIED[file]
    value = machine.parameters[path.partition(".")[2]] if path.startswith("parameters.") else machine[path]
    patched, prepared = both(machine, rows_of(path, np.linspace(0.8, 1.2, 30) * value), (0, 17))
    check_alike(patched, prepared)
    assert np.any(next(iter(patched[0].saved.values())).values != next(iter(patched[1].saved.values())).values)


def test_each_variant_is_judged_by_its_own_numbers():
    """Of stiff springs the steps lose energy; softer ones end where the block passes the middle, t = π/2ω."""
    machine = spring(integrator="rk4", duration="30 ms")
    rows = rows_of("spring.stiffness", [*np.linspace(100.0, 4e5, 28)])
    patched, prepared = both(machine.without("middle"), rows, (0, 27))
    check_alike(patched, prepared)
    assert [run.verdict for run in patched] == ["not verified", "red"]
    patched, prepared = both(spring(integrator="rk4"), rows_of("spring.stiffness", np.linspace(50, 100, 28)), (0, 27))
    check_alike(patched, prepared)
    assert [run.outcome for run in patched] == ["stopped"] * 2
    np.testing.assert_allclose([run.end_time for run in patched], np.pi / 2 / np.sqrt([50, 100]), rtol=1e-6)


def test_what_is_unusual_in_a_variant_is_said_of_it():
    machine = spring().without("middle")
    patched, prepared = both(machine, rows_of("pull.effort", np.linspace(0.0, 1e12, 30)), (0, 29))
    check_alike(patched, prepared)
    assert patched[0].verdict != patched[1].verdict


def test_variants_that_do_not_fit_are_prepared():
    """A start that moves, and a value that is refused; one that is stiff goes on with another method in place."""
    machine = spring().without("middle")
    runs = JudgedRuns(learn(machine, rows_of("spring.stiffness", [100, 200]), judged=True))
    stiff = {"spring.stiffness": 4e6}
    patched, prepared = runs.run(machine.with_values(stiff), stiff), machine.with_values(stiff).simulate()
    np.testing.assert_allclose(patched.array("position"), prepared.array("position"), atol=1e-11)  # of the numbers
    with pytest.raises(UnsuitedError, match="`start` varies"):
        learn(machine, rows_of("rail.start.displacement", [0.1, 0.2]), judged=True)
    assert formulas_for(machine, rows_of("rail.start.displacement", [0.1, 0.2]), judged=True)[0] is None
    assert (
        run_variant(Task(machine, sample=tuple(rows_of("block.mass", [1, 2]))), {"block.mass": -1.0}).outcome
        == "refused"
    )


def test_few_variants_are_prepared():
    rows = rows_of("block.mass", np.linspace(1.0, 2.0, WORTH_FORMULAS - 1))
    assert sample_of(rows) == ()
    words = [{"simulation.integrator": "rk4"}] * WORTH_FORMULAS
    assert sample_of(words) == ()
