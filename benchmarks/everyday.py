"""The method that nivel chooses against methods named by hand, for everyday machines and the shipped examples: light, cost and truth.

python benchmarks/everyday.py [--lines] [--truth] [--examples] [MACHINE.yaml …]

Without names the machines of `benchmarks/everyday`, or the shipped examples without beams. Methods that files name are taken away.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np

import nivel

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "verification" / "verdicts"))
from test_everyday_machines import EVERYDAY, ratios
from test_without_methods import names, without_method

POLICIES = {
    "none named": {},
    "`rk4`, 1 ms": {"integrator": "rk4", "step": 1e-3},
    "`dopri5`, 1e-6": {"integrator": "dopri5", "tolerance": 1e-6},
    "`radau`, 1e-8": {"integrator": "radau", "tolerance": 1e-8},
}


def judged(machine, **settings):
    """Verdict, lines that are not green, seconds of the loop and of the processor, and the result; a failure is red."""
    begin = time.process_time()
    try:
        result = machine.simulate(verify=True, **settings)
    except nivel.SolveError as error:
        seconds = time.process_time() - begin
        return "red", [str(error)], seconds, seconds, None
    whole = time.process_time() - begin
    lines = [f"{item.verdict} {item.name}: {item.text}" for item in result.trust.items if item.verdict != "green"]
    return result.trust.verdict, lines, result.timing["loop_seconds"], whole, result


def main() -> None:
    """Table of all policies, and how far stated errors are from true ones."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("machines", nargs="*", type=Path)
    parser.add_argument("--lines", action="store_true", help="print lines that are not green")
    parser.add_argument("--truth", action="store_true", help="compare with runs at 1e-11 in place of other methods")
    parser.add_argument("--examples", action="store_true", help="the shipped examples")
    arguments = parser.parse_args()
    examples = [path for name, path in names().items() if not name.startswith("beams/")]
    paths = arguments.machines or (examples if arguments.examples else sorted(EVERYDAY.glob("*.yaml")))
    counts = {name: Counter() for name in POLICIES}
    sums = {name: np.zeros(2) for name in POLICIES}
    every: list[float] = []
    for path in paths:
        machine = without_method(nivel.load(path, allow_code=True))
        judged(machine)  # imports and compiles
        said = [f"{path.stem:26}"]
        for name, settings in POLICIES.items():
            if arguments.truth and settings:
                continue
            verdict, lines, loop, whole, result = judged(machine, **settings)
            counts[name][verdict] += 1
            sums[name] += loop, whole
            said.append(f"{verdict:6}{whole:7.2f}")
            if arguments.lines and not settings:
                said += [f"\n    {line}" for line in lines]
            if arguments.truth and result is not None and not machine.beams:
                found = sorted(ratios(machine, result), key=lambda each: each[1])
                every += [ratio for _, ratio, _, _ in found]
                small = [each for each in found if each[1] < 1.0 / 3.0]
                said.append(f"{len(small)} of {len(found)} below a third")
                said += [
                    f"\n    {one}: {ratio:.3f}, true {true:.2e}, share {share:.1e}"
                    for one, ratio, true, share in small[:6]
                ]
        print(*said, flush=True)
    first = sums["none named"]
    for name in POLICIES:
        verdicts = counts[name]
        if total := verdicts.total():
            loop, whole = sums[name] / first
            print(
                f"| {name} | {verdicts['green']} | {verdicts['amber']} | {verdicts['red']} | {loop:.2f} | {whole:.2f} |"
            )
            print(f"    {100.0 * verdicts['green'] / total:.1f} % green")
    if every:
        print(
            f"{sum(each >= 1.0 / 3.0 for each in every)} of {len(every)} stated errors are at least a third of the true ones"
        )


if __name__ == "__main__":
    main()
