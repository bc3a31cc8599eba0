"""Machines as FMUs, called by a host of a few lines: they move as nivel does, to the last bit."""

import gc
import math
import os
import platform
import runpy
import shutil
import subprocess
import threading
import zipfile
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
import shipped_library
from fmu_host import DISCARD, ERROR, OK, Unit
from needing import needs
from nivel.analysis.plan.compilation import run_entries
from nivel.cli import main
from nivel.demos import demo_file
from nivel.fmu.writer import base_unit
from nivel.native import library, shipped
from nivel.native.sources import fingerprint
from patience import PATIENCE

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"

pytestmark = pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler")

BALL = """\
format: 1
name: ball
gravity: [0, 0, -9.81]
bodies:
  ball: {mass: 2 kg, inertia: [0.1, 0.1, 0.1]}
joints:
  fall: {type: translational, bodies: [ground, ball], point: [0, 0, 0], axis: [0, 0, 1], start: {displacement: 0.5}}
inputs:
  push: {range: [-10, 40], units: N, description: "upwards < & >"}
states:
  count: {update: count.value + 1, every: 10 ms}
forces:
  push: {type: motor, coordinate: fall, effort: push.value}
events:
  low: {when: fall.displacement, direction: falling, stop: true}
  root: {when: 1 + sqrt(1 + push.value)}
sensors:
  height: {value: fall.displacement}
simulation: {duration: 1 s, step: 1 ms}
"""


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """written(machine, name, **options): the unit of a machine, unpacked."""

    def write(machine, name, **options):
        folder = tmp_path_factory.mktemp(name)
        machine.export_fmu(folder / f"{name}.fmu", **options)
        return Unit(folder / f"{name}.fmu", folder / "unpacked")

    return write


@pytest.fixture(scope="module")
def ball_machine(tmp_path_factory):
    path = tmp_path_factory.mktemp("machine") / "ball.yaml"
    path.write_text(BALL, encoding="utf-8")
    return nivel.load(path)


@pytest.fixture(scope="module")
def ball(written, ball_machine):
    return written(ball_machine, "ball", select=["sensor.height", "fall.displacement.rate", "state.count"])


@pytest.fixture(scope="module")
def ball_2(written, ball_machine):
    return written(ball_machine, "ball_2", fmi=2, select=["sensor.height", "fall.displacement.rate", "state.count"])


@pytest.fixture(scope="module")
def crank_machine():
    return nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml")


@pytest.fixture(scope="module")
def crank(written, crank_machine):
    return written(crank_machine, "crank", select="*", parameters=["bodies.slider.mass", "crank.mass"])


def in_python(simulation, name):
    """The number of this name, which may be a component of an array."""
    if name in simulation:
        return float(simulation[name])
    owner, _, part = name.rpartition(".")
    return float(np.ravel(simulation[owner])["xyz".index(part) if part in "xyz" else int(part)])


def levers(t):
    return {"lift_lever": 0.6 * math.sin(3.0 * t), "slew_lever": 0.3}


@pytest.mark.parametrize(
    ("file", "steps", "inputs", "fmi"),
    [
        pytest.param("mechanisms/slider-crank.yaml", 200, None, 3, id="loop"),
        pytest.param("crane", 100, levers, 3, id="crane"),
        pytest.param("crane", 100, levers, 2, id="crane-2"),
        pytest.param("contact/friction-brake.yaml", 200, None, 2, id="contact", marks=pytest.mark.full),
        pytest.param("contact/rolling-coin.yaml", 200, None, 3, id="rolling", marks=pytest.mark.full),
        pytest.param("beams/bend-45.yaml", 6, None, 3, id="beam", marks=pytest.mark.full),
        pytest.param("control/servo-axis.yaml", 200, None, 3, id="sampled", marks=pytest.mark.full),
    ],
)
def test_every_output_is_that_of_a_simulation_in_python(written, file, steps, inputs, fmi):
    machine = nivel.load(demo_file("loader-crane") if file == "crane" else EXAMPLES / file)
    agree(written(machine, "unit", select="*", fmi=fmi), machine, steps, inputs)


