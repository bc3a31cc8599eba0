"""What verification costs: `nivel run` of the examples with a second run beside the first and without, and what the first line then says.

    python benchmarks/verification.py [EXAMPLE.yaml ...]

Wall time is that of the whole command, reading, running and reporting, the least of REPEATS; processor time counts both threads. The bar
is 1.5 by wall time on two cores that have nothing else to do.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

EXAMPLES = Path(__file__).parent.parent / "examples"
REPEATS, BAR = 2, 1.5


def main() -> None:
    """A line for each example: wall time without and with verification, ratios of wall and processor time, the headline."""
    paths = [Path(name) for name in sys.argv[1:]] or sorted(EXAMPLES.rglob("*.yaml"))
    walls: list[float] = []
    print(f"{'example':32} {'without':>8} {'with':>8} {'wall':>6} {'cpu':>6}  headline")
    for path in paths:
        plain, verified = [_best(path, options) for options in (["--no-verify"], [])]
        if plain is None or verified is None:
            continue  # a part of another machine, or one that is not run
        walls.append(verified[0] / plain[0])
        ratios = f"{walls[-1]:6.2f} {verified[1] / plain[1]:6.2f}"
        print(f"{path.stem:32} {plain[0]:8.2f} {verified[0]:8.2f} {ratios}  {verified[2]}", flush=True)
    above = sum(ratio > BAR for ratio in walls)
    print(
        f"wall time with over without: median {statistics.median(walls):.2f}, largest {max(walls):.2f}, {above} above"
    )


def _best(path: Path, options: list[str]) -> tuple[float, float, str] | None:
    """(wall time [s], processor time [s], headline) of the quickest of REPEATS runs; None where the machine is refused or fails."""
    found = [_run(path, options) for _ in range(REPEATS)]
    done = [each for each in found if each is not None]
    return min(done) if done else None


def _run(path: Path, options: list[str]) -> tuple[float, float, str] | None:
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "nivel", "run", str(path.resolve()), "--allow-code", *options]
        begin, before = time.perf_counter(), os.times()
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        wall, after = time.perf_counter() - begin, os.times()
    if done.returncode:
        return None
    spent = after.children_user + after.children_system - before.children_user - before.children_system
    lines = [line for line in (done.stdout + done.stderr).splitlines() if line.startswith("trust:")]
    return wall, spent, lines[0].removeprefix("trust: ") if lines else ""


if __name__ == "__main__":
    main()
