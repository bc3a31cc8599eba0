"""Time per link and step of a chain of N bars joined by revolutes, N = 4, 16, 64, 256.

    python benchmarks/chain.py [--links 4 16 64 256] [--coordinates auto] [--formulation newton-euler] [--stabilisation none] [--runs 5]

The bars hang on a hinge at the origin, stretched along X and at rest; all hinge axes are Z, gravity is -Y. The machine
is built in Python. The first run of each length compiles (only once in all) and orders the unknowns; it is not counted.
"""

import argparse
import statistics

import numpy as np
from rich.console import Console
from rich.table import Table

import nivel
from nivel import Body, Joint, MachineRecord

LENGTH, WIDTH, MASS = 1.0, 0.1, 1.0
ACROSS = MASS * (LENGTH**2 + WIDTH**2) / 12
INERTIA = (MASS * WIDTH**2 / 6, ACROSS, ACROSS)  # homogeneous box


def chain(links: int) -> MachineRecord:
    """A chain of `links` bars; the frame of each bar at its centre of mass, x along the bar."""
    names = ["ground", *(f"link{i}" for i in range(1, links + 1))]
    bodies = tuple(
        Body(name=name, mass=MASS, inertia=INERTIA, position=((i + 0.5) * LENGTH, 0.0, 0.0))
        for i, name in enumerate(names[1:])
    )
    hinges = tuple(
        Joint(
            name=f"hinge{i + 1}",
            type="revolute",
            bodies=(names[i], names[i + 1]),
            point=(i * LENGTH, 0.0, 0.0),
            axis=(0.0, 0.0, 1.0),
        )
        for i in range(links)
    )
    return MachineRecord(name=f"chain-{links}", gravity=(0.0, -9.81, 0.0), bodies=bodies, joints=hinges)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--links", type=int, nargs="+", default=[4, 16, 64, 256])
    parser.add_argument("--formulation", default="newton-euler")
    parser.add_argument("--coordinates", default="auto")
    parser.add_argument("--stabilisation", default="none")
    parser.add_argument("--steps", type=int, default=500)
    parser.add_argument("--step", type=float, default=1e-3, help="step [s]")
    parser.add_argument("--runs", type=int, default=5, help="timed runs (median)")
    options = parser.parse_args()
    table = Table(
        title=f"{options.coordinates}, {options.formulation}, stabilisation {options.stabilisation}",
        title_justify="left",
    )
    for heading in ("links", "µs/step", "µs/link and step", "energy error / max T"):
        table.add_column(heading, justify="right")
    for links in options.links:
        machine = nivel.Machine.from_record(chain(links))
        settings = {
            "duration": options.steps * options.step,
            "step": options.step,
            "integrator": "rk4",
            "formulation": options.formulation,
            "coordinates": options.coordinates,
            "stabilisation": options.stabilisation,
            "output_interval": options.steps * options.step / 10,
        }
        result = machine.simulate(**settings)
        timings = [machine.simulate(**settings).timing for _ in range(options.runs)]
        each = statistics.median(1e6 * timing["loop_seconds"] / timing["steps"] for timing in timings)
        relative = np.max(np.abs(result["energy_error"].values)) / np.max(result["kinetic_energy"].values)
        table.add_row(str(links), f"{each:.2f}", f"{each / links:.3f}", f"{relative:.1e}")
    Console().print(table)


if __name__ == "__main__":
    main()