@pytest.mark.full
def test_a_flexible_body_moves_as_in_python(written, tmp_path):
    needs("gmsh", "skfem")
    folder = shutil.copytree(EXAMPLES / "flexible", tmp_path / "flexible", ignore=shutil.ignore_patterns("*.nc"))
    done = CliRunner().invoke(
        main, ["reduce", str(folder / "pendulum-bar.yaml"), "--out", str(folder / "pendulum-bar.nc")]
    )
    assert done.exit_code == 0, done.output
    machine = nivel.load(folder / "pendulum.yaml")
    agree(written(machine, "unit", select="*"), machine, 100, None)


def agree(unit, machine, steps, inputs):
    """Every output of a unit is that of `sim.step` after each quarter of the steps, to the last bit."""
    instance, simulation = unit.instance().start(), machine.start()
    h, names = machine.simulation.step, unit.of("output")
    assert len(names) > 50
    for k in range(steps):
        values = inputs(k * h) if inputs else {}
        instance.set(values)
        assert instance.step(k * h, h) == OK
        simulation.step(values)
        if k % (steps // 4) == steps // 4 - 1:
            found = instance.get(names)
            assert found == {name: in_python(simulation, name) for name in names}
    first = simulation.names[0] if not inputs else "luffing.angle"
    assert np.any(np.ravel(simulation[first]) != 0.0)


def test_two_exports_are_the_same_file_which_others_can_read(tmp_path, crank_machine):
    for name in ("first", "second"):
        nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml").export_fmu(tmp_path / f"{name}.fmu")
    assert (tmp_path / "first.fmu").read_bytes() == (tmp_path / "second.fmu").read_bytes()
    with zipfile.ZipFile(tmp_path / "first.fmu") as packed:
        assert {each.external_attr >> 16 for each in packed.infolist()} == {0o644}
        names = packed.namelist()
        own = packed.read("documentation/licenses/license.txt").decode()
        assert "Numba" in packed.read("documentation/licenses/numba.txt").decode()
    assert own == (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert names[0] == "modelDescription.xml"
    assert "binaries/x86_64-linux/slider_crank.so" in names or "x86_64" not in str(names)


def test_outputs_are_sensors_and_joint_coordinates_and_inputs_are_inputs(written, ball_machine):
    unit = written(ball_machine, "usual")
    assert unit.of("output") == ["fall.displacement", "fall.displacement.rate", "sensor.height"]
    assert unit.of("input") == ["push"]
    push = unit.variables["push"]
    assert [push.get(key) for key in ("start", "min", "max", "unit")] == ["0.0", "-10.0", "40.0", "N"]
    assert push.get("description") == "upwards < & >"
    assert unit.variables["fall.displacement.rate"].get("unit") == "m/s"


@pytest.mark.parametrize(
    ("name", "base"),
    [
        ("N m", {"kg": "1", "m": "2", "s": "-2"}),
        ("rad/s", {"rad": "1", "s": "-1"}),
        ("m^3/(s*Pa)", {"kg": "-1", "m": "4", "s": "1"}),
        ("V", {"kg": "1", "m": "2", "s": "-3", "A": "-1"}),
        ("bar", {"kg": "1", "m": "-1", "s": "-2", "factor": "100000.0"}),
        ("1/s", {"s": "-1"}),
        ("kg^0.5 m", None),
        ("pieces of eight", None),
    ],
)
def test_units_are_said_in_the_bases_of_the_standard(name, base):
    assert base_unit(name) == base


@pytest.mark.parametrize("unit", ["ball", "ball_2"])
def test_a_state_goes_on_in_the_same_and_in_another_instance(unit, request):
    unit = request.getfixturevalue(unit)
    names = unit.of("output")
    first = unit.instance().start({"push": 3.0})
    for k in range(50):
        first.step(1e-3 * k, 1e-3)
    state = first.state()
    content = first.serialised(state)

    def on(instance):
        for k in range(50, 150):
            assert instance.step(1e-3 * k, 1e-3) == OK
        return instance.get([*names, "push"])

    wanted = on(first)
    assert first.restore(state) == OK
    assert on(first) == wanted
    first.free_state(state)
    other = unit.instance().start()
    kept = other.deserialised(content)
    assert other.restore(kept) == OK
    assert on(other) == wanted
    assert wanted["push"] == 3.0
    assert other.serialised(kept) == content  # nothing of where it stands in memory
    assert other.deserialised(content[:-8]) is None
    assert other.deserialised(b"another" + content[7:]) is None
    assert "the state is of another machine" in other.messages[-1]


def test_a_unit_that_does_not_belong_to_its_description_is_refused(ball):
    refused = ball.instance(token=b"{another}")
    assert refused.pointer is None
    assert "machine.bin: it is of another FMU than modelDescription.xml" in refused.messages[0]


def test_damaged_numbers_are_refused(ball, tmp_path):
    folder = tmp_path / "unit"
    shutil.copytree(ball.folder, folder)
    content = bytearray((folder / "resources" / "machine.bin").read_bytes())
    content[len(content) // 2] ^= 1
    (folder / "resources" / "machine.bin").write_bytes(content)
    other = Unit.__new__(Unit)
    other.__dict__.update({**ball.__dict__, "folder": folder})
    assert "machine.bin: it is damaged" in other.instance().messages[0]


def test_a_thousand_states_and_ten_thousand_steps_take_no_memory(ball):
    """Set, step and get, with a state kept, serialised and restored at every tenth."""
    instance = ball.instance().start()

    def cycles(count):
        first, content = instance.state(), b""
        for k in range(count):
            instance.set({"push": 19.62 + 0.01 * (k % 2)})
            assert instance.step(instance.get(["time"])["time"], 1e-3) == OK
            instance.get(ball.of("output"))
            if k % 10 == 0:
                state = instance.state()
                content = instance.serialised(state)
                instance.free_state(instance.deserialised(content))
                instance.restore(state)
                instance.free_state(state)
        instance.restore(first)
        instance.free_state(first)
        return len(content)

    def resident():
        gc.collect()
        return 4096 * int(Path("/proc/self/statm").read_text().split()[1])

    cycles(2000)
    before = resident()
    size = cycles(10_000)
    assert size > 20_000
    assert resident() - before < 1_000_000  # one state of a thousand that stays would be ten times as much


def test_instances_in_threads_do_not_meet(crank):
    names = crank.of("output")
    instances = [crank.instance().start() for _ in range(5)]

    def run(instance):
        for k in range(200):
            instance.step(1e-3 * k, 1e-3)

    threads = [threading.Thread(target=run, args=(each,)) for each in instances[:4]]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    run(instances[4])
    wanted = instances[4].get(names)
    assert [each.get(names) for each in instances[:4]] == [wanted] * 4
    for each in instances:
        each.close()


@pytest.mark.parametrize("length", [2.5e-3, 0.7e-3, 1e-3 / 3, 4e-3, 1e-3])
def test_any_communication_step_follows_the_motion_and_takes_samples_at_their_times(ball, length):
    """x = 1/2 + (F/m - g) t²/2 is exact for the integrator. A sample is taken every 10 ms from t = 0 on."""
    instance = ball.instance().start({"push": 4.0})
    count = round(0.1 / length)
    for k in range(count):
        assert instance.step(k * length, length) == OK
        assert instance.last == pytest.approx((k + 1) * length, rel=1e-12)
    t = count * length
    found = instance.get(["time", "sensor.height", "state.count"])
    assert found["time"] == pytest.approx(t, rel=1e-12)
    assert found["sensor.height"] == pytest.approx(0.5 + (4.0 / 2.0 - 9.81) * t**2 / 2.0, rel=1e-12)
    assert found["state.count"] == math.floor(t / 10e-3 + 1e-6) + 1


def test_times_of_a_host_that_sums_steps_drift_and_do_no_harm(ball):
    """20 s of steps of 1 ms by addition end 1e-11 s beside 20 s; the unit stays on its grid."""
    instance, now = ball.instance().start({"push": 19.62}), 0.0
    for _ in range(20_000):
        assert instance.step(now, 1e-3) == OK
        now += 1e-3
    assert now != 20.0
    assert instance.get(["time", "state.count"]) == {"time": 20.0, "state.count": 2001.0}


def test_the_time_of_a_unit_begins_at_the_start_time(ball):
    instance = ball.instance().start(at=5.0)
    assert instance.get(["time"]) == {"time": 5.0}
    assert instance.step(5.0, 0.1) == OK
    assert instance.get(["sensor.height"])["sensor.height"] == pytest.approx(0.5 - 9.81 * 0.1**2 / 2.0, rel=1e-12)
    assert instance.step(5.0, 0.1) == ERROR
    assert "a step from 5 s on, but it is at 5.1 s" in instance.messages[-1]


FALL = math.sqrt(2 * 0.5 / 9.81)


@pytest.mark.parametrize("early", [True, False])
def test_an_event_that_ends_the_motion_returns_early_at_its_time(ball, early):
    instance = ball.instance(early=early).start()
    assert instance.step(0.0, 0.5) == OK
    assert (instance.ended, instance.early) == (True, early)
    assert instance.last == pytest.approx(FALL, rel=1e-12)
    assert instance.get(["time", "sensor.height"]) == pytest.approx({"time": FALL, "sensor.height": 0.0}, abs=1e-12)


def test_by_the_second_version_the_step_in_which_the_motion_ends_is_discarded(ball_2):
    instance = ball_2.instance().start()
    assert instance.step(0.0, 0.3) == OK
    assert not instance.ended
    assert instance.step(0.3, 0.3) == DISCARD
    assert instance.ended
    assert instance.last == pytest.approx(FALL, rel=1e-12)


@pytest.mark.parametrize("unit", ["ball", "ball_2"])
def test_a_failure_is_a_sentence_of_nivel(unit, request):
    instance = request.getfixturevalue(unit).instance().start()
    instance.step(0.0, 0.1)
    instance.set({"push": -2.0})
    assert instance.step(0.1, 0.01) == ERROR
    assert instance.messages == ["unit: stopped at t = 0.1 s: the value of the event root is no longer a number"]
    assert instance.try_set({"push": 50.0}) == ERROR
    assert "an input of 50, which is not within -10 and 40" in instance.messages[-1]
    instance.checked("Reset")
    assert instance.start().step(0.0, 0.01) == OK


def test_parameters_are_those_of_a_machine_with_other_values(crank, crank_machine):
    """The unit has formulas of them; the machine in Python is prepared with them. Without them nothing changes, to the last bit."""
    values = {"bodies.slider.mass": 20.0, "crank.mass": 15.0}
    assert crank.of("parameter") == [*values]
    assert crank.variables["crank.mass"].get("unit") == "kg"
    assert crank.variables["crank.mass"].get("min") == "0.0" or float(crank.variables["crank.mass"].get("min")) < 1e-200
    names = [name for name in crank.of("output") if "violation" not in name]
    instance, machine = crank.instance().start(values), crank_machine.with_values(values)
    simulation = machine.start()
    assert instance.get([*values]) == values
    for k in range(300):
        assert instance.step(1e-3 * k, 1e-3) == OK
        simulation.step()
    found = np.array([*instance.get(names).values()])
    wanted = np.array([in_python(simulation, name) for name in names])
    assert np.abs(found - wanted).max() < 1e-9 * np.abs(wanted).max()
    assert found[names.index("energy_error")] == pytest.approx(wanted[names.index("energy_error")], abs=1e-9)
    assert instance.try_set({"crank.mass": 16.0}) == ERROR
    assert "parameters are set before the end of the initialisation" in instance.messages[-1]
    fresh = crank.instance()
    fresh.enter(0.0)
    assert fresh.try_set({"crank.mass": -1.0}) == ERROR
    assert fresh.try_set({"crank.mass": math.nan}) == ERROR


def test_what_would_need_an_assembly_is_refused_by_name(tmp_path, crank_machine):
    with pytest.raises(nivel.ModelError) as refused:
        crank_machine.export_fmu(
            tmp_path / "a.fmu", parameters=["rod.position.0", "crank.mas", "simulation.integrator", "crank.mass"]
        )
    text = str(refused.value)
    assert "simulation.integrator" in text
    assert "crank.mas" in text
    with pytest.raises(nivel.ModelError, match=r"rod.position.0.*cannot be a parameter of an FMU.*assembled again"):
        crank_machine.export_fmu(tmp_path / "a.fmu", parameters=["rod.position.0", "crank.mass"])
    assert not (tmp_path / "a.fmu").exists()


def test_parameters_that_only_act_together_are_refused(tmp_path):
    """The coefficient of the motor's effort is the product of both."""
    (tmp_path / "two.yaml").write_text(
        "parameters: {a: 2, b: 3}\n" + BALL.replace("effort: push.value", "effort: 'a*b*push.value + a*b'"),
        encoding="utf-8",
    )
    machine = nivel.load(tmp_path / "two.yaml")
    machine.export_fmu(tmp_path / "one.fmu", parameters="parameters.a")
    with pytest.raises(
        nivel.ModelError, match=r"`parameters.a` and `parameters.b` cannot be parameters of an FMU together"
    ):
        machine.export_fmu(tmp_path / "both.fmu", parameters=["parameters.a", "parameters.b"])


CART = """
format: 1
name: cart
parameters: {ki: 0, kd: 0, damping: 0, load: 2}
bodies:
  cart: {mass: load + 1, inertia: [1, 1, 1]}
joints:
  rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 0}}
forces:
  drive: {type: motor, coordinate: rail, effort: axis}
  drag: {type: joint-spring-damper, coordinate: rail.displacement, stiffness: 10, damping: damping}
control:
  axis: {type: pid, reference: 0.1, measured: rail.displacement, kp: 300, ki: ki, kd: kd, filter_time: 1 ms, sample_time: 2 ms, units: N}
simulation: {duration: 0.2, step: 1 ms, integrator: rk4}
"""


def test_gains_damping_and_masses_are_parameters_from_zero(written, tmp_path):
    """The machine with gains of zero lacks the states that they need; its unit has them."""
    path = tmp_path / "cart.yaml"
    path.write_text(CART, encoding="utf-8")
    machine, names = nivel.load(path), ["rail.displacement", "rail.displacement.rate"]
    paths = [f"parameters.{name}" for name in ("ki", "kd", "damping", "load")]
    unit = written(machine, "cart", select=names, parameters=paths)
    assert [float(unit.variables[path].get("start")) for path in paths] == [0.0, 0.0, 0.0, 2.0]
    assert [float(unit.variables[path].get("min")) for path in paths] == [-1e300, -1e300, 0.0, 0.0]
    for values in (dict(zip(paths, (400.0, 20.0, 3.0, 5.0), strict=True)), {paths[1]: 30.0}, {}):
        instance, simulation = unit.instance().start(values), machine.with_values(values).start()
        for k in range(200):
            assert instance.step(1e-3 * k, 1e-3) == OK
            simulation.step()
        found, wanted = instance.get(names), {name: in_python(simulation, name) for name in names}
        assert found == pytest.approx(wanted, rel=1e-11, abs=1e-13)


def test_the_command_says_what_it_wrote_and_what_is_wrong(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ball.yaml").write_text(BALL, encoding="utf-8")
    run = CliRunner()
    done = run.invoke(main, ["export", "ball.yaml", "--fmu", "--fmi", "2", "--parameter", "bodies.ball.mass"])
    assert done.exit_code == 0, done.output
    assert "FMU: ball.fmu, FMI 2.0 co-simulation for" in done.output
    assert "1 inputs, 3 outputs, 1 parameters" in done.output
    again = run.invoke(main, ["export", "ball.yaml", "--fmu", "ball.fmu"])
    assert again.exit_code == 2
    assert "exists already; use --force" in again.output
    for words, said in (
        (["--fmu", "--csv"], "is written at a time"),
        (["--csv", "--fmi", "3"], "--fmi belongs to --fmu"),
        (["--fmu", "a.fmu", "--set", "simulation.integrator=dopri5"], "an FMU takes steps of one length"),
        (["--fmu", "a.fmu", "--select", "sensor.hight"], "sensor.height"),
    ):
        done = run.invoke(main, ["export", "ball.yaml", *words])
        assert done.exit_code == 2, words
        assert said in done.output


def test_a_missing_compiler_is_named(tmp_path, monkeypatch, ball_machine):
    monkeypatch.setenv("CC", "no-such-compiler")
    with pytest.raises(
        nivel.ModelError, match="the C compiler `no-such-compiler` that builds this FMU is not installed"
    ):
        ball_machine.export_fmu(tmp_path / "a.fmu")
    with pytest.raises(nivel.ModelError, match="x86_64-linux"):
        ball_machine.export_fmu(tmp_path / "a.fmu", platforms="x86-64-linux")


def test_the_binary_of_a_wheel_needs_no_compiler(tmp_path, monkeypatch, ball_machine, ball):
    """It is linked as the wheel's is, of the entries of one machine for two levels."""
    entries = dict.fromkeys(run_entries(ball_machine._plan({}, stepwise=True)))
    levels = shipped_library.levels(platform.machine())
    for level in levels:
        (tmp_path / level).mkdir()
        for entry in entries:
            (tmp_path / level / f"{entry.symbol}.o").write_bytes(library.object_code(entry))
    monkeypatch.setattr(shipped, "FOLDER", tmp_path / "shipped")
    shipped.FOLDER.mkdir()
    shipped_library.link_unit(tmp_path, f"{platform.machine()}-linux")
    sources = {entry.name: fingerprint(entry.name) for entry in entries}
    monkeypatch.setattr(shipped, "manifest", lambda: {"levels": [], "entries": sources})
    (shipped.FOLDER / "NOTICE").write_text("of Numba", encoding="utf-8")
    monkeypatch.setenv("CC", "no-such-compiler")
    ball_machine.export_fmu(tmp_path / "ball.fmu", select="sensor.height")
    unit = Unit(tmp_path / "ball.fmu", tmp_path / "unpacked")
    (binary,) = (unit.folder / "binaries").rglob("*.so")
    assert binary.read_bytes() == shipped.unit_for(f"{platform.machine()}-linux", entries).read_bytes()
    found = []
    for each in (unit, ball):
        instance = each.instance().start({"push": 4.0})
        assert instance.step(0.0, 0.1) == OK
        found.append(instance.get(["sensor.height"]))
    assert found[0] == found[1]
    changed = dict.fromkeys(sources, "of other sources")
    monkeypatch.setattr(shipped, "manifest", lambda: {"levels": [], "entries": changed})
    with pytest.raises(nivel.ModelError, match="no-such-compiler"):
        ball_machine.export_fmu(tmp_path / "other.fmu")


WINE = shutil.which("wine64") or shutil.which("wine64", path="/usr/lib/wine")


@pytest.mark.full
@pytest.mark.compiles
@pytest.mark.skipif(not (shutil.which("x86_64-w64-mingw32-gcc") and WINE), reason="there is no Windows beside Linux")
def test_on_windows_it_moves_as_on_linux_to_the_last_bit(tmp_path):
    """By wine, after 200 steps; compiled for each processor with AVX2."""
    machine = nivel.load(EXAMPLES / "mechanisms" / "simple-pendulum.yaml")
    machine.export_fmu(tmp_path / "unit.fmu", platforms=["x86_64-linux", "x86_64-windows"], select="*")
    unit = Unit(tmp_path / "unit.fmu", tmp_path / "unpacked")
    host = tmp_path / "host.exe"
    source = Path(__file__).with_name("windows_host.c")
    subprocess.run(["x86_64-w64-mingw32-gcc", "-O1", source, "-o", host], check=True)
    (binary,) = (unit.folder / "binaries").rglob("*.dll")
    names = unit.of("output")
    command = [
        WINE,
        host,
        binary,
        unit.folder / "resources",
        "0.001",
        "200",
        *(str(unit.reference[name]) for name in names),
    ]
    own = {**os.environ, "WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all"}
    printed = subprocess.run(command, check=True, capture_output=True, text=True, env=own, timeout=PATIENCE).stdout
    instance = unit.instance().start()
    for k in range(200):
        instance.step(1e-3 * k, 1e-3)
    assert [float(line) for line in printed.split()] == [*instance.get(names).values()]


@pytest.mark.full
def test_the_example_in_another_program_moves_as_here(tmp_path):
    needs("fmpy")
    main_of = runpy.run_path(str(EXAMPLES / "exchange" / "loader_crane_fmu.py"))["main"]
    by_fmpy, by_nivel = main_of(tmp_path / "loader-crane.fmu")
    assert by_fmpy == by_nivel
    assert by_fmpy > 0.01


@pytest.mark.full
@pytest.mark.parametrize("fmi", [3, 2])
def test_another_program_finds_no_fault_and_the_same_motion(tmp_path, fmi, ball_machine):
    fmpy, validation = needs("fmpy"), needs("fmpy.validation")
    path = tmp_path / "ball.fmu"
    ball_machine.export_fmu(path, fmi=fmi, parameters="ball.mass")
    assert validation.validate_fmu(str(path)) == []
    found = fmpy.simulate_fmu(
        str(path), stop_time=0.2, output_interval=1e-2, start_values={"ball.mass": 4.0, "push": 8.0}
    )
    assert found["sensor.height"][-1] == pytest.approx(0.5 + (8.0 / 4.0 - 9.81) * 0.2**2 / 2.0, rel=1e-12)
