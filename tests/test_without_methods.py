"""Examples whose method keys are taken away: each is as green as with them.

As a program, a table of all of them: `PYTHONPATH=tests python tests/test_without_methods.py [NAME …]`.
"""

import sys
import time
from pathlib import Path

import pytest

import nivel
from lanes import tail
from nivel.machine.settings.run import SimulationSettings

EXAMPLES = Path(__file__).parent.parent / "examples"
ORDER = ("green", "amber", "red")
# all other keys of `simulation` are methods, or constants of one
NO_METHOD = {"duration", "output_interval", "start", "free"}
# run after an FMU was built
BUILT = {"cart"}
# of each family: explicit, one that sticks, a circuit, beams
FEW = ["toggle", "rough-ground", "cylinder-boom", "beams/cable"]


def names():
    """Folder and name of the examples that run as they are, the folder where two have one name."""
    paths = [
        path
        for path in sorted(EXAMPLES.rglob("*.yaml"))
        if "\nsimulation:" in path.read_text(encoding="utf-8")
        and path.stem not in BUILT
        and path.parent.name != "flexible"
    ]
    return {f"beams/{path.stem}" if path.parent.name == "beams" else path.stem: path for path in paths}


def without_method(machine):
    """The machine with the settings that are no methods."""
    own = machine.record.simulation
    kept = {key: getattr(own, key) for key in own.model_fields_set & NO_METHOD}
    return nivel.Machine.from_record(machine.record.replace(simulation=SimulationSettings(**kept)), machine.origin)


def judged(machine):
    """Trust report of a run, and the seconds of the processor that it took."""
    begin = time.process_time()
    trust = machine.simulate(verify=True).trust
    return trust, time.process_time() - begin


@pytest.mark.parametrize("name", tail(names(), FEW))
def test_an_example_is_as_green_without_its_method(name):
    machine = nivel.load(names()[name], allow_code=True)
    without, own = (judged(each)[0] for each in (without_method(machine), machine))
    told = "\n".join(item.text for item in without.items if item.verdict != "green")
    assert ORDER.index(without.verdict) <= ORDER.index(own.verdict), told


def main():
    """Verdict and processor time of all examples, without and with their method."""
    wanted, sums, counts = sys.argv[1:], [0.0, 0.0], [dict.fromkeys(ORDER, 0) for _ in range(2)]
    for name, path in names().items():
        if wanted and name not in wanted:
            continue
        machine = nivel.load(path, allow_code=True)
        judged(machine)  # imports and compiles
        both = [judged(each) for each in (without_method(machine), machine)]
        for k, (trust, seconds) in enumerate(both):
            counts[k][trust.verdict] += 1
            sums[k] += seconds
        (one, first), (two, second) = both
        print(f"{name:24} {one.verdict:6} {two.verdict:6} {first:6.1f} {second:6.1f} {first / second:6.1f}", flush=True)
    print(f"without: {counts[0]}, with: {counts[1]}, processor time {sums[0] / sums[1]:.2f}")


if __name__ == "__main__":
    main()
