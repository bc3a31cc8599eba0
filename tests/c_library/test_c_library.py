"""Machines as C libraries: built by the system's compiler, they step as nivel does, to the last bit."""

import csv
import ctypes
import io
import math
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.demos import demo_file
from nivel.results.frames.csv_table import columns
from patience import PATIENCE

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
CASES = {
    "explicit": ("mechanisms/slider-crank.yaml", {}),
    "implicit": ("mechanisms/slider-crank.yaml", {"integrator": "generalised-alpha"}),
    "absolute": ("mechanisms/four-bar.yaml", {"coordinates": "absolute"}),
    "friction": ("contact/friction-brake.yaml", {}),
}
DEAR = [
    pytest.param("beams/slider-crank.yaml", {}, marks=pytest.mark.full, id="beams"),
    pytest.param("control/servo-axis.yaml", {"duration": 0.3}, marks=pytest.mark.full, id="control"),
]

pytestmark = pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler")


def build(folder, *targets):
    subprocess.run(["make", "-s", "-C", folder, *targets], check=True, capture_output=True, timeout=PATIENCE)
    return folder


@pytest.mark.parametrize(("file", "settings"), [*(pytest.param(*case, id=name) for name, case in CASES.items()), *DEAR])
def test_the_example_in_c_prints_what_a_run_gives(file, settings, tmp_path):
    machine = nivel.load(EXAMPLES / file).with_settings(settings)
    written = machine.export_c(tmp_path / "c", select="*")
    header = (written.folder / f"{written.name}.h").read_text(encoding="utf-8")
    assert f"Written by nivel {nivel.__version__}." in header
    done = subprocess.run(
        [build(written.folder) / "example"], check=True, capture_output=True, text=True, timeout=PATIENCE
    )
    names, *rows = csv.reader(io.StringIO(done.stdout))
    named = {"integrator": "rk4"} if "integrator" not in machine.record.simulation.model_fields_set else {}
    result = machine.simulate(output_interval=machine.record.simulation.step, **named)
    count = min(len(rows), len(result.time))
    assert count > 900
    assert names == ["time", *columns(result)]
    table = np.array(rows[:count], dtype=float)
    np.testing.assert_array_equal(table[:, 0], result.time[:count])
    for k, name in enumerate(names[1:], start=1):
        found = result.selection(name)
        np.testing.assert_array_equal(table[:, k], result.array(found.variable)[:count, *found.where[1:]], err_msg=name)


