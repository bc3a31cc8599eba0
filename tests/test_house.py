"""Checks of the whole code: import layers, types, and indices of kernels, which run as plain Python in a process of their own."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
BIN = Path(sys.executable).parent
# the longest first, so that it does not end alone; two processes of pytest share two processors with nothing else
CHECKS = {
    "kernels as plain Python": (
        [sys.executable, "-m", "pytest", "-q", "tests/interpreted", "-p", "no:cacheprovider", "-p", "no:seconds"],
        {"NUMBA_DISABLE_JIT": "1"},
    ),
    "types": ([str(BIN / "pyright"), "--pythonpath", sys.executable], {}),
    "import layers": ([str(BIN / "lint-imports")], {}),
}


@pytest.mark.house
@pytest.mark.parametrize("name", CHECKS)
def test_the_whole_code_passes(name):
    command, environment = CHECKS[name]
    own = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    done = subprocess.run(
        command, cwd=ROOT, env={**own, **environment}, capture_output=True, text=True, check=False, timeout=1800
    )
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
