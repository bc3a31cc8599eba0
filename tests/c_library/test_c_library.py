"""Machines as C libraries: built by the system's compiler, they step as nivel does, to the last bit."""

import csv
import ctypes
import io
import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.demos.catalogue import demo_file
from nivel.results.frames.csv_table import columns

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
    subprocess.run(["make", "-s", "-C", folder, *targets], check=True, capture_output=True, timeout=120)
    return folder


@pytest.mark.parametrize(("file", "settings"), [*(pytest.param(*case, id=name) for name, case in CASES.items()), *DEAR])
def test_the_example_in_c_prints_what_a_run_gives(file, settings, tmp_path):
    machine = nivel.load(EXAMPLES / file).with_settings(settings)
    written = machine.export_c(tmp_path / "c")
    header = (written.folder / f"{written.name}.h").read_text(encoding="utf-8")
    assert f"Written by nivel {nivel.__version__}." in header
    done = subprocess.run([build(written.folder) / "example"], check=True, capture_output=True, text=True, timeout=120)
    names, *rows = csv.reader(io.StringIO(done.stdout))
    result = machine.simulate(output_interval=machine.record.simulation.step)
    count = min(len(rows), len(result.time) - 1)  # the last step of a run ends at its end exactly
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
        nivel.load(EXAMPLES / "mechanisms" / "simple-pendulum.yaml").export_c(tmp_path_factory.mktemp("c") / "c").folder
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


def test_what_a_library_cannot_be_is_refused(tmp_path):
    machine = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml")
    with pytest.raises(nivel.ModelError, match=r"steps of one length.*--integrator rk4"):
        machine.with_settings({"integrator": "dopri5"}).export_c(tmp_path / "c")
    with pytest.raises(nivel.ModelError, match="Python laws cannot go into a C library"):
        nivel.load(EXAMPLES / "vehicles" / "python-law.yaml", allow_code=True).export_c(tmp_path / "c")
    assert not (tmp_path / "c").exists()
    (tmp_path / "c").mkdir()
    with pytest.raises(nivel.ModelError, match="is there already"):
        machine.export_c(tmp_path / "c")


def test_a_crane_steered_from_c_is_that_steered_from_python(tmp_path):
    """Inputs by place and by name, changed between steps and set to the same again, a saved and a restored state: equal to the last bit."""
    machine = nivel.load(demo_file("loader-crane"))
    written = machine.export_c(tmp_path / "c")
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