@pytest.fixture(scope="module")
def pendulum(tmp_path_factory):
    """The library of the pendulum as Python sees it: functions, and a maker of blocks."""
    folder = (
        nivel.load(EXAMPLES / "mechanisms" / "simple-pendulum.yaml")
        .export_c(tmp_path_factory.mktemp("c") / "c", select="*")
        .folder
    )
    library = ctypes.CDLL(str(build(folder, "libsimple_pendulum.so") / "libsimple_pendulum.so"))
    library.simple_pendulum_size.restype = ctypes.c_size_t
    library.simple_pendulum_time.restype = ctypes.c_double
    library.simple_pendulum_outputs.restype = ctypes.POINTER(ctypes.c_double)
    kept = []

    def block():
        size = library.simple_pendulum_size()
        kept.append(ctypes.create_string_buffer(size + 64))
        return ctypes.c_void_p(-(-ctypes.addressof(kept[-1]) // 64) * 64)

    return library, block


def test_a_machine_is_whole_lines_of_the_cache(pendulum):
    """`aligned_alloc(alignment, size)` is only right where the size is a multiple of the alignment."""
    library, _ = pendulum
    assert library.simple_pendulum_size() % 64 == 0


def outputs(library, machine):
    return library.simple_pendulum_outputs(machine)[:20]


def test_a_saved_state_goes_on_as_it_did(pendulum):
    library, block = pendulum
    machine, copy = block(), block()
    assert library.simple_pendulum_start(machine) == 0
    for _ in range(50):
        assert library.simple_pendulum_step(machine) == 0
    library.simple_pendulum_save(machine, copy)
    runs = []
    for _ in range(2):
        for _ in range(50):
            library.simple_pendulum_step(machine)
        runs.append((library.simple_pendulum_time(machine), outputs(library, machine)))
        library.simple_pendulum_restore(machine, copy)
    assert runs[0] == runs[1]
    assert outputs(library, machine) != runs[0][1]


def test_a_saved_state_goes_on_in_another_block(pendulum):
    """The block that it was saved from is gone by then."""
    library, block = pendulum
    machine, copy, other = block(), block(), block()
    library.simple_pendulum_start(machine)
    for _ in range(50):
        library.simple_pendulum_step(machine)
    library.simple_pendulum_save(machine, copy)
    for _ in range(50):
        library.simple_pendulum_step(machine)
    wanted = outputs(library, machine)
    ctypes.memset(machine, 0xFF, library.simple_pendulum_size())
    library.simple_pendulum_restore(other, copy)
    for _ in range(50):
        assert library.simple_pendulum_step(other) == 0
    assert outputs(library, other) == wanted


def test_machines_beside_each_other_do_not_meet(pendulum):
    library, block = pendulum
    alone, first, second = block(), block(), block()
    for machine in (alone, first, second):
        library.simple_pendulum_start(machine)
    for _ in range(30):
        library.simple_pendulum_step(alone)
    for k in range(30):
        library.simple_pendulum_step(first)
        if k % 2:
            library.simple_pendulum_step(second)
    assert outputs(library, first) == outputs(library, alone)
    assert library.simple_pendulum_time(second) == pytest.approx(library.simple_pendulum_time(first) / 2)


def test_two_exports_are_the_same_files(tmp_path):
    machine = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    first = machine.export_c(tmp_path / "first").folder
    kept = [np.zeros(7 * k) for k in range(3000)]  # memory is elsewhere now
    second = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml").export_c(tmp_path / "second").folder
    names = {path.relative_to(first) for path in first.rglob("*") if path.is_file()}
    assert len(kept) + len(names) > 3010
    assert names == {path.relative_to(second) for path in second.rglob("*") if path.is_file()}
    assert [name for name in names if (first / name).read_bytes() != (second / name).read_bytes()] == []


def test_outputs_are_sensors_joint_coordinates_and_inputs_or_those_selected(tmp_path):
    """And the header says the size of a block and the unit of every output."""
    crane = nivel.load(demo_file("loader-crane")).with_values({"simulation.duration": 1.0})
    written = crane.export_c(tmp_path / "usual")
    joints = {
        "slewing.angle",
        "luffing.angle",
        "folding.angle",
        "telescope.displacement",
        "hook.angle_1",
        "hook.angle_2",
    }
    usual = {"time", *joints, *(f"{name}.rate" for name in joints), *(f"{name}.value" for name in written.inputs)}
    assert {name for name in written.outputs if not name.startswith("sensor.")} == usual
    header = (written.folder / "loader_crane.h").read_text(encoding="utf-8")
    assert f"#define LOADER_CRANE_SIZE {written.size}\n" in header
    assert "LOADER_CRANE_LUFFING_ANGLE_RATE, /* rad/s */" in header
    assert "LOADER_CRANE_NO_VOLUME = 18, /* the volume ... has no fluid left in it, or no room for it */" in header
    chosen = crane.export_c(tmp_path / "chosen", select=["hydraulics.lift.pressure_A", "kinetic_energy"])
    assert chosen.outputs == ("time", "hydraulics.lift.pressure_A", "kinetic_energy")
    with pytest.raises(nivel.ModelError, match="kinetic_energy"):
        crane.export_c(tmp_path / "unknown", select="kinetic_enrgy")


BALL = """\
format: 1
name: ball
gravity: [0, 0, -9.81]
bodies:
  ball: {mass: 1 kg, inertia: [0.1, 0.1, 0.1]}
joints:
  fall: {type: translational, bodies: [ground, ball], point: [0, 0, 0], axis: [0, 0, 1], start: {displacement: 0.5}}
inputs:
  push: {range: [-10, 10], units: N}
forces:
  push: {type: motor, coordinate: fall, effort: push.value}
events:
  low: {when: fall.displacement, direction: falling, stop: true}
  root: {when: 1 + sqrt(1 + push.value)}
simulation: {duration: 1 s, step: 1 ms}
"""


@pytest.fixture(scope="module")
def ball(tmp_path_factory):
    """A ball that falls until an event ends its motion, and has an event without a value where its input is below -1."""
    folder = tmp_path_factory.mktemp("ball")
    (folder / "ball.yaml").write_text(BALL, encoding="utf-8")
    written = nivel.load(folder / "ball.yaml").export_c(folder / "c")
    library = ctypes.CDLL(str(build(written.folder, "libball.so") / "libball.so"))
    library.ball_time.restype = ctypes.c_double
    library.ball_set_input.argtypes = (ctypes.c_void_p, ctypes.c_int, ctypes.c_double)
    memory = ctypes.create_string_buffer(written.size + 64)
    machine = ctypes.c_void_p(-(-ctypes.addressof(memory) // 64) * 64)

    def message(status):
        text = ctypes.create_string_buffer(200)
        library.ball_message(machine, status, text, ctypes.c_size_t(len(text)))
        return text.value.decode()

    yield library, machine, message
    del memory


ENDED, EVENT_NOT_FINITE = 5, 12


def test_an_event_that_stops_the_motion_is_no_failure(ball):
    library, machine, message = ball
    assert library.ball_start(machine) == 0
    steps = 0
    while (status := library.ball_step(machine)) == 0 and steps < 1000:
        steps += 1
    assert status == ENDED
    assert library.ball_time(machine) == pytest.approx(math.sqrt(2 * 0.5 / 9.81), rel=1e-12)
    assert "an event ended the motion at t = 0.319275 s" in message(status)
    reached = library.ball_time(machine)
    assert library.ball_step(machine) == ENDED
    assert library.ball_time(machine) == reached


def test_a_failure_is_a_sentence_with_the_name_of_what_failed(ball):
    library, machine, message = ball
    library.ball_start(machine)
    for _ in range(100):
        library.ball_step(machine)
    assert library.ball_set_input(machine, 0, -2.0) == 0
    assert library.ball_step(machine) == EVENT_NOT_FINITE
    assert message(EVENT_NOT_FINITE) == "stopped at t = 0.1 s: the value of the event root is no longer a number"


WINE = shutil.which("wine64") or shutil.which("wine64", path="/usr/lib/wine")
EMULATED = {
    "aarch64-linux": ("aarch64-linux-gnu-gcc", [shutil.which("qemu-aarch64"), "-L", "/usr/aarch64-linux-gnu"]),
    "x86_64-windows": ("x86_64-w64-mingw32-gcc", [WINE]),
}


@pytest.mark.full
@pytest.mark.compiles
@pytest.mark.parametrize("platform", EMULATED)
def test_on_another_system_it_moves_the_same(platform, tmp_path):
    """By an emulator of the processor, or of Windows."""
    compiler, emulator = EMULATED[platform]
    if not (shutil.which(compiler) and emulator[0]):
        pytest.skip(f"{compiler} and what runs its programs are not installed")
    machine, printed = nivel.load(EXAMPLES / "mechanisms" / "simple-pendulum.yaml"), []
    for name, run in ((platform, emulator), ("x86_64-linux", [])):
        folder = machine.export_c(tmp_path / name, platform=name).folder
        build(folder, *(["CC=cc", "AR=ar"] if name == "x86_64-linux" else []), "example")
        program = next(path for path in (folder / "example.exe", folder / "example") if path.exists())
        own = {**os.environ, "WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all"}
        done = subprocess.run([*run, program], check=True, capture_output=True, text=True, timeout=PATIENCE, env=own)
        printed.append(np.array([line.split(",") for line in done.stdout.splitlines()[1:]], dtype=float))
    assert len(printed[0]) > 1000
    # the arctangent of Windows rounds otherwise
    most = 0.0 if platform == "aarch64-linux" else 2.3e-16
    assert np.abs(printed[0] - printed[1]).max() <= most * np.abs(printed[1]).max()


def test_what_a_library_cannot_be_is_refused(tmp_path):
    machine = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    with pytest.raises(nivel.ModelError, match=r"steps of one length.*--integrator rk4"):
        machine.with_settings({"integrator": "dopri5"}).export_c(tmp_path / "c")
    with pytest.raises(nivel.ModelError, match="Python laws cannot go into a C library"):
        nivel.load(EXAMPLES / "vehicles" / "python-law.yaml", allow_code=True).export_c(tmp_path / "c")
    with pytest.raises(nivel.ModelError, match="did you mean `aarch64-linux`"):
        machine.export_c(tmp_path / "c", platform="aarch64")
    assert not (tmp_path / "c").exists()
    (tmp_path / "c").mkdir()
    with pytest.raises(nivel.ModelError, match="is there already"):
        machine.export_c(tmp_path / "c")


def test_a_crane_steered_from_c_is_that_steered_from_python(tmp_path):
    """Inputs by place and by name, changed between steps and set to the same again, a saved and a restored state: equal to the last bit."""
    machine = nivel.load(demo_file("loader-crane"))
    written = machine.export_c(tmp_path / "c", select="*")
    assert written.inputs == ("slew_lever", "lift_lever", "jib_lever", "extension_lever")
    library = ctypes.CDLL(str(build(written.folder, "libloader_crane.so") / "libloader_crane.so"))
    library.loader_crane_size.restype = ctypes.c_size_t
    library.loader_crane_outputs.restype = ctypes.POINTER(ctypes.c_double)
    library.loader_crane_input.restype = ctypes.c_double
    library.loader_crane_set_input.argtypes = (ctypes.c_void_p, ctypes.c_int, ctypes.c_double)
    size = library.loader_crane_size()
    kept = [ctypes.create_string_buffer(size + 64) for _ in range(2)]
    crane, copy = (ctypes.c_void_p(-(-ctypes.addressof(each) // 64) * 64) for each in kept)
    lift = library.loader_crane_find_input(b"lift_lever")
    assert (lift, library.loader_crane_find_input(b"nothing")) == (1, -1)
    assert library.loader_crane_start(crane) == 0
    simulation = machine.start()
    steered = {0: {"lift_lever": 0.5, "slew_lever": -0.3}, 40: {"lift_lever": 0.5}, 60: {"lift_lever": -0.2}}
    for k in range(100):
        for name, value in steered.get(k, {}).items():
            assert library.loader_crane_set_input(crane, written.inputs.index(name), value) == 0
        simulation.step(steered.get(k))
        assert library.loader_crane_step(crane) == 0
        if k == 59:
            library.loader_crane_save(crane, copy)
    names = [name for name in written.outputs[1:] if name in simulation]
    found = dict(zip(written.outputs, library.loader_crane_outputs(crane)[: len(written.outputs)], strict=True))
    assert len(names) > 100
    assert {name: found[name] for name in names} == {name: simulation[name] for name in names}
    assert abs(found["luffing.angle"]) > 1e-5
    assert library.loader_crane_input(crane, lift) == -0.2
    assert math.isnan(library.loader_crane_input(crane, 2))  # never set
    for input, value in ((lift, 1.1), (lift, math.nan), (4, 0.0), (-1, 0.0)):
        assert library.loader_crane_set_input(crane, input, value) == -1
    library.loader_crane_restore(crane, copy)
    assert library.loader_crane_input(crane, lift) == 0.5
    library.loader_crane_set_input(crane, lift, -0.2)
    for _ in range(40):
        library.loader_crane_step(crane)
    assert library.loader_crane_outputs(crane)[: len(written.outputs)] == list(found.values())
