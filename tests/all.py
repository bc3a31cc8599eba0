"""Everything that must hold before a change is taken: style, types, import layers, indices of kernels, then all tests.

    python tests/all.py [--full] [arguments of pytest]

Without `--full` what is marked `full` rests: the tails of grids, see `pyproject.toml`. Kernels are compiled before pytest starts its
processes, which share the cache; a test that still compiles one fails. Indices are checked where kernels run as plain
Python, see `tests/interpreted`. What needs no compiled kernel runs beside the rest.
"""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PYTHON = [sys.executable, "-m"]
BIN = Path(sys.executable).parent


def run(name, command, **environment):
    """Run a command, and say that it failed or nothing."""
    print(f"== {name}", flush=True)
    code = subprocess.run(command, cwd=ROOT, env={**os.environ, **environment}, check=False).returncode
    return f"{name} failed ({code})" if code else ""


def run_beside():
    """What needs no compiled kernel, with its output kept together."""
    plain = {"NUMBA_DISABLE_JIT": "1"}
    failures = []
    for name, command, environment in (
        ("import layers", [str(BIN / "lint-imports")], {}),
        ("pyright", [str(BIN / "pyright"), "--pythonpath", sys.executable], {}),
        ("kernels as plain Python", [*PYTHON, "pytest", "-q", "tests/interpreted", "-p", "no:cacheprovider"], plain),
    ):
        done = subprocess.run(
            command,
            cwd=ROOT,
            env={**os.environ, **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        if done.returncode:
            failures.append(f"{name} failed ({done.returncode})")
        print(f"== {name}\n{done.stdout}", flush=True)
    return failures


def main():
    arguments = [each for each in sys.argv[1:] if each != "--full"]
    everything = "--full" in sys.argv
    chosen = [] if everything else ["-m", "not full"]
    own = {"NIVEL_TESTS_ARE_COMPILED": "1", "NIVEL_TESTS_FULL": "1" if everything else "0"}
    # two processes whose linear algebra takes two threads each wait for each other
    own |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    for name, more in (("ruff check", ["check", "."]), ("ruff format", ["format", "--check", "."])):
        if failure := run(name, [*PYTHON, "ruff", *more]):
            sys.exit(failure)
    with ThreadPoolExecutor(1) as beside:
        failure = run("compile", [*PYTHON, "nivel", "warmup"])  # on all processors
        others = beside.submit(run_beside)
        if not failure:
            tests = [*PYTHON, "pytest", "-n", "2", "--dist", "worksteal", "-q", "--durations=10", *chosen, *arguments]
            failure = run("pytest", tests, **own)
        failures = [*others.result(), failure]
    if any(failures):
        sys.exit("\n".join(each for each in failures if each))


if __name__ == "__main__":
    main()
