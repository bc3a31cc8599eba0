"""Numbers of machines as functions of parameters, and the roles of the arrays in which they stand."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.preparation import memory
from nivel.analysis.preparation.memory import MachineMemory
from nivel.analysis.preparation.parameters import UnfitError, numbers_of
from nivel.analysis.run.dynamics import GOES_ON, start_loop
from nivel.analysis.run.prepared_state import prepare
from nivel.analysis.sweep.patched import PatchedRuns, learn
from nivel.files import parse_machine
from nivel.files.reader import Origin
from nivel.integrate.loop.run import BUDGET, FRAMES
from nivel.kernels.record.record import Tree

EXAMPLES = Path(__file__).parents[2] / "examples"
RUNS = {
    "mechanisms/slider-crank.yaml": {"integrator": "rk4"},
    "mechanisms/four-bar.yaml": {"integrator": "rk4", "coordinates": "absolute"},
    "optimisation/sliding-block.yaml": {},
    "contact/gripper.yaml": {"integrator": "rk4"},
    "hydraulics/cylinder-boom.yaml": {},
}


def started(file, settings):
    machine = nivel.load(EXAMPLES / file).with_settings({"duration": 0.02, "start": "as-given", **settings})
    plan = plan_run(machine.record, machine.origin.settings_outside)
    prepared = prepare(plan.methods)
    loop = start_loop(prepared, plan.settings)
    return prepared, loop, [*memory.leaves(loop.machine.record), *memory.leaves(loop.history.record)]


def frames_of(loop):
    run, frames = loop.history.record, []
    while True:
        run.counter[BUDGET] = 10_000
        status = loop.advance()
        frames.append(run.frames[: run.counter[FRAMES]].copy())
        run.counter[FRAMES] = 0
        if status not in GOES_ON:
            return np.concatenate(frames)


@pytest.mark.parametrize("file", RUNS, ids=lambda file: Path(file).stem)
def test_no_run_reads_its_workspace_before_it_writes_it(file):
    """What a run changes there is no number at its start in another, which has the same frames to the last bit."""
    kept, loop, arrays = started(file, RUNS[file])
    wanted = frames_of(loop)
    changed = [leaf.array.copy() for leaf in arrays]
    kept, other, arrays = started(file, RUNS[file])
    poisoned = 0
    for leaf, later in zip(arrays, changed, strict=True):
        if leaf.array.dtype == np.float64:
            hit = leaf.workspace & (leaf.array != later)
            leaf.array[hit] = np.nan
            poisoned += hit.sum()
    assert poisoned > 30
    np.testing.assert_array_equal(frames_of(other), wanted)
    assert kept.motion.system.record is other.machine.record


@pytest.mark.parametrize("table", ["GIVEN", "STATE", "BEGUN", "WORKSPACE", "MIXED"])
def test_tables_name_arrays_that_there_are(table):
    for record, names in getattr(memory, table).items():
        assert set(names.split()) <= set(record._fields), record


def test_each_array_has_one_role():
    for a, b in (("STATE", "BEGUN"), ("STATE", "WORKSPACE"), ("BEGUN", "WORKSPACE"), ("GIVEN", "WORKSPACE")):
        first, second = getattr(memory, a), getattr(memory, b)
        for record in first.keys() & second.keys():
            assert not set(first[record].split()) & set(second[record].split()), record


LAWS = {
    "line": (lambda x, y: 3.0 * x + 2.0 * y, lambda x, y: (3.0, 2.0)),
    "cube": (lambda x, y: x**3 - 2.0 * x**2, lambda x, y: (3.0 * x**2 - 4.0 * x, 0.0)),
    "share": (lambda x, y: x / (x + 0.3), lambda x, y: (0.3 / (x + 0.3) ** 2, 0.0)),
    "inverse": (lambda x, y: -4.0 / (x + y), lambda x, y: (4.0 / (x + y) ** 2,) * 2),
    "inverse root": (lambda x, y: (x + 2.0 * y) ** -0.5, lambda x, y: np.array([-0.5, -1.0]) * (x + 2.0 * y) ** -1.5),
    "length": (np.hypot, lambda x, y: np.array([x, y]) / np.hypot(x, y)),
}
X = np.array([0.9, 1.7])


def memory_with(numbers):
    empty = np.zeros(0)
    return MachineMemory(Tree(**{**dict.fromkeys(Tree._fields, empty), "size": np.array(numbers)}))


def found(functions, rows=((0.8, 1.3, 0.97, 1.15),) * 2):
    def at(x):
        return memory_with([function(*x) for function in functions])

    return numbers_of(at(X), X, [[[row]] for row in rows], lambda k, value: at(np.where(np.arange(2) == k, value, X)))


@pytest.mark.parametrize("name", LAWS)
def test_laws_and_their_slopes_hold_beyond_the_values_from_which_they_are_found(name):
    value, slope = LAWS[name]
    numbers = found([value])
    for x in ((0.85, 1.1), (1.2, 0.9), (7.0, 30.0)):
        np.testing.assert_allclose(numbers.at(np.array(x)), [value(*x)], rtol=1e-11)
        np.testing.assert_allclose(numbers.slopes(np.array(x)), [slope(*x)], rtol=1e-10, atol=1e-12)


def test_what_is_in_proportion_is_exact_to_its_own_size_over_decades():
    numbers = found([lambda x, y: 2.0 * x], ((1e-3, 1e5, 10.0, 500.0), (1.0, 2.0, 3.0, 4.0)))
    for x in (0.0, 1e-6, 3e-3, 7e7):
        assert numbers.at(np.array([x, 1.0]))[0] == pytest.approx(2.0 * x, rel=1e-14, abs=0.0)


@pytest.mark.parametrize("value", [lambda x, y: np.exp(x), lambda x, y: max(x, 1.0), lambda x, y: np.exp(x) + x * y])
def test_what_follows_no_law_is_named(value):
    with pytest.raises(UnfitError) as refused:
        found([value])
    assert refused.value.args[0].reason == "size"
    assert refused.value.args[0].parameter == 0


def test_slopes_of_numbers_that_hardly_change_are_those_of_their_changes():
    """A large constant hides the curvature of what is added to it: two values do not make a law of it, four give its slope."""
    value, asked = (lambda x: 1e3 + 1e-2 * np.sin(x)), []

    def at(_, x):
        asked.append(x)
        return memory_with([value(x), 3.0 * x])

    x, h = 0.7, 1e-3
    turns = ((x - h, x + h), (x - 2.0 * h, x + 2.0 * h))
    numbers = numbers_of(memory_with([value(x), 3.0 * x]), np.array([x]), [[turns]], at, lambda sample: True)
    assert len(asked) == 4
    np.testing.assert_allclose(numbers.slopes(np.array([x]))[:, 0], [1e-2 * np.cos(x), 3.0], rtol=1e-7)


CART = """
format: 1
parameters: {kp: 300, ki: 100, kd: 20, load: 2}
bodies:
  cart: {mass: load + 1, inertia: [1, 1, 1]}
