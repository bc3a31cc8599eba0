"""Statics of the examples from random assembled starts: how many end in an equilibrium, and why the others do not.

python benchmarks/statics_from_random_starts.py [STARTS] [EXAMPLE ...]

The independent joint coordinates start anywhere, angles within a turn, lengths within the machine's length about where they are; the
joints are closed from there. A start that cannot be assembled is drawn again.
"""

import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np

import nivel
from nivel.errors import ModelError, SolveError

EXAMPLES = Path(__file__).parents[1] / "examples"
RIGID = ("mechanisms", "contact", "vehicles", "machines", "control")
STARTS, DRAWS = 200, 20
BALANCED = 1e-9  # of the largest load


def free_coordinates(machine):
    """(joint, coordinate, its value, whether it is an angle) of the independent joint coordinates."""
    mechanics = machine.mechanics()
    named = {
        f"{j.name}.{name}": (j.name, name)
        for j in machine.record.joints
        for name in j.coordinates
        if name not in j.held
    }
    values = dict(zip(mechanics.position_names, mechanics.start, strict=True))
    return [
        (*named[name], values.get(name, 0.0), named[name][1].startswith("angle"))
        for name in mechanics.names
        if name in named
    ]


def moved(machine, free, size, rng):
    """The machine with other start values of its free coordinates, and joints that may be as far open."""
    starts = {}
    for joint, name, value, turns in free:
        starts.setdefault(joint, {})[name] = value + rng.uniform(-1.0, 1.0) * (np.pi if turns else size)
    joints = []
    for joint in machine.record.joints:
        given = {**(joint.start.given if joint.start is not None else {}), **starts.get(joint.name, {})}
        joints.append(joint.replace(start=given) if given else joint)
    assembly = machine.record.assembly.replace(largest_gap=1e3 * size)
    return nivel.Machine.from_record(machine.record.replace(joints=tuple(joints), assembly=assembly), machine.origin)


def from_random_starts(machine, starts, seed=1):
    """(how many ended in an equilibrium, Counter of why the others did not, starts that could not be assembled)."""
    rng, free = np.random.default_rng(seed), free_coordinates(machine)
    size = machine.simulate(verify=False, duration=machine.record.simulation.step or 1e-3).trust.size
    balanced, reasons, unassembled, refused = 0, Counter(), 0, ""
    for _ in range(starts):
        for _ in range(DRAWS):
            try:
                result = moved(machine, free, size, rng).statics(duration=0.0)
            except SolveError as error:
                reasons[str(error).splitlines()[0][:90]] += 1
                break
            except ModelError as error:
                unassembled += 1
                refused = str(error).splitlines()[0][:90]
                continue
            left = float(result.array("residual").max())
            if left <= BALANCED or "round-off" in str(result.trust.items[1].text):
                balanced += 1
            else:
                reasons[f"residual {left:.0e}"] += 1
            break
        else:
            reasons[f"not assembled in {DRAWS} draws: {refused}"] += 1
    return balanced, reasons, unassembled


def main(starts, names):
    """A line for each example, and what failed."""
    for name in names:
        began = time.perf_counter()
        try:
            machine = nivel.load(EXAMPLES / f"{name}.yaml", allow_code=True)
            balanced, reasons, unassembled = from_random_starts(machine, starts)
        except (ModelError, SolveError) as error:
            print(f"{name:20s} refused: {str(error).splitlines()[0][:110]}", flush=True)
            continue
        share, spent = 100.0 * balanced / starts, time.perf_counter() - began
        print(f"{name:20s} {share:5.1f} % of {starts}, {unassembled} starts drawn again, {spent:.0f} s", flush=True)
        for reason, count in reasons.most_common(4):
            print(f"    {count:4d}  {reason}", flush=True)


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else STARTS
    rigid = (path for folder in RIGID for path in sorted((EXAMPLES / folder).glob("*.yaml")))
    main(count, sys.argv[2:] or [path.relative_to(EXAMPLES).with_suffix("").as_posix() for path in rigid])
