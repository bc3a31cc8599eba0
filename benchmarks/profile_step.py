"""Where the time of one step goes: each part of the evaluation in a loop of its own, nanoseconds of process time.

    python benchmarks/profile_step.py [MACHINE.yaml] [--coordinates absolute]

Parts in loops of their own overlap less than in the whole, and find what they need in registers more often: their sum is not
exactly the time of one evaluation. Least of seven rounds.
"""

import argparse
import time
from importlib import import_module
from pathlib import Path

import numpy as np

import nivel
from nivel.analysis.plan.plan import methods_of
from nivel.analysis.run.prepared_state import prepare
from nivel.kernels.output.observe import accept, observe
from part import REPEATS, measure, part

EXAMPLE = Path(__file__).parent.parent / "examples" / "mechanisms" / "slider-crank.yaml"


@part
def acceptance(machine, _y, _out, repeats):
    for _ in range(repeats):
        accept(machine, 0.0)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("machine", nargs="?", type=Path, default=EXAMPLE)
    parser.add_argument("--coordinates", choices=("absolute", "relative"), default="absolute")
    options = parser.parse_args()
    prepared = prepare(methods_of(nivel.load(options.machine).record, "newton-euler", options.coordinates))
    parts = import_module(f"{options.coordinates}_parts")
    system, address = prepared.motion.system, prepared.motion.handle.address
    system.record.control.stabilise[2:] = 1e-13
    y, out = prepared.start.copy(), np.zeros_like(prepared.start)
    prepared.motion.kernels.evaluate(address, 0.0, y, out)
    times = {name: measure(function, address, y, out) for name, function in parts.PARTS.items()}
    times["one evaluation"] = measure(parts.evaluation, address, y, out)
    times["an accepted state, per step"] = measure(acceptance, address, y, out)
    times["direct correction, per step"] = measure(parts.correction, address, y.copy(), out)
    frame = np.zeros(system.layout.width)
    begin = time.process_time()
    for _ in range(REPEATS):
        observe(address, 0.0, y, frame)
    times["output of one frame"] = 1e9 * (time.process_time() - begin) / REPEATS
    saddle = system.record.saddle
    title = f"{options.machine.stem}, {options.coordinates}: {system.body_count} bodies, {len(saddle.row)} rows of S"
    print(f"{title}, {len(saddle.L)} entries of L")
    for name, nanoseconds in times.items():
        print(f"{name:40} {nanoseconds:8.0f} ns")


if __name__ == "__main__":
    main()
