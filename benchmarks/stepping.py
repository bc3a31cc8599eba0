"""What a step from Python costs beside the compiled loop: `sim.step()` one by one and `sim.advance` over the same time, interleaved.

python benchmarks/stepping.py
"""

from __future__ import annotations

import time
from pathlib import Path

import nivel

EXAMPLES = Path(__file__).parent.parent / "examples"


def main() -> None:
    """Print both, in microseconds a step; the least difference of several rounds."""
    sim = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml").start()
    rounds = []
    for _ in range(8):
        begin = time.thread_time()
        for _ in range(1000):
            sim.step()
        middle = time.thread_time()
        sim.advance(1.0)
        rounds.append((middle - begin, time.thread_time() - middle))
    single, together = min(rounds, key=lambda each: each[0] - each[1])
    print(f"{single * 1e3:.2f} us a step from Python, {together * 1e3:.2f} us in the compiled loop")


if __name__ == "__main__":
    main()
