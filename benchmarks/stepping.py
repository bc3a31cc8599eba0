"""What a step from Python costs beside the compiled loop: `sim.step()` one by one, with an input, and with results that are read.

python benchmarks/stepping.py
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import nivel
from nivel.demos import demo_file

EXAMPLES = Path(__file__).parent.parent / "examples"
STEPS, ROUNDS = 1000, 8


def main() -> None:
    """Print microseconds a step, the least of several interleaved rounds."""
    for file in (EXAMPLES / "mechanisms" / "slider-crank.yaml", demo_file("harbour-crane")):
        measure(nivel.load(file))


def measure(machine: nivel.Machine) -> None:
    """Print those of one machine."""
    sim = machine.start()
    body = f"{next(iter(machine.bodies))}.position"
    lever = next(iter(machine.inputs), None)

    def read() -> None:
        sim.step()
        _ = sim[body]

    def read_twice() -> None:
        read()
        _ = sim[body]

    ways: dict[str, Callable[[], object]] = {
        "step": sim.step,
        "step, one reading": read,
        "step, two readings": read_twice,
    }
    state = sim.state
    ways["state"] = lambda: sim.state
    ways["restore"] = lambda: sim.restore(state)
    if lever is not None:
        ways["step with an input"] = lambda: sim.step({lever: 0.001})
    best = dict.fromkeys(["compiled loop", *ways], float("inf"))
    for _ in range(ROUNDS):
        for name, way in ways.items():
            begin = time.thread_time()
            for _ in range(STEPS):
                way()
            best[name] = min(best[name], time.thread_time() - begin)
        begin = time.thread_time()
        sim.advance(STEPS * machine.simulation.step)
        best["compiled loop"] = min(best["compiled loop"], time.thread_time() - begin)
    print(machine.name)
    for name, least in best.items():
        print(f"  {name:20} {1e6 * least / STEPS:6.2f} us")


if __name__ == "__main__":
    main()
