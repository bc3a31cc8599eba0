"""Process time of a whole run whose positions are within 1e-4 m of the reference, on the two report machines, beside Exudyn.

    python benchmarks/time_to_accuracy.py [--peer PYTHON] [--error 1e-4] [--runs 5] [--json FILE]

The position error is the largest distance of a centre of mass from the one-degree-of-freedom reference solution, over all steps
of the run: an error at the end alone could be small by chance. Every method gets the largest step (or tolerance) that is enough:
nivel's the coarsest of a geometric sequence below which all finer ones tried are enough, Exudyn's by its order two from step to
step, within two per cent. The search is not counted. Then every round runs each method once; medians over the rounds, process time in
the loops.
"""

import argparse
import json
import math
import statistics
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

import nivel
from nivel.integrate.catalogue import INTEGRATORS
from step_time import DURATIONS, PEER_SOLVERS, ROOT, call_peer, peer_command, reference_position

# integrator, coordinates, stabilisation
METHODS = tuple(
    (integrator, coordinates, stabilisation)
    for integrator in ("rk4", "dopri5", "dop853")
    for coordinates, stabilisation in (("relative", "none"), ("relative", "direct"), ("absolute", "direct"))
)
COARSEST_STEP, COARSEST_TOLERANCE = 0.04, 1e-2  # s, -
FINER, TOLERANCE_FINER = 2 ** (1 / 8), 10 ** (1 / 4)
# frames in which errors of methods that choose their steps are looked for [s]
FRAMES = 2e-3
# a second-order method is refined by a little more than its error asks for
MARGIN = 0.99


@dataclass
class Row:
    """One line of the table. times: s, one for each round."""

    machine: str
    program: str
    method: str
    steps: int = 0
    fineness: str = ""
    position_error: float = math.nan
    times: list[float] = field(default_factory=list)

    @property
    def seconds(self) -> float:
        return statistics.median(self.times)


class OwnRun:
    """A method of nivel on one machine."""

    def __init__(self, name: str, integrator: str, coordinates: str, stabilisation: str) -> None:
        self.row = Row(name, "nivel", f"{integrator}, {coordinates}, {stabilisation}")
        self._machine = nivel.load(ROOT / "examples" / "mechanisms" / f"{name}.yaml")
        self._chooses = INTEGRATORS[integrator].chooses_steps
        self._options = {
            "duration": DURATIONS[name],
            "integrator": integrator,
            "coordinates": coordinates,
            "stabilisation": stabilisation,
        }

    def refine(self, error: float) -> None:
        """Settle on the coarsest of the finenesses below which all are enough."""
        enough, settled = None, 0
        for n in range(200):
            options = self._fineness(n)
            found = self._error(options)
            if found <= error:
                enough = enough or (options, found)
                settled += 1
                if settled == 4:
                    break
            else:
                enough, settled = None, 0
        assert enough is not None
        self._options |= enough[0]
        self.row.position_error = enough[1]
        name = "tolerance" if self._chooses else "step"
        self.row.fineness = f"{name} {enough[0][name]:.2g}"

    def measure(self) -> None:
        timing = self._machine.simulate(verify=False, **self._options, output_interval=self._options["duration"]).timing
        self.row.steps = int(timing["steps"])
        self.row.times.append(timing["loop_seconds"])

    def _fineness(self, n: int) -> dict[str, float]:
        if self._chooses:
            return {"tolerance": COARSEST_TOLERANCE / TOLERANCE_FINER**n}
        duration = self._options["duration"]
        return {"step": duration / round(duration / COARSEST_STEP * FINER**n)}

    def _error(self, options: dict[str, float]) -> float:
        try:
            result = self._machine.simulate(
                verify=False, **self._options | options, output_interval=options.get("step", FRAMES)
            )
        except nivel.SolveError:  # too coarse to finish
            return math.inf
        position = result["position"].values
        apart = position - reference_position(self.row.machine, result.time, position)
        return float(np.max(np.linalg.norm(apart, axis=2)))


class PeerRun:
    """A solver of Exudyn on one machine."""

    def __init__(self, python: str, name: str, solver: str) -> None:
        self.row = Row(name, "exudyn", solver)
        self._solver, self._python = solver, python
        self._duration = DURATIONS[name]

    def refine(self, error: float) -> None:
        step, found = 1e-3, math.inf
        while True:
            found = call_peer(self._command(step))["position_error"]
            if found <= error:
                break
            step *= MARGIN * min(MARGIN, math.sqrt(error / found))
        self._step = step
        self.row.steps = round(self._duration / step)
        self.row.fineness, self.row.position_error = f"step {step:.2g}", found

    def measure(self) -> None:
        each = call_peer([*self._command(self._step), "--no-errors"])["process_microseconds_per_step"]
        self.row.times.append(1e-6 * each * self.row.steps)

    def _command(self, step: float) -> list[str]:
        return peer_command(self._python, self.row.machine, self._solver, step)


def runs(peer: str | None) -> Iterator[OwnRun | PeerRun]:
    for name in DURATIONS:
        for method in METHODS:
            yield OwnRun(name, *method)
        for solver in PEER_SOLVERS if peer else ():
            yield PeerRun(peer, name, solver)


def show(rows: list[Row], error: float, console: Console) -> None:
    """One table; the ratio is the time of Exudyn's faster solver over that of the row."""
    table = Table(title=f"position error {error:g} m; ratio > 1: nivel is faster", title_justify="left")
    for heading in ("machine", "program", "method", "fineness"):
        table.add_column(heading)
    for heading in ("steps", "position error, m", "time, ms", "range", "ratio"):
        table.add_column(heading, justify="right")
    for row in rows:
        peers = [other.seconds for other in rows if other.program == "exudyn" and other.machine == row.machine]
        ratio = f"{min(peers) / row.seconds:.0f}" if peers and row.program == "nivel" else ""
        table.add_row(
            row.machine,
            row.program,
            row.method,
            row.fineness,
            str(row.steps),
            f"{row.position_error:.1e}",
            f"{1e3 * row.seconds:.4g}",
            f"{1e3 * min(row.times):.4g}-{1e3 * max(row.times):.4g}",
            ratio,
        )
    console.print(table)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--peer", metavar="PYTHON", help="interpreter of the environment with Exudyn")
    parser.add_argument("--error", type=float, default=1e-4, help="position error [m]")
    parser.add_argument("--runs", type=int, default=5, help="rounds (median)")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write the rows there as well")
    options = parser.parse_args()
    console = Console() if sys.stdout.isatty() else Console(width=150)
    cases = list(runs(options.peer))
    with console.status("searching"):
        for case in cases:
            case.refine(options.error)
    for turn in range(options.runs):
        with console.status(f"round {turn + 1} of {options.runs}"):
            for case in cases:
                case.measure()
    rows = [case.row for case in cases]
    show(rows, options.error, console)
    if options.json:
        options.json.write_text(json.dumps([vars(row) for row in rows], indent=1) + "\n")


if __name__ == "__main__":
    main()
