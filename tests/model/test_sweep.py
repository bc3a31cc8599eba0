"""Sweeps: every variant is the run that the machine would make alone, and what fails is a row with its reason."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.sweep.variants import lay_out
from nivel.errors import ModelError
from nivel.files.reader import read_machine
from nivel.files.values import whole_path

EXAMPLES = Path(__file__).parents[2] / "examples"
SPRING = """
format: 1
parameters: {stiffness: 100 N/m}
bodies: {block: {mass: 1, inertia: [1, 1, 1]}}
joints:
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 10 cm}}
forces: {spring: {type: joint-spring-damper, coordinate: rail.displacement, stiffness: stiffness}}
events: {back: {when: rail.displacement + 0.09, direction: falling, stop: true}}
simulation: {duration: 0.2, step: 1 ms}
"""


@pytest.fixture
def spring(tmp_path):
    (tmp_path / "spring.yaml").write_text(SPRING, encoding="utf-8")
    return nivel.load(tmp_path / "spring.yaml")


def test_every_variant_of_a_grid_is_its_closed_form(spring):
    """x = 0.1 cos(√(k/m) t)."""
    found = spring.sweep({"parameters.stiffness": [50, "100 N/m", 150], "block.mass": [1.0, 2.0]})
    assert found["rail.displacement"].dims == ("parameters.stiffness", "block.mass", "time")
    assert found["parameters.stiffness"].values.tolist() == [50, 100, 150]
    k, m = found["parameters.stiffness"], found["block.mass"]
    expected = 0.1 * np.cos(np.sqrt(k / m) * found["time"])
    np.testing.assert_allclose(found["rail.displacement"], expected, atol=1e-9)
    assert (found.outcome == "done").all()
    assert (found.verdict == "not verified").all()


def test_processes_give_what_one_process_gives():
    machine = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    values = {"bodies.rod.mass": np.linspace(1, 3, 5), "crank.mass": np.linspace(20, 24, 5)}
    from nivel.analysis.sweep import sweep as module

    alone = machine.sweep(values, combine="rows", processes=1, duration="50 ms", save="crank.position")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "WORTH_A_PROCESS", 0.0)
        together = machine.sweep(values, combine="rows", processes=2, duration="50 ms", save="crank.position")
    assert together.attrs["processes"] == 2
    np.testing.assert_array_equal(together["crank.position"], alone["crank.position"])
    assert together["crank.mass"].dims == ("variant",)


def test_failures_and_refusals_are_rows_with_their_reason(spring):
    found = spring.sweep({"block.mass": [1, -1, 1], "parameters.stiffness": [100, 100, 400]}, combine="rows")
    assert found.outcome.values.tolist() == ["done", "refused", "stopped"]
    assert "a mass greater than zero was expected, got `-1`" in str(found.reason[1].values)
    assert str(found.reason[2].values) == "event back"
    # 0.1 cos(20 t) = -0.09
    assert float(found.end_time[2]) == pytest.approx(np.arccos(-0.9) / 20, abs=1e-6)
    assert np.isnan(found["rail.displacement"][1]).all()
    after = found["rail.displacement"][2].where(found.time > found.end_time[2], drop=True)
    assert np.isnan(after).all()


def test_samples_fill_their_range_evenly():
    """One of n samples of a Latin hypercube lies in each n-th of every range."""
    variants = lay_out({"a": (2, 4), "b": ("10 cm", "20 cm")}, "grid", 10, seed=1)
    assert variants.shape == (10,)
    for path, low, high in (("a", 2, 4), ("b", 0.1, 0.2)):
        share = (np.array(variants.coordinates[path][1]) - low) / (high - low)
        assert sorted((share * 10).astype(int)) == list(range(10))


def test_samples_of_a_distribution_have_its_median():
    from scipy.stats import norm

    variants = lay_out({"a": norm(5, 0.1)}, "grid", 1000, seed=3)
    assert np.median(variants.coordinates["a"][1]) == pytest.approx(5, abs=1e-3)
    assert np.std(variants.coordinates["a"][1]) == pytest.approx(0.1, rel=0.01)


def test_machines_that_a_function_makes_are_swept():
    def pendulum(length, mass=1.0):
        bob = nivel.Body(name="bob", mass=mass, point_mass=True, position=(length, 0, 0))
        rod = nivel.Joint(name="rod", type="distance", bodies=("ground", "bob"), points=((0, 0, 0), (length, 0, 0)))
        return nivel.Machine(bodies=[bob], joints=[rod], gravity=(0, 0, -9.81), simulation={"duration": 0.1})

    found = nivel.sweep(pendulum, {"length": [0.5, 1.0]}, save="bob.position")
    assert found["bob.position"].dims == ("length", "time", "xyz")
    np.testing.assert_allclose(found["bob.position"].isel(time=0, xyz=0), [0.5, 1.0])


def test_a_sweep_may_start_from_equilibrium():
    """The springs of the suspension carry the same weight whatever their stiffness: it rests lower on softer ones."""
    machine = nivel.load(EXAMPLES / "vehicles" / "suspension.yaml")
    found = machine.sweep({"parameters.stiffness": ["22 kN/m", "28 kN/m", "34 kN/m"]}, duration="10 ms", step="1 ms")
    heave = found["heave.displacement"].isel(time=0).values
    assert (np.diff(heave) > 0).all()
    np.testing.assert_allclose(found["heave.displacement"].isel(time=-1), heave, atol=1e-7)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda m: m.sweep({}), "nothing varies"),
        (lambda m: m.sweep({"block.mass": 3}), "block.mass: a list of values was expected, got `3`"),
        (lambda m: m.sweep({"block.mas": [3]}), "did you mean `mass`"),
        (lambda m: m.sweep({"block.mass": [3]}, save="rail.displacment"), "did you mean `rail.displacement`"),
        (lambda m: m.sweep({"block.mass": [3]}, durtion=1), "did you mean `duration`"),
        (
            lambda m: m.sweep({"block.mass": [3]}, combine="all"),
            "the combination `all` is not known; there are grid, rows, ",
        ),
        (lambda m: m.sweep({"block.mass": [3, 4], "gravity.0": [1]}, combine="rows"), "needs lists of one length"),
        (lambda m: m.sweep({"block.mass": 3}, samples=5), "two bounds (1, 3) or a distribution of SciPy"),
        (lambda m: m.sweep({"block.mass": (1, 2)}, samples=0), "a whole number of at least 1"),
        (lambda m: nivel.sweep(lambda a: a, {"a": [1]}), "a function that returns a Machine was expected"),
    ],
)
def test_faults_say_what_to_write(call, message, spring):
    with pytest.raises(ModelError) as caught:
        call(spring)
    assert message in str(caught.value)


LAWS = """
format: 1
parameters: {stiffness: 100 N/m, peak: 3 N, length: 20 cm}
gravity: [0, 0, -9.81]
bodies:
  block: {mass: 1, inertia: [1, 1, 1]}
  bob: {mass: 0.5, point_mass: true, position: [0, 0, -length]}
