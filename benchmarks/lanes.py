"""What lanes save: variants of a machine by `machine.batch`, several by one step, and the same variants run singly.

    OPENBLAS_NUM_THREADS=1 python benchmarks/lanes.py [MACHINE] [--path PATH --from 60 --to 80] [--variants 200]

Machine code for lanes is compiled first. Rounds of both ways take turns, in one thread; ratios are medians over the rounds. `loop` is the
processor time of the compiled loop of a variant; `in all` that of the whole batch over the number of variants.
"""

import argparse
import statistics
from pathlib import Path
from time import process_time
from unittest.mock import patch

import numpy as np

import nivel
from nivel.analysis.progress.log import Listener
from nivel.analysis.sweep import variant_runs
from nivel.analysis.sweep.patched import PatchedRuns, learn
from nivel.native.processor import lane_count

ROOT = Path(__file__).resolve().parents[1]


def main() -> None:
    """Print microseconds a step and variant, and ratios."""
    args = arguments()
    settings = {"integrator": args.integrator, "step": args.step, "duration": args.duration}
    machine, values = nivel.load(args.machine).with_settings(settings), np.linspace(args.low, args.high, args.variants)
    runs = PatchedRuns(learn(machine, [{args.path: value} for value in values[[0, -1]]]))
    variant_runs.LaneRuns(runs, np.inf, Listener())
    found: dict[str, list[tuple[float, float, float]]] = {"in lanes": [], "singly": []}
    for _ in range(args.rounds):
        for way, rows in found.items():
            rows.append(measured(machine, args.path, values, singly=way == "singly"))
    steps = args.variants * round(args.duration / args.step)
    print(f"{machine.name}: {args.variants} variants, {lane_count()} lanes")
    for way, rows in found.items():
        whole, loop, share = (statistics.median(each) for each in zip(*rows, strict=True))
        print(
            f"  {way:9} {1e6 * loop / steps:6.3f} us a step in the loop, {1e6 * whole / steps:6.3f} in all; {share:.0%} ran in lanes"
        )
    for k, part in enumerate(("in all", "in the loop")):
        ratio = statistics.median(a[k] / b[k] for a, b in zip(found["singly"], found["in lanes"], strict=True))
        print(f"  singly takes {ratio:.2f} times as long {part}")


def measured(machine: nivel.Machine, path: str, values: np.ndarray, *, singly: bool) -> tuple[float, float, float]:
    """Processor time [s] of the batch and of its loops, and the share in lanes."""
    with patch.object(variant_runs, "unfit", (lambda *_: "asked for") if singly else variant_runs.unfit):
        begin = process_time()
        found = machine.batch({path: values}, threads=1)
        whole = process_time() - begin
    return whole, found.attrs["loop_seconds"], found.attrs["in_lanes"]


def arguments() -> argparse.Namespace:
    """Of the command line."""
    parser = argparse.ArgumentParser(description="Variants in lanes and one by one.")
    parser.add_argument("machine", nargs="?", default=ROOT / "examples" / "mechanisms" / "slider-crank.yaml")
    parser.add_argument("--path", default="bodies.rod.mass")
    parser.add_argument("--from", dest="low", type=float, default=60.0)
    parser.add_argument("--to", dest="high", type=float, default=80.0)
    parser.add_argument("--variants", type=int, default=200)
    parser.add_argument("--integrator", default="rk4")
    parser.add_argument("--step", type=float, default=1e-3)
    parser.add_argument("--duration", type=float, default=2.0)
    parser.add_argument("--rounds", type=int, default=3)
    return parser.parse_args()


if __name__ == "__main__":
    main()
