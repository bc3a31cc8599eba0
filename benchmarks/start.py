"""Processor time of whole commands as ratios to that of `python -c "import numpy"`, least of several rounds by turns.

    OMP_NUM_THREADS=1 python benchmarks/start.py [MACHINE] [--runs 5] [--links 250 500 1000 2000]

The first round compiles and writes byte code; it is not counted. `--links` adds chains of so many bars,
prepared, run for one step and judged, less what reads them: seconds, milliseconds a body and the largest memory of the process.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SLIDER_CRANK = Path(__file__).resolve().parents[1] / "examples" / "mechanisms" / "slider-crank.yaml"


def usage(arguments: list[str], folder: Path) -> tuple[float, float]:
    """Processor time [s] and largest memory [MB] of python with these arguments. Raises RuntimeError where it fails."""
    child = subprocess.Popen(
        [sys.executable, *arguments], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        raise RuntimeError(f"python {' '.join(arguments)} ended with {child.returncode}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def main() -> None:
    """Prints the table of commands, then that of chains."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machine", type=Path, nargs="?", default=SLIDER_CRANK)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--links", type=int, nargs="*", default=[])
    options = parser.parse_args()
    machine = str(options.machine.resolve())
    commands = {
        "import numpy": ["-c", "import numpy"],
        "import nivel; nivel.load": ["-c", f"import nivel; nivel.load({machine!r})"],
        "nivel check": ["-m", "nivel", "check", machine],
        "nivel run": ["-m", "nivel", "run", machine, "--force"],
    }
    with tempfile.TemporaryDirectory() as folder:
        least = dict.fromkeys(commands, float("inf"))
        for round_number in range(options.runs + 1):
            for name, arguments in commands.items():
                seconds, _ = usage(arguments, Path(folder))
                if round_number:
                    least[name] = min(least[name], seconds)
    for name, seconds in least.items():
        print(f"{name:26} {seconds:6.2f} s  {seconds / least['import numpy']:5.1f} times import numpy")
    here = Path(__file__).resolve().parent
    for links in options.links:
        prepare = f"from chain import chain; import nivel; machine = nivel.Machine.from_record(chain({links}))"
        run = "machine.simulate(verify=False, step=1e-3, duration=1e-3, output_interval=1e-3, integrator='rk4')"
        without, _ = min(usage(["-c", prepare], here) for _ in range(2))
        seconds, memory = min(usage(["-c", f"{prepare}; {run}"], here) for _ in range(2))
        seconds -= without
        print(f"chain of {links:5}: {seconds:6.2f} s, {1e3 * seconds / links:5.2f} ms a body, {memory:5.0f} MB")


if __name__ == "__main__":
    main()
