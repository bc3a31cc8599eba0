"""Friction and damping of a sliding block from a noisy record of its place, with how certain they are.

python examples/optimisation/friction_and_damping.py
"""

from pathlib import Path

import numpy as np

import nivel

HERE = Path(__file__).parent
BOUNDS = {"parameters.friction": (0.01, 0.1), "parameters.damping": (0.5, 8.0)}
NOISE = 0.5e-3  # m


def record(machine: nivel.Machine, seed: int):
    """A measured record: times [s] and places [m] of the block, with noise."""
    result = machine.simulate(verify=False)
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(result.time) - 1)
    return {"guide.displacement": (result.time[1:], result.array("guide.displacement")[1:] + noise)}


def identified(seed: int = 0):
    """The machine that was measured, and what its record says."""
    machine = nivel.load(HERE / "sliding-block.yaml")
    return machine, machine.identify(record(machine, seed), BOUNDS)


if __name__ == "__main__":
    machine, found = identified()
    for path, value in found.values.items():
        truth = machine.parameters[path.partition(".")[2]]
        print(f"{path:22} {value:.5f} ± {found.deviations[path]:.5f}, measured with {truth:g}")
