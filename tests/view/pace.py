"""Pictures a second as they are, and how much of this machine's processors other programs leave, to say what may be asked of it."""

import os
import statistics
import subprocess
import sys
import time

WINDOWS, WINDOW = 7, 1.5  # seconds each
# a processor's time that a busy loop gets in half a second
SPIN = (
    "import time; a, b = time.perf_counter(), time.process_time()\n"
    "while time.perf_counter() < a + 0.5: pass\n"
    "print((time.process_time() - b) / (time.perf_counter() - a))"
)


def frame_rates(page):
    """Pictures a second in each of some windows of time."""
    rates = []
    for _ in range(WINDOWS):
        before, begin = page.evaluate("nivel.frames()"), time.perf_counter()
        page.wait_for_timeout(1000 * WINDOW)
        rates.append((page.evaluate("nivel.frames()") - before) / (time.perf_counter() - begin))
    return rates


def free_share():
    """The share (0 to 1) of the processors that other programs leave to this one: drawing with the processor is as much slower."""
    spins = [subprocess.Popen([sys.executable, "-c", SPIN], stdout=subprocess.PIPE) for _ in range(os.cpu_count() or 1)]
    return min(1.0, statistics.mean(float(each.communicate(timeout=30)[0]) for each in spins))
