"""C functions in machines, and units in processes of their own: blocks that are called by the compiled loop."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
from nivel.analysis.run.stepping import Snapshot
from nivel.cli import main
from nivel.elements.control.units import CBlock
from units import archive, compiled, description

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples" / "exchange"

pytestmark = pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler")

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
IN_THE_FILE = "{type: signal, sample_time: 2 ms, value: -40*rail.displacement - 8*rail.displacement_rate}"
BLOCK = (
    "{{type: c, file: {file}, function: {function}, every: 2 ms, inputs: {{x: rail.displacement, v: rail.displacement_rate, "
    "fault: {fault}}}, outputs: [u, integral, calls], state: [0.0]{more}}}"
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("units")
    shutil.copy(HERE / "controller.c", folder)
    command = ["cc", "-O2", "-fPIC", "-shared", "-o", folder / "controller.so", folder / "controller.c", "-lm"]
    subprocess.run(command, check=True)
    archive(folder / "unit3.fmu", description(3), compiled(folder, 3))
    archive(folder / "unit2.fmu", description(2), compiled(folder, 2), 2)
    return folder


def written(folder, block=None, file="controller.so", function="controller", fault=0, more=""):
    path = folder / "cart.yaml"
    block = block or BLOCK.format(file=file, function=function, fault=fault, more=more)
    path.write_text(CART.format(block=block), encoding="utf-8")
    return path


def machine(folder, block=None, **given):
    return nivel.load(written(folder, block, **given), allow_code=True)


OWN = ", process: own, time_limit: 2 s"


@pytest.fixture(scope="module")
def wanted(folder):
    """The run with the same law as an expression."""
    return machine(folder, IN_THE_FILE).simulate(verify=False)


@pytest.mark.parametrize("given", [{}, {"file": "controller.c"}, {"more": OWN}], ids=["library", "source", "own"])
def test_a_c_function_steers_as_the_expression_that_it_is(folder, wanted, given):
    """Equal to the last bit, in both processes; its state is a sum of samples; it is called once a sample."""
    result = machine(folder, **given).simulate(verify=False)
    np.testing.assert_array_equal(result.array("rail.displacement"), wanted.array("rail.displacement"))
    x, t = result.array("rail.displacement"), result.time
    every = slice(0, None, round(2e-3 / (t[1] - t[0])))
    sums = 2e-3 * (np.cumsum(x[every]) - x[every])
    np.testing.assert_allclose(result.array("control.unit.integral")[every], sums, rtol=1e-12, atol=1e-15)
    np.testing.assert_array_equal(result.array("control.unit.calls")[every], 1.0 + np.arange(len(t[every])))


@pytest.mark.usefixtures("verified")
def test_the_second_run_has_memory_of_its_own(folder):
    """Even that of the library: each run counts its own calls."""
    result = machine(folder).simulate()
    assert result.trust.verdict == "green"
    assert "round-off" in result.trust.headline
    assert result.array("control.unit.calls")[-1] == pytest.approx(501, abs=1)


@pytest.mark.parametrize("block", ["c", pytest.param("c own", marks=pytest.mark.full), "fmu own"])
def test_a_state_of_the_simulation_holds_that_of_the_unit(folder, block, tmp_path):
    if block == "fmu own":
        own = (
            "{type: fmu, file: unit3.fmu, every: 2 ms, inputs: {x: rail.displacement, v: rail.displacement_rate}, "
            "outputs: {u: u, integral: 'plant.i[1]'}, parameters: {kp: 40}, process: own}"
        )
        cart = machine(folder, own)
    else:
        cart = machine(folder, more=OWN if block == "c own" else "")
    simulation = cart.start()
    simulation.advance(0.2)
    simulation.state.save(tmp_path / "state.npz")
    state = Snapshot.open(tmp_path / "state.npz")

    def on(simulation):
        simulation.advance(0.3)
        return [simulation[name] for name in ("rail.displacement", "control.unit.integral")]

    expected = on(simulation)
    assert expected[1] > 0.0
    simulation.restore(state)
    assert on(simulation) == expected
    other = cart.start()
    other.restore(state)
    assert on(other) == expected


def test_a_sweep_runs_each_variant_with_memory_of_its_own(folder):
    cart = machine(folder)
    swept = cart.sweep({"bodies.cart.mass": [1.0, 4.0]}, duration=0.2, save=["rail.displacement", "control.unit.calls"])
    for mass in (1.0, 4.0):
        alone = cart.with_values({"bodies.cart.mass": mass}).simulate(duration=0.2, verify=False)
        for name in ("rail.displacement", "control.unit.calls"):
            found = swept[name].sel({"bodies.cart.mass": mass}).to_numpy().ravel()
            assert found[-1] == alone.array(name)[-1]


@pytest.mark.parametrize("fmi", [3, pytest.param(2, marks=pytest.mark.full)])
def test_an_fmu_in_a_process_of_its_own_gives_the_same_numbers(folder, fmi):
    block = (
        f"{{type: fmu, file: unit{fmi}.fmu, every: 2 ms, inputs: {{x: rail.displacement, v: rail.displacement_rate}}, "
        "outputs: {u: u, integral: 'plant.i[1]', t: t}, parameters: {kp: 40}%s}"
    )
    here, there = (machine(folder, block % more).simulate(duration=0.2, verify=False) for more in ("", OWN))
    for name in ("rail.displacement", "control.unit", "control.unit.integral", "control.unit.t"):
        np.testing.assert_array_equal(here.array(name), there.array(name))


FAULTS = [
    (1, "", "returned -7 at t = 0.5 s"),
    (2, "", "gave an output that is not a number (`integral`) at t = 0.5 s"),
    pytest.param(1, OWN, "returned -7 at t = 0.5 s", marks=pytest.mark.full),
    (3, OWN, "crashed (SIGABRT) at t = 0.5 s"),
    pytest.param(5, OWN, "crashed (exit code 3) at t = 0.5 s", marks=pytest.mark.full),
    (4, ", process: own, time_limit: 0.3 s", "did not return within 0.3 s at t = 0.5 s"),
]


@pytest.mark.skipif(os.name != "posix", reason="signals are of POSIX")
@pytest.mark.parametrize(("fault", "more", "said"), FAULTS)
def test_a_unit_that_fails_crashes_or_hangs_ends_the_run_and_everything_is_kept(folder, fault, more, said, tmp_path):
    path = written(folder, fault=fault, more=more)
    words = ["run", str(path), "--allow-code", "--out", str(tmp_path / "r.nc"), "--no-report", "--no-verify"]
    done = CliRunner().invoke(main, words)
    assert done.exit_code == 3, done.output
    assert f"the C function controller of the block unit {said}" in " ".join(done.output.split())
    result = nivel.Result.open(tmp_path / "r.nc")
    assert result.time[-1] == pytest.approx(0.5, abs=2e-3)
    assert np.isfinite(result.array("rail.displacement")).all()


@pytest.mark.skipif(os.name != "posix", reason="of the C library of POSIX")
def test_a_function_that_ends_the_program_does_not_end_it_as_done(folder, tmp_path):
    """`exit(0)` in the process of nivel: exit code 3, a sentence, and the frames until then."""
    path, out = written(folder, fault=5), tmp_path / "r.nc"
    words = [sys.executable, "-m", "nivel", "run", path, "--allow-code", "--out", out, "--no-report", "--no-verify"]
    done = subprocess.run(words, check=False, capture_output=True, text=True)
    assert done.returncode == 3, done.stderr
    assert "the C function controller of the block unit called `exit`, which ends the program" in done.stderr
    assert "Traceback" not in done.stderr
    assert nivel.Result.open(out).outcome != "done"


def test_a_function_that_changes_how_numbers_are_rounded_changes_nothing_else(folder, wanted):
    """1/3 + 1/3 + 1/3 = 1 as numbers are rounded to the nearest; the motion is that of the expression to the last bit."""
    result = machine(folder, fault=6).simulate(verify=False)
    np.testing.assert_array_equal(result.array("rail.displacement"), wanted.array("rail.displacement"))
    third = float(np.float64(1.0) / np.float64(3.0))
    assert third == 0.3333333333333333148


@pytest.mark.parametrize(("fault", "more"), [(4, ""), (5, ""), (4, OWN), (5, OWN)])
def test_a_status_that_the_standard_does_not_know_is_an_error_in_both_processes(folder, fault, more):
    block = (
        "{type: fmu, file: unit3.fmu, every: 2 ms, inputs: {x: rail.displacement, v: rail.displacement_rate}, "
        f"outputs: {{u: u}}, parameters: {{fault: {fault}, fault_at: 0.1}}{more}}}"
    )
    with pytest.raises(nivel.SolveError, match=r"reported an error in its step at t = 0\.1"):
        machine(folder, block).simulate(duration=0.2, verify=False)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"file": "none.so"}, r"there is no file .*none.so"),
        ({"file": "unit3.fmu"}, r"a shared library \(.so, .dll, .dylib\) or a C file \(.c\) was expected"),
        ({"function": "control"}, r"`.*controller.so` has no function `control`"),
        ({"function": "'1x'"}, r"the name of a C function was expected, got `1x`"),
        ({"file": "wrong.c"}, r"`.*wrong.c` cannot be compiled:\n(.*\n)*.*wrong.c:2"),
        ({"file": "text.so"}, r"the library `.*text.so` cannot be loaded"),
        ({"more": ", process: mine"}, r"process"),
    ],
)
def test_what_is_wrong_with_a_block_is_told_with_its_line(folder, given, said):
    (folder / "wrong.c").write_text("int controller(void)\n{ return 1 }\n", encoding="utf-8")
    (folder / "text.so").write_text("no library", encoding="utf-8")
    with pytest.raises(nivel.ModelError, match=said) as refused:
        machine(folder, **given).start()
    assert "cart.yaml:8" in str(refused.value)


def test_nothing_is_compiled_or_loaded_before_it_is_allowed(folder):
    for file in ("controller.c", "controller.so"):
        done = CliRunner().invoke(main, ["run", str(written(folder, file=file))])
        assert done.exit_code == 2
        assert f"this block runs the machine code of {file}; say --allow-code if you trust it" in " ".join(
            done.output.split()
        )


def test_where_such_a_machine_cannot_go_is_said_in_one_sentence(folder, tmp_path):
    cart = machine(folder)
    with pytest.raises(
        nivel.ModelError, match="a C library cannot have what others have compiled: a C function of the block `unit`"
    ):
        cart.export_c(tmp_path / "c")
    with pytest.raises(
        nivel.ModelError, match="an FMU cannot have what others have compiled: a C function of the block `unit`"
    ):
        cart.export_fmu(tmp_path / "cart.fmu")
    done = CliRunner().invoke(main, ["live", str(written(folder)), "--allow-code", "--no-browser"])
    assert done.exit_code == 2
    assert "a machine with a C function cannot be operated" in " ".join(done.output.split())


def test_a_machine_in_python_and_a_written_file_have_the_same_unit(folder, tmp_path):
    cart = machine(folder)
    cart.save(tmp_path / "again.yaml")
    again = nivel.load(tmp_path / "again.yaml", allow_code=True)
    assert again.record.control == cart.record.control
    block = CBlock(
        name="unit",
        file=str(folder / "controller.so"),
        function="controller",
        sample_time=2e-3,
        inputs={"x": "rail.displacement", "v": "rail.displacement_rate", "fault": 0.0},
        outputs=["u", "integral", "calls"],
        state=[0.0],
    )
    in_python, simulation = cart.replace(block).start(), again.start()
    for each in (in_python, simulation):
        each.advance(0.1)
    assert in_python["rail.displacement"] == simulation["rail.displacement"]


def test_the_example_holds_its_cart(tmp_path):
    """x = reference in the end, whatever pushes: the controller has an integral, which carries the push."""
    for name in ("cart-c.yaml", "controller.c"):
        shutil.copy(EXAMPLES / name, tmp_path)
    result = nivel.load(tmp_path / "cart-c.yaml", allow_code=True).simulate(verify=False)
    assert result.array("rail.displacement")[-1] == pytest.approx(0.3, abs=2e-3)
    assert result.array("control.controller")[-1] == pytest.approx(4.0, abs=0.1)
    np.testing.assert_allclose(
        result.array("control.controller.error")[1:], 0.3 - result.array("rail.displacement")[1:], atol=2e-3
    )
