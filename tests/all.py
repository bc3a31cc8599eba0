"""Everything that must hold before a change is taken: style, types, import layers, then all tests on compiled kernels.

Kernels are compiled once with bounds checking, serially, before pytest starts its processes: they share the cache.
"""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PYTHON = [sys.executable, "-m"]


def run(name, command, **environment):
    print(f"== {name}", flush=True)
    code = subprocess.run(command, cwd=ROOT, env={**os.environ, **environment}, check=False).returncode
    if code:
        sys.exit(f"{name} failed ({code})")


def main():
    bin_folder = Path(sys.executable).parent
    run("ruff check", [*PYTHON, "ruff", "check", "."])
    run("ruff format", [*PYTHON, "ruff", "format", "--check", "."])
    run("import layers", [str(bin_folder / "lint-imports")])
    run("pyright", [str(bin_folder / "pyright"), "--pythonpath", sys.executable])
    checked = {"NUMBA_BOUNDSCHECK": "1"}
    run("compile with bounds checking", [*PYTHON, "nivel", "warmup"], **checked)
    run("pytest", [*PYTHON, "pytest", "-n", "2", "-q", *sys.argv[1:]], **checked)


if __name__ == "__main__":
    main()
