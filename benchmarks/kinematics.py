"""Seconds for 10 001 positions of the slider-crank, with velocities, accelerations and reactions: of the compiled loop, and of the call.

python benchmarks/kinematics.py
"""

from pathlib import Path
from time import perf_counter

import nivel

MACHINE = Path(__file__).parent.parent / "examples" / "mechanisms" / "slider-crank.yaml"
POSITIONS, RUNS = 10_001, 7


def main():
    """The least of some runs, after one that loads the code."""
    machine, times = nivel.load(MACHINE), []
    for _ in range(RUNS + 1):
        begin = perf_counter()
        result = machine.kinematics(drive="hinge", positions=POSITIONS)
        times.append((result.timing["loop_seconds"], perf_counter() - begin))
    loop, call = (min(each) for each in zip(*times[1:], strict=True))
    print(f"{POSITIONS} positions: {loop:.3f} s in the loop, {call:.3f} s in all")


if __name__ == "__main__":
    main()
