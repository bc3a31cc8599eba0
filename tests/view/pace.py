"""Pictures a second as they are, and how much of a processor's work this machine has left, to say what may be asked of it."""

import os
import statistics
import subprocess
import sys
import time

WINDOWS, WINDOW = 7, 1.5  # seconds each
# sums of numbers below 10 000 that one processor forms in a second
SPIN = (
    "import time; begin, rounds = time.perf_counter(), 0\n"
    "while time.perf_counter() < begin + 0.5: sum(range(10_000)); rounds += 1\n"
    "print(rounds / (time.perf_counter() - begin))"
)
REFERENCE = 8000.0  # of a processor of the year 2021 at rest, which what is asked is meant for


def frame_rates(page):
    """Pictures a second in each of some windows of time."""
    rates = []
    for _ in range(WINDOWS):
        before, begin = page.evaluate("nivel.frames()"), time.perf_counter()
        page.wait_for_timeout(1000 * WINDOW)
        rates.append((page.evaluate("nivel.frames()") - before) / (time.perf_counter() - begin))
    return rates


def free_share():
    """How fast a processor is here and now (0 to 1 of the reference): one that is slower, or that others use, draws as much slower."""
    spins = [subprocess.Popen([sys.executable, "-c", SPIN], stdout=subprocess.PIPE) for _ in range(os.cpu_count() or 1)]
    paces = [float(each.communicate(timeout=120)[0]) for each in spins]
    return min(1.0, statistics.mean(paces) / REFERENCE)
