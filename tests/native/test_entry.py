"""Entries from a module outside the package, compiled by workers, called by Python and by each other."""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import toy_entries as toys

from nivel.native import library, store
from nivel.native.duals import DUAL, duals
from nivel.native.workers import CompilationError

X = np.array([3.0, 4.0, 5.0])
HERE = Path(__file__).parent


def test_python_calls_it():
    assert toys.squares(X, 1) == 41.0
    assert toys.sine(np.array([0.5])) == math.sin(0.5)


def test_entries_call_each_other_by_address():
    assert toys.twice(toys.squares.address, X) == 82.0


def test_functions_made_of_others_are_told_apart():
    assert toys.made(X, 0) == 27.0 + 64.0 + 125.0 + 1000.0 * 50.0


def test_rows_complex_and_dual_numbers_are_passed():
    x, z, share = X.copy(), duals(X), duals([3.0])
    share["slopes"][0, 4] = 1.0
    assert toys.scale(x, z, 2 + 1j, share) == 3
    np.testing.assert_array_equal(x, 2.0 * X)
    np.testing.assert_array_equal(z["value"], 3.0 * X + 1.0)
    np.testing.assert_array_equal(z["slopes"], np.outer(X, np.eye(7)[4]))
    assert toys.fill(x) is None
    np.testing.assert_array_equal(x, 7.0)


def test_code_on_dual_numbers_returns_slopes():
    x = duals([1.0, 4.0])
    x["slopes"][:, 2] = 1.0, 2.0
    # (1 + s)/(4 + 2 s)
    assert toys.slope_of_share(toys.share_of_duals.address, x) == 1.0 / 4.0 - 2.0 / 16.0


def test_dual_numbers_need_no_alignment():
    """C may hand them over from anywhere."""
    room = np.zeros(3 * DUAL.itemsize + 8, dtype=np.uint8)
    z = room[8:].view(np.float64)[: 3 * 8].view(DUAL)
    z["value"] = X
    assert (z.ctypes.data % DUAL.itemsize) in range(8, DUAL.itemsize)
    toys.scale(X.copy(), z, 1 + 2j, duals([1.0]))
    np.testing.assert_array_equal(z["value"], X + 2.0)


def test_what_raises_is_told():
    assert toys.careful(3) == 3
    with pytest.raises(RuntimeError, match="must not"):
        toys.careful(-1)


@pytest.mark.parametrize("wrong", [np.arange(3), np.zeros((2, 2)), np.arange(6.0)[::2], np.zeros(3, complex)])
def test_other_arrays_are_refused(wrong):
    with pytest.raises(TypeError, match="contiguous row"):
        toys.squares(wrong, 0)
    with pytest.raises(TypeError, match="2 arguments"):
        toys.squares(X)


def test_what_cannot_be_compiled_is_told():
    with pytest.raises(CompilationError, match="missing"):
        assert toys.wrong.address


def test_what_is_compiled_is_found_by_the_next_process():
    assert toys.squares.address
    assert store.read(library._path(toys.squares))
    code = "import toy_entries as t, numpy as np, sys; print(t.squares(np.arange(3.0), 0), 'numba' in sys.modules)"
    assert _run(code).stdout.split() == ["5.0", "False"]


def test_processes_that_compile_the_same_at_once(tmp_path):
    code = "import toy_entries as t, numpy as np; print(t.made(np.arange(3.0), 0))"
    started = [_start(code, tmp_path / "cache") for _ in range(3)]
    answers = [process.communicate() for process in started]
    assert [out.strip() for out, _ in answers] == ["5009.0"] * 3, answers


@pytest.mark.parametrize("damage", [lambda p: p.write_bytes(b"\x7fELF"), lambda p: p.write_bytes(p.read_bytes()[:-9])])
def test_a_damaged_file_is_compiled_again(tmp_path, damage):
    code = "import toy_entries as t, numpy as np; print(t.squares(np.arange(3.0), 0))"
    assert _run(code, tmp_path).stdout.strip() == "5.0"
    (path,) = (tmp_path / "objects").glob("*.o")
    damage(path)
    again = _run(code, tmp_path)
    assert again.stdout.strip() == "5.0"
    assert "is damaged; it is compiled again" in again.stderr
    assert "damaged" not in _run(code, tmp_path).stderr


def test_a_worker_that_dies_is_told(tmp_path):
    code = """
import os, signal
from nivel.native import workers
process = workers.COMPILERS.take()
process._process.send_signal(signal.SIGKILL)
workers.Process.is_alive = True  # it dies as the job comes
workers.COMPILERS.give_back(process)
import toy_entries
try:
    toy_entries.fill.address
except workers.CompilationError as problem:
    print(problem)
"""
    assert "ended with status -9" in _run(code, tmp_path).stdout


def _start(code, cache=None):
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(HERE), *sys.path])}
    if cache is not None:
        environment["NIVEL_CACHE_DIR"] = str(cache)
    return subprocess.Popen(
        [sys.executable, "-c", code], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def _run(code, cache=None):
    process = _start(code, cache)
    out, err = process.communicate()
    assert process.returncode == 0, err
    return subprocess.CompletedProcess(process.args, 0, out, err)


@pytest.mark.parametrize("end", ["", "raise SystemExit(3)", "raise KeyError"])
def test_a_process_ends_as_it_means_to(end):
    """Machine code is not taken away while the interpreter still runs."""
    process = _start(
        f"import toy_entries as t, numpy as np\nt.squares(np.arange(3.0), 0), t.made(np.arange(3.0), 0)\n{end}"
    )
    process.communicate()
    assert process.returncode == {"": 0, "raise SystemExit(3)": 3, "raise KeyError": 1}[end]
