"""Time per link and step of a chain of N bars joined by revolutes, RK4; beside MuJoCo, Pinocchio and Exudyn.

    python benchmarks/chain.py [--links 4 16 64 256 2000] [--coordinates relative] [--peer PYTHON] [--runs 5]

The chain is that of chain_data.py. The first run compiles (only once in all) and orders the unknowns; it is not counted. Every
round runs nivel once for each length and, with `--peer` (the interpreter of an environment with the peers, see README.md), each
peer once for each length up to 256. Medians over the rounds; process time in the loops.

That all programs integrate the same machine is seen from the last bar's place after half a second.
"""

import argparse
import math
import statistics
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

import nivel
from chain_data import CHECK_STEPS, GRAVITY, INERTIA, LENGTH, MASS, STEP, timed_steps
from nivel import Body, Joint, MachineRecord
from step_time import call_peer

PEERS = Path(__file__).resolve().parent / "peers"
PEER_PROGRAMS, LONGEST_OF_PEERS = ("mujoco", "pinocchio", "exudyn"), 256


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
    return MachineRecord(name=f"chain-{links}", gravity=(0.0, -GRAVITY, 0.0), bodies=bodies, joints=hinges)


@dataclass
class Chain:
    """A program's chain of some length. times: µs per step of each way that it has, one for each round."""

    program: str
    links: int
    times: dict[str, list[float]] = field(default_factory=dict)
    energy_error: float = math.nan
    last_position: tuple[float, ...] = ()

    def take(self, times: dict[str, list[float]]) -> None:
        for way, found in times.items():
            self.times.setdefault(way, []).extend(found)


class OwnChain(Chain):
    """nivel's."""

    def prepare(self, settings: dict[str, str]) -> None:
        self._machine = nivel.Machine.from_record(chain(self.links))
        self._settings = {"step": STEP, **settings}
        result = self._run(CHECK_STEPS, frames=50)
        kinetic = np.max(result["kinetic_energy"].values)
        self.energy_error = float(np.max(np.abs(result["energy_error"].values)) / kinetic)
        self.last_position = tuple(result["position"].values[-1, -1])

    def measure(self) -> None:
        timing = self._run(timed_steps(self.links), frames=1).timing
        self.take({self._settings["coordinates"]: [1e6 * timing["loop_seconds"] / timing["steps"]]})

    def _run(self, steps: int, frames: int):
        duration = steps * STEP
        return self._machine.simulate(
            verify=False, **self._settings, duration=duration, output_interval=duration / frames
        )


class PeerChain(Chain):
    """A peer's, run by the interpreter that has it."""

    def prepare(self, python: str) -> None:
        script = PEERS / f"{self.program}_chain.py"
        self._command = [python, str(script), "--links", str(self.links), "--runs", "1"]
        found = call_peer(self._command)
        self.energy_error, self.last_position = found["energy_error"], tuple(found["last_position"])

    def measure(self) -> None:
        self.take(call_peer([*self._command, "--no-check"])["times"])


def chains(options: argparse.Namespace) -> Iterator[OwnChain | PeerChain]:
    """All programs and lengths, ready to be measured."""
    settings = {name: getattr(options, name) for name in ("integrator", "coordinates", "formulation", "stabilisation")}
    for links in options.links:
        own = OwnChain("nivel", links)
        own.prepare(settings)
        yield own
        for program in PEER_PROGRAMS if options.peer and links <= LONGEST_OF_PEERS else ():
            peer = PeerChain(program, links)
            peer.prepare(options.peer)
            yield peer


def show(found: list[Chain], title: str) -> None:
    """One table; the ratio is to nivel's time."""
    table = Table(title=title, title_justify="left")
    for heading in ("links", "program", "way"):
        table.add_column(heading)
    for heading in ("µs/step", "range", "µs/link and step", "ratio", "energy error / max T", "apart, m"):
        table.add_column(heading, justify="right")
    own = None
    for each in found:
        own = each if isinstance(each, OwnChain) else own
        assert own is not None
        base = statistics.median(next(iter(own.times.values())))
        for way, times in each.times.items():
            middle = statistics.median(times)
            table.add_row(
                str(each.links),
                each.program,
                way,
                f"{middle:.2f}",
                f"{min(times):.2f}-{max(times):.2f}",
                f"{middle / each.links:.3f}",
                f"{middle / base:.2f}",
                f"{each.energy_error:.1e}",
                f"{math.dist(each.last_position, own.last_position):.0e}",
            )
    Console(width=170).print(table)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--links", type=int, nargs="+", default=[4, 16, 64, 256, 2000])
    parser.add_argument("--integrator", default="rk4", help="of nivel; the peers' is RK4")
    parser.add_argument("--formulation", default="newton-euler")
    parser.add_argument("--coordinates", default="relative")
    parser.add_argument("--stabilisation", default="none")
    parser.add_argument("--peer", metavar="PYTHON", help="interpreter of the environment with the peers")
    parser.add_argument("--runs", type=int, default=5, help="rounds (median)")
    options = parser.parse_args()
    found = list(chains(options))
    for _ in range(options.runs):
        for each in found:
            each.measure()
    show(
        found,
        f"{options.coordinates}, {options.formulation}, stabilisation {options.stabilisation}; {options.integrator}, {STEP:g} s",
    )


if __name__ == "__main__":
    main()
