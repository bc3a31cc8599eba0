"""FMUs in machines: sampled blocks of the control that are called by the compiled loop."""

import os
import platform
import runpy
import shutil
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
from needing import needs
from nivel.analysis.run.stepping import Snapshot
from nivel.cli import main
from nivel.elements.control.units import FmuBlock
from units import archive, compiled, description

EXAMPLES = Path(__file__).parents[2] / "examples" / "exchange"

pytestmark = [
    pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler"),
    pytest.mark.skipif(platform.machine() != "x86_64", reason="the units are of x86-64"),
]

CART = """\
format: 1
name: cart
bodies:
  cart: {{mass: 2 kg, inertia: [1, 1, 1]}}
joints:
  rail: {{type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0], start: {{displacement: 0.3}}}}
control:
  unit: {block}
forces:
  drive: {{type: motor, coordinate: rail, effort: unit.value}}
simulation: {{duration: 1 s, step: 1 ms}}
"""
IN_THE_FILE = "{{type: signal, sample_time: 2 ms, value: -40*rail.displacement - 8*rail.displacement_rate}}"
BLOCK = (
    "{{type: fmu, file: {file}, every: 2 ms, inputs: {{x: rail.displacement, v: rail.displacement_rate}}, "
    "outputs: {{u: u, integral: 'plant.i[1]', t: t{more}}}, parameters: {{{parameters}}}}}"
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Units of both versions; one without states, one of which there can be one in a process, one for another system."""
    folder = tmp_path_factory.mktemp("units")
    library = {fmi: compiled(folder, fmi) for fmi in (3, 2)}
    for fmi in (3, 2):
        archive(folder / f"unit{fmi}.fmu", description(fmi), library[fmi], fmi)
    archive(folder / "stateless.fmu", description(states=False), library[3])
    archive(folder / "single.fmu", description(once=True), library[3])
    archive(folder / "foreign.fmu", description(), b"", system="x86_64-windows")
    archive(folder / "broken.fmu", description(), b"no library")
    tied = (
        description().replace('Token="unit"', 'Token="other"').replace("/><Model", ' needsExecutionTool="true"/><Model')
    )
    archive(folder / "tied.fmu", tied, library[3])
    return folder


def machine(folder, file="unit3.fmu", parameters="kp: 40", block=BLOCK, more=""):
    path = folder / "cart.yaml"
    path.write_text(CART.format(block=block.format(file=file, parameters=parameters, more=more)), encoding="utf-8")
    return nivel.load(path, allow_code=True)


@pytest.mark.parametrize("file", ["unit3.fmu", "unit2.fmu"])
def test_a_unit_steers_as_the_expression_that_it_is(folder, file):
    """Equal to the last bit; its integral is a sum of samples, its time that of the machine."""
    result = machine(folder, file).simulate()
    same = machine(folder, block=IN_THE_FILE).simulate()
    np.testing.assert_array_equal(result.array("rail.displacement"), same.array("rail.displacement"))
    np.testing.assert_array_equal(result.array("control.unit"), same.array("control.unit"))
    x, t = result.array("rail.displacement"), result.time
    assert np.ptp(x) > 0.1
    every = slice(0, None, round(2e-3 / (t[1] - t[0])))
    sums = 2e-3 * (np.cumsum(x[every]) - x[0])
    np.testing.assert_allclose(result.array("control.unit.integral")[every], sums, rtol=1e-12)
    np.testing.assert_allclose(result.array("control.unit.t")[every], t[every], rtol=1e-12)


@pytest.mark.usefixtures("verified")
@pytest.mark.parametrize("file", ["unit3.fmu", "single.fmu"])
def test_the_second_run_has_an_instance_of_its_own(folder, file):
    """At the same time; both runs agree to round-off. A unit of which there can be one in a process has a library for each."""
    result = machine(folder, file, more=", instances: instances" if file == "single.fmu" else "").simulate()
    assert result.trust.verdict == "green"
    assert "round-off" in result.trust.headline
    if file == "single.fmu":
        assert set(result.array("control.unit.instances")) == {1.0}


@pytest.mark.parametrize("file", ["unit3.fmu", "unit2.fmu"])
def test_a_state_of_the_simulation_holds_that_of_the_unit(folder, file, tmp_path):
    simulation = machine(folder, file).start()
    simulation.advance(0.2)
    simulation.state.save(tmp_path / "state.npz")
    state = Snapshot.open(tmp_path / "state.npz")

    def on(simulation):
        simulation.advance(0.3)
        return [simulation[name] for name in ("rail.displacement", "control.unit.integral", "control.unit.t")]

    wanted = on(simulation)
    simulation.restore(state)
    assert on(simulation) == wanted
    other = machine(folder, file).start()
    other.restore(state)
    assert on(other) == wanted
    assert wanted[2] == pytest.approx(0.5)


def test_a_unit_without_states_cannot_be_saved_and_says_so(folder):
    simulation = machine(folder, "stateless.fmu").start()
    simulation.advance(0.1)
    with pytest.raises(nivel.ModelError, match=r"stateless.fmu` cannot save its state"):
        _ = simulation.state


def test_a_sweep_runs_each_variant_with_its_own_instances(folder):
    cart = machine(folder)
    swept = cart.sweep({"bodies.cart.mass": [1.0, 4.0]}, duration=0.2)
    for mass in (1.0, 4.0):
        alone = cart.with_values({"bodies.cart.mass": mass}).simulate(duration=0.2)
        found = swept["rail.displacement"].sel({"bodies.cart.mass": mass}).to_numpy().ravel()
        assert found[-1] == alone.array("rail.displacement")[-1]


def test_methods_that_choose_their_steps_meet_the_samples(folder):
    result = machine(folder).simulate(integrator="dopri5", tolerance=1e-9)
    same = machine(folder, block=IN_THE_FILE).simulate(integrator="dopri5", tolerance=1e-9)
    np.testing.assert_array_equal(result.array("rail.displacement"), same.array("rail.displacement"))


FAULTS = {
    1: "reported an error in its step at t = 0.5 s: the sensor is lost",
    2: "gave an output that is not a number (`u`) at t = 0.5 s",
    3: "asked to end the simulation at t = 0.5 s",
}


@pytest.mark.parametrize(("file", "fault"), [("unit3.fmu", 1), ("unit2.fmu", 1), ("unit3.fmu", 2), ("unit3.fmu", 3)])
def test_a_unit_that_fails_ends_the_run_and_everything_is_kept(folder, file, fault, tmp_path):
    machine(folder, file, parameters=f"fault: {fault}, fault_at: 0.4999")
    words = ["run", str(folder / "cart.yaml"), "--allow-code", "--out", str(tmp_path / "r.nc"), "--no-report"]
    done = CliRunner().invoke(main, words)
    assert done.exit_code == 3, done.output
    said = " ".join(done.output.split())
    assert f"the FMU of the block unit {FAULTS[fault]}" in said
    result = nivel.Result.open(tmp_path / "r.nc")
    assert result.time[-1] == pytest.approx(0.5, abs=2e-3)
    assert np.isfinite(result.array("rail.displacement")).all()


def test_nothing_of_a_unit_is_loaded_before_it_is_allowed(folder, tmp_path, monkeypatch):
    """Its library would leave a file where it is loaded."""
    monkeypatch.setenv("NIVEL_TEST_LOADED", str(tmp_path / "loaded"))
    fresh = folder / "fresh.fmu"  # another content, so that no library of it is in memory
    archive(fresh, description(more="<!-- fresh -->"), compiled(folder))
    machine(folder, "fresh.fmu").check()
    for command in ("run", "check"):
        done = CliRunner().invoke(main, [command, str(folder / "cart.yaml")])
        assert done.exit_code == 2
        assert "this block runs the machine code of fresh.fmu; say --allow-code if you trust it" in " ".join(
            done.output.split()
        )
    assert not (tmp_path / "loaded").exists()
    machine(folder, "fresh.fmu").start()
    assert (tmp_path / "loaded").exists()


@pytest.mark.parametrize(
    ("block", "said"),
    [
        ("{{type: fmu, file: {file}, every: 1 ms, inputs: {{xx: time}}, outputs: [u]}}", r"`xx` is not known.*`x`"),
        ("{{type: fmu, file: {file}, every: 1 ms, inputs: {{u: time}}, outputs: [u]}}", r"`u` is an output of the FMU"),
        ("{{type: fmu, file: {file}, every: 1 ms, outputs: [kp]}}", r"`kp` is a parameter of the FMU, not an output"),
        ("{{type: fmu, file: {file}, every: 1 ms, outputs: [whole]}}", r"`whole` is of the type Int32"),
        ("{{type: fmu, file: {file}, every: 1 ms, outputs: [list]}}", r"`list` is an array"),
        ("{{type: fmu, file: {file}, every: 1 ms}}", r"`outputs` is missing"),
        ("{{type: fmu, file: {file}, outputs: [u]}}", r"`sample_time` is missing"),
        ("{{type: fmu, file: {file}, every: 1 ms, sample_time: 1 ms, outputs: [u]}}", r"not both"),
        ("{{type: fmu, file: {file}, every: 0.3 ms, outputs: [u]}}", r"no whole number of steps"),
        ("{{type: fmu, file: unit9.fmu, every: 1 ms, outputs: [u]}}", r"there is no file .*unit9.fmu"),
        ("{{type: fmu, file: {file}, every: 1 ms, outputs: [u], parameters: {{kq: 2}}}}", r"`kq` is not known"),
    ],
)
def test_what_is_wrong_with_a_block_is_told_with_its_line(folder, block, said):
    more = '<Int32 name="whole" valueReference="20" causality="output"/>'
    more += '<Float64 name="list" valueReference="21" causality="output"><Dimension start="3"/></Float64>'
    archive(folder / "typed.fmu", description(more=more), b"")
    with pytest.raises(nivel.ModelError, match=said) as refused:
        machine(folder, "typed.fmu", block=block).start()
    assert "cart.yaml:8" in str(refused.value)


@pytest.mark.parametrize(
    ("file", "said"),
    [
        ("foreign.fmu", r"has no binary for x86_64-linux; it has those of x86_64-windows"),
        ("broken.fmu", r"broken.fmu` cannot be loaded"),
        ("tied.fmu", r"could not be instantiated, and says that it needs the program that made it"),
    ],
)
def test_a_unit_that_cannot_be_loaded_is_refused_before_the_run(folder, file, said):
    with pytest.raises(nivel.ModelError, match=said) as refused:
        machine(folder, file).simulate()
    assert "cart.yaml:8" in str(refused.value)


def test_a_machine_in_python_and_a_written_file_have_the_same_unit(folder, tmp_path):
    cart = machine(folder)
    cart.save(tmp_path / "again.yaml")
    again = nivel.load(tmp_path / "again.yaml", allow_code=True)
    assert again.record.control == cart.record.control
    block = FmuBlock(
        name="unit",
        file=str(folder / "unit3.fmu"),
        sample_time=2e-3,
        inputs={"x": "rail.displacement", "v": "rail.displacement_rate"},
        outputs=["u", "t"],
    )
    in_python = cart.replace(block).start()
    in_python.advance(0.1)
    simulation = again.start()
    simulation.advance(0.1)
    assert in_python["rail.displacement"] == simulation["rail.displacement"]
    with pytest.raises(
        nivel.ModelError, match="a C library cannot have what others have compiled: an FMU of the block `unit`"
    ):
        again.export_c(tmp_path / "c")


@pytest.mark.parametrize("key", ["name", "file", "inputs", "outputs", "parameters", "sample_time", "units"])
@pytest.mark.parametrize(
    "garbage", [None, True, -1, float("nan"), "", "1 furlong", [], [1], {}, {"a": [1]}, {1: {}}, [[[]]]]
)
def test_what_is_no_block_is_refused_as_such(key, garbage):
    """With a ModelError, or taken where it makes sense."""
    good = {"name": "unit", "file": "u.fmu", "inputs": {"x": "time"}, "outputs": ["u"], "sample_time": 1e-3}
    try:
        block = FmuBlock(**{**good, key: garbage})
    except nivel.ModelError:
        return
    assert block.parts
    assert FmuBlock(**block.model_dump(exclude_none=True)) == block


def test_a_machine_in_a_machine_is_its_own_fmu(folder):
    """The cart as an FMU with a force as input, in a machine in which a controller of nivel steers it."""
    text = CART.format(block="{type: signal, value: 0}").replace("unit.value", "push.value")
    (folder / "plant.yaml").write_text(text + "inputs: {push: {range: [-100, 100]}}\n", encoding="utf-8")
    plant = nivel.load(folder / "plant.yaml")
    plant.export_fmu(folder / "plant.fmu", force=True)
    (folder / "both.yaml").write_text(
        """\
format: 1
name: both
bodies: {dummy: {mass: 1 kg, inertia: [1, 1, 1]}}
inputs: {push: {range: [-100, 100]}}
control:
  plant: {type: fmu, file: plant.fmu, every: 1 ms, inputs: {push: push.value}, outputs: {x: rail.displacement}}
simulation: {duration: 1 s, step: 1 ms}
""",
        encoding="utf-8",
    )
    inner, outer = plant.start(), nivel.load(folder / "both.yaml", allow_code=True).start()
    for k in range(100):
        push = 5.0 * np.sin(0.1 * k)
        inner.step({"push": push})
        # the input that holds at the end of a step is that of the unit's step
        outer.step({"push": push})
    assert outer["control.plant"] == pytest.approx(inner["rail.displacement"], rel=1e-12)


def test_the_example_holds_its_cart(tmp_path):
    """x = reference in the end, whatever pushes: the controller has an integral."""
    shutil.copytree(EXAMPLES, tmp_path / "exchange", ignore=shutil.ignore_patterns("*.fmu", "*.nc"))
    runpy.run_path(str(tmp_path / "exchange" / "build_controller.py"))["build"](
        tmp_path / "exchange" / "controller.fmu"
    )
    result = nivel.load(tmp_path / "exchange" / "cart.yaml", allow_code=True).simulate()
    assert result.array("rail.displacement")[-1] == pytest.approx(0.3, abs=2e-3)
    assert result.array("control.controller")[-1] == pytest.approx(4.0, abs=0.1)


@pytest.mark.full
def test_another_program_agrees_that_the_example_is_an_fmu(tmp_path):
    validation = needs("fmpy.validation")
    runpy.run_path(str(EXAMPLES / "build_controller.py"))["build"](tmp_path / "controller.fmu")
    assert validation.validate_fmu(os.fspath(tmp_path / "controller.fmu")) == []
