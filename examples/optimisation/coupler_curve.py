"""The linkage that draws a given coupler curve, looked for from random lengths.

python examples/optimisation/coupler_curve.py
"""

from pathlib import Path

import nivel

HERE = Path(__file__).parent
# [m] between which bounds, and where the search begins first
LENGTHS = {
    "parameters.crank": (0.05, 0.09, 0.12),
    "parameters.coupler": (0.2, 0.28, 0.35),
    "parameters.rocker": (0.15, 0.22, 0.3),
    "parameters.along": (0.0, 0.12, 0.25),
    "parameters.aside": (-0.1, 0.04, 0.2),
}


def curve(machine: nivel.Machine):
    """The curve of a linkage: times [s] and places [m] of its coupler point."""
    result = machine.simulate(verify=False)
    return {f"coupler.position.{axis}": (result.time, result.array(f"coupler.position.{axis}")) for axis in "xy"}


def synthesised(starts: int = 10, seed: int = 1, exact_slopes: bool = True):
    """The linkage that the curve of the file was drawn with, and what was found without knowing it."""
    machine = nivel.load(HERE / "coupler-curve.yaml")
    return machine, machine.identify(
        curve(machine), LENGTHS, starts=starts, seed=seed, iterations=60, exact_slopes=exact_slopes
    )


if __name__ == "__main__":
    machine, found = synthesised()
    for path, value in found.values.items():
        print(f"{path:20} {1e3 * value:8.3f} mm, drawn with {1e3 * machine.parameters[path.partition('.')[2]]:8.3f} mm")
    print(f"{(found.reached < 1e-12).sum()} of {len(found.reached)} starts came there, {found.evaluations} runs")