joints:
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 10 cm}}
  string: {type: distance, bodies: [block, bob], points: [[0, 0, 0], [0, 0, -length]]}
forces:
  spring: {type: joint-spring-damper, coordinate: rail.displacement, stiffness: stiffness}
  pull: {type: force, body: block, vector: [peak*sin(20*time) - 2*rail.displacement_rate, 0, 0]}
  push: {type: motor, coordinate: rail, effort: {times: [0, 0.1, 0.2], values: [0, peak, 1]}}
simulation: {duration: 0.1, step: 1 ms}
"""


@pytest.mark.parametrize(
    ("path", "values"),
    [
        ("block.mass", [1.0, 2.5]),
        ("bob.mass", [0.4, "700 g"]),
        ("parameters.stiffness", [100.0, "150 N/m"]),
        ("parameters.length", ["20 cm", "35 cm"]),
        ("parameters.peak", [3.0, -7.0]),
        ("rail.start.displacement", [0.1, 0.2]),
        ("push.effort.values.1", [3.0, 4.0]),
        ("push.effort", [2.0, "3*time"]),
        ("simulation.start", ["as-given", "equilibrium"]),
    ],
)
def test_a_sweep_gives_to_the_last_bit_what_runs_one_by_one_give(path, values, tmp_path):
    (tmp_path / "laws.yaml").write_text(LAWS, encoding="utf-8")
    machine = nivel.load(tmp_path / "laws.yaml")
    found = machine.sweep({path: values}, save=["rail.displacement", "joint_force"], processes=1)
    assert found.outcome.values.tolist() == ["done", "done"]
    for k, value in enumerate(values):
        alone = nivel.Machine.from_record(
            read_machine(tmp_path / "laws.yaml", overrides={whole_path(machine.record, path): value})
        ).simulate()
        assert found.verdict.values[k] == alone.trust.light
        for name in ("rail.displacement", "joint_force"):
            np.testing.assert_array_equal(found[name].isel({path: k}), alone.array(name))


@pytest.mark.parametrize(("path", "value"), [("upper_ball.point.1", 0.665), ("parameters.bump", "7 cm")])
def test_a_sweep_from_equilibrium_gives_to_the_last_bit_what_a_run_alone_gives(path, value):
    settings = {"duration": 0.02, "start": "equilibrium"}
    machine = nivel.load(EXAMPLES / "vehicles" / "suspension.yaml")
    found = machine.sweep({path: [value]}, save=["position", "joint_force"], processes=1, **settings)
    alone = nivel.Machine.from_record(
        read_machine(EXAMPLES / "vehicles" / "suspension.yaml", overrides={whole_path(machine.record, path): value})
    )
    result = alone.simulate(**settings)
    assert found.verdict.values[0] == result.trust.light
    for name in ("position", "joint_force"):
        np.testing.assert_array_equal(found[name].isel({path: 0}), result.array(name))


def test_reasons_of_a_sweep_are_those_of_a_run_alone():
    path, value = "parameters.tyre", "-200 kN/m"
    machine = nivel.load(EXAMPLES / "vehicles" / "suspension.yaml")
    found = machine.sweep({path: ["200 kN/m", value]}, processes=1, duration=0.01)
    with pytest.raises(nivel.SolveError) as alone:
        machine.with_values({path: value}).simulate(duration=0.01)
    assert found.outcome.values.tolist() == ["done", "failed"]
    assert found.reason.values[1] == str(alone.value)


def test_a_sweep_of_another_analysis_has_its_outputs(spring):
    """f = √(k/m)/2π."""
    found = spring.sweep(
        {"block.mass": [1, 4]},
        analysis="linearise",
        analysis_settings={"about": "equilibrium"},
        outputs={"f": {"type": "value", "of": "mode.1.frequency"}},
    )
    np.testing.assert_allclose(found["f"], np.array([10, 5]) / (2 * np.pi), rtol=1e-9)
    assert found["f"].attrs["units"] == "Hz"
