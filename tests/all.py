"""Everything that must hold before a change is taken: style, kernels compiled, then all tests, two at a time.

    python tests/all.py [--full] [--keep-seconds] [--keep-checks] [arguments of pytest]

Without `--full` what is marked `full` rests: the tails of grids, see `pyproject.toml`. Kernels are compiled before pytest starts its
processes, which share the cache; a test that still compiles one fails. Types, import layers and indices of kernels are tests as well
(`tests/test_house.py`), so that never more than two processes run. The seconds of every file are compared with `tests/seconds.json`,
which `--keep-seconds` replaces; `--keep-checks` replaces `tests/checked.json`, which says of which sources the types and the
kernels as plain Python were right.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import rooms
from seconds import KEPT, told

ROOT = Path(__file__).resolve().parent.parent
PYTHON = [sys.executable, "-m"]
OWN = ("--full", "--keep-seconds", "--keep-checks")


def run(name, command, **environment):
    """Run a command; its exit code."""
    print(f"== {name}", flush=True)
    return subprocess.run(command, cwd=ROOT, env={**os.environ, **environment}, check=False).returncode


def compare_seconds(path, keep):
    """Print what the files of tests took, and what grew; keep the seconds where that is asked for."""
    if not path.exists():
        return
    now = json.loads(path.read_text(encoding="utf-8"))
    before = json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}
    print("== seconds", *told(now, before), sep="\n", flush=True)
    if keep:
        KEPT.write_text(path.read_text(encoding="utf-8") + "\n", encoding="utf-8")


def keep_checks():
    """Keep the digests that the tests of the whole code left in pytest's cache where they passed."""
    cache = ROOT / ".pytest_cache" / "v"
    digests = {name: json.loads((cache / name).read_text(encoding="utf-8")) for name in (rooms.TYPES, rooms.KERNELS)}
    rooms.KEPT.write_text(json.dumps(digests, indent=1) + "\n", encoding="utf-8")


def main():
    arguments = [each for each in sys.argv[1:] if each not in OWN]
    everything = "--full" in sys.argv
    chosen = [] if everything else ["-m", "not full"]
    own = {"NIVEL_TESTS_ARE_COMPILED": "1", "NIVEL_TESTS_FULL": "1" if everything else "0"}
    # two processes whose linear algebra takes two threads each wait for each other
    own |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    with tempfile.TemporaryDirectory() as folder:
        taken = Path(folder) / "seconds.json"
        own["NIVEL_TESTS_SECONDS"] = str(taken)
        if os.environ.get("PYTHONDONTWRITEBYTECODE"):
            # some hundred processes start: each would translate the package and its libraries anew
            os.environ |= {"PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": str(Path(folder) / "bytecode")}
        tests = [
            "pytest",
            "-p",
            "seconds",
            "-n",
            "2",
            "--dist",
            "worksteal",
            "-q",
            "--durations=10",
            *chosen,
            *arguments,
        ]
        for name, command, environment in (
            ("ruff check", ["ruff", "check", "."], {}),
            ("ruff format", ["ruff", "format", "--check", "."], {}),
            ("compile", ["nivel", "warmup"], {}),  # on all processors
            ("pytest", tests, own),
        ):
            code = run(name, [*PYTHON, *command], **environment)
            if name == "pytest":
                compare_seconds(taken, "--keep-seconds" in sys.argv)
            if code:
                sys.exit(f"{name} failed ({code})")
    if "--keep-checks" in sys.argv:
        keep_checks()


if __name__ == "__main__":
    main()
