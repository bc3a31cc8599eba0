"""Batches: patched variants are those that are prepared one by one, in their records and in their motion."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import nivel
from nivel.analysis.sweep.patched import PatchedRuns, UnsuitedError, differences, learn, read_values
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.files.reader import Origin

EXAMPLES = Path(__file__).parents[2] / "examples"
# paths whose numbers follow formulas; and ones that move the start, or act together
PLAIN = {
    "mechanisms/slider-crank.yaml": ("bodies.crank.mass", "bodies.rod.mass", "forces.drive.vector.0"),
    "mechanisms/four-bar.yaml": ("bodies.coupler.mass", "gravity.1"),
    "vehicles/suspension.yaml": ("parameters.stiffness",),
    "control/cart-pole.yaml": ("bodies.pole.mass", "bodies.cart.mass"),
}


def machine_of(file, **given):
    machine = nivel.load(EXAMPLES / file)
    if file == "vehicles/suspension.yaml":  # chosen steps are looked at for narrow bumps, one by one
        given = {"integrator": "rk4", **given}
    return machine.with_settings({"duration": 0.2, "start": "as-given", **given})


def value_of(machine, path):
    return machine.parameters[path.removeprefix("parameters.")] if path.startswith("parameters.") else machine[path]


@pytest.fixture(scope="module", params=[*PLAIN], ids=lambda file: Path(file).stem)
def learnt(request):
    machine = machine_of(request.param)
    low, high = ({path: share * value_of(machine, path) for path in PLAIN[request.param]} for share in (0.8, 1.3))
    return machine, learn(machine, [low, high])


@settings(max_examples=4, deadline=None)
@given(shares=st.lists(st.floats(0.8, 1.3), min_size=3, max_size=3))
def test_patched_records_are_those_of_a_machine_that_is_prepared(learnt, shares):
    machine, found = learnt
    x = np.array([share * value_of(machine, path) for share, path in zip(shares, found.paths, strict=False)])
    assert differences(found, x) == []


def test_a_number_that_is_not_patched_would_be_seen():
    """The comparison itself can fail: a factor is spoilt by a millionth."""
    machine = machine_of("mechanisms/slider-crank.yaml")
    found = learn(machine, [{"bodies.crank.mass": 20.0}, {"bodies.crank.mass": 30.0}])
    found.patches[0].numbers.factors[...] *= 1.0 + 1e-6
    assert "bodies.mass" in differences(found, np.array([29.0]))


def test_patched_motions_are_those_of_single_runs(learnt):
    machine, found = learnt
    runs = PatchedRuns(found)
    for share in (1.2, 0.85, 1.2):  # the first again: nothing is left of the run between
        values = {path: share * value_of(machine, path) for path in found.paths}
        frames = runs.run(read_values(values))
        assert frames is not None
        alone = machine.with_values(values).simulate(verify=False)
        mine = runs.result(frames)
        np.testing.assert_allclose(mine.time, alone.time, rtol=1e-14)
        for name in ("position", "velocity"):
            expected = alone.array(name)
            np.testing.assert_allclose(mine.array(name), expected, rtol=0, atol=1e-9 * (1.0 + np.abs(expected).max()))


@pytest.mark.parametrize(
    ("path", "values"),
    [("parameters.rod_length", (1.7, 1.9)), ("simulation.step", (1e-3, 2e-3)), ("bodies.crank.position.0", (0.0, 0.1))],
)
def test_what_moves_the_start_or_the_steps_is_prepared(path, values):
    with pytest.raises(UnsuitedError):
        learn(machine_of("mechanisms/slider-crank.yaml"), [{path: value} for value in values])


def test_parameters_that_act_together_are_prepared():
    """A mass that is the product of two parameters: no sum of functions of one parameter each."""
    text = """
format: 1
parameters: {load: 2, share: 0.5}
bodies: {cart: {mass: load*share, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}
simulation: {duration: 0.1, step: 1 ms, integrator: rk4}
"""
    machine = nivel.Machine.from_record(parse_machine(text), Origin(text, "cart.yaml"))
    rows = [{"parameters.load": a, "parameters.share": b} for a in (1.0, 2.0) for b in (0.4, 0.7)]
    with pytest.raises(UnsuitedError, match="together"):
        learn(machine, rows)


def test_a_batch_is_a_dataset_whatever_way_its_variants_are_made():
    """30 cranks are patched, three rods prepared; a rod in kilograms is refused in its row."""
    machine = machine_of("mechanisms/slider-crank.yaml")
    masses = np.linspace(20.0, 25.0, 30)
    found = machine.batch({"bodies.crank.mass": masses}, save=["hinge.angle", "slider.position"], threads=2)
    assert found.attrs["patched"] == 1
    assert found["hinge.angle"].dims == ("variant", "time")
    assert found["slider.position"].dims == ("variant", "time", "xyz")
    alone = machine.with_values({"bodies.crank.mass": masses[17]}).simulate(verify=False)
    np.testing.assert_allclose(found["hinge.angle"].values[17], alone.array("hinge.angle"), atol=1e-11)
    rods = machine.batch({"parameters.rod_length": [1.7, 1.8, "3 kg"]}, save="hinge.angle")
    assert rods.attrs["patched"] == 0
    assert rods.outcome.values[:2].tolist() == ["done", "done"]
    assert rods.outcome.values[2] == "refused"
    assert rods.reason.values[2]


def test_variants_that_are_all_the_same_are_patched_too():
    machine = machine_of("mechanisms/slider-crank.yaml")
    found = machine.batch({"bodies.crank.mass": [21.0] * 24}, save="hinge.angle")
    assert found.attrs["patched"] == 1
    assert np.ptp(found["hinge.angle"].values, axis=0).max() == 0.0


def test_runs_that_end_early_are_not_a_number_after_it():
    text = """
format: 1
bodies: {cart: {mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}
forces: {push: {type: force, body: cart, vector: [8, 0, 0]}}
events: {far: {when: rail.displacement - 1, direction: rising, stop: true}}
simulation: {duration: 1 s, step: 1 ms, integrator: rk4, output_interval: 10 ms}
"""
    machine = nivel.Machine.from_record(parse_machine(text))
    masses = np.linspace(2.0, 20.0, 30)
    found = machine.batch({"bodies.cart.mass": masses}, save="rail.displacement")
    assert found.attrs["patched"] == 1
    # ½ (F/m) t² = 1
    expected = np.minimum(np.sqrt(2.0 * masses / 8.0), 1.0)
    np.testing.assert_allclose(found.end_time.values, expected, rtol=1e-9)
    assert found.reason.values[0] == "event far"
    assert np.isnan(found["rail.displacement"].values[0, -1])
    assert found.outcome.values[-1] == "done"


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({}, "nothing varies"),
        ({"bodies.crank.mass": [1, 2], "bodies.rod.mass": [1]}, "lists of one length are needed"),
        ({"bodies.crank.mass": 3}, "a list of values was expected, got `3`"),
        ({"bodies.crnk.mass": [1, 2]}, "crnk"),
    ],
)
def test_faults_say_what_to_write(values, message):
    with pytest.raises(ModelError, match=message):
        machine_of("mechanisms/slider-crank.yaml").batch(values)