joints:
  rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 0}}
forces: {drive: {type: motor, coordinate: rail, effort: axis}}
control:
  axis: {type: pid, reference: 0.1, measured: rail.displacement, kp: kp, ki: ki, kd: kd, filter_time: 1 ms, sample_time: 2 ms, units: N}
simulation: {duration: 0.2, step: 1 ms, integrator: rk4, output_interval: 10 ms}
"""


def test_gains_from_zero_are_patched_and_zero_itself_is_prepared():
    """Without an integral the controller has no state for it: another structure."""
    machine, gains = (
        nivel.Machine.from_record(parse_machine(CART), Origin(CART, "cart.yaml")),
        np.linspace(0.0, 400.0, 30),
    )
    ran = machine.batch({"parameters.ki": gains}, save=["rail.displacement", "energy_error"])
    assert ran.attrs["patched"] == 1
    for k in (0, 1, 29):
        alone = machine.with_values({"parameters.ki": gains[k]}).simulate(verify=False)
        np.testing.assert_allclose(ran["rail.displacement"].values[k], alone.array("rail.displacement"), atol=1e-13)
        np.testing.assert_allclose(ran["energy_error"].values[k], alone.array("energy_error"), atol=1e-12)


def test_energies_of_patched_runs_are_referred_to_their_own_start():
    """Weights and masses together: the potential energy at the start is their product."""
    machine = nivel.load(EXAMPLES / "mechanisms/four-bar.yaml").with_settings({"duration": 0.1, "integrator": "rk4"})
    rows = {"bodies.coupler.mass": np.linspace(100.0, 200.0, 30), "gravity.1": np.linspace(-5.0, -15.0, 30)}
    ran = machine.batch(rows, save="energy_error")
    assert ran.attrs["patched"] == 1
    alone = machine.with_values({path: values[25] for path, values in rows.items()}).simulate(verify=False)
    np.testing.assert_allclose(ran["energy_error"].values[25], alone.array("energy_error"), atol=1e-9)


def test_steps_that_are_chosen_are_looked_at_for_narrow_features_of_each_variant():
    """The default method of a machine with a bump in time."""
    machine = nivel.load(EXAMPLES / "vehicles/suspension.yaml").with_settings({"duration": 0.6, "start": "as-given"})
    runs = PatchedRuns(learn(machine, [{"parameters.bump": 0.01}, {"parameters.bump": 0.06}]))
    for bump in (0.05, 0.02):
        frames = runs.run(np.array([bump]))
        assert frames is not None
        alone = machine.with_values({"parameters.bump": bump}).simulate(verify=False)
        np.testing.assert_allclose(runs.result(frames).array("position"), alone.array("position"), atol=1e-11)
    assert runs.loop_seconds > 0.0
